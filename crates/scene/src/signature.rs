//! Files that are neither scenes nor OBJ meshes, told by how they begin.

use std::borrow::Cow;

/// What a file is instead.
#[derive(Clone, Copy)]
pub(crate) struct Foreign {
    pub(crate) name: &'static str,
    /// How to make it one that is read.
    pub(crate) help: &'static str,
}

const ENCODED: &str = "save it as UTF-8";
const PACKED: &str = "unpack it";
const EXPORT: &str = "export it as Wavefront OBJ (.obj): most modelling programs can";
const PICTURE: &str = "scenes are read from TOML (.toml) and View3D (.vs3), meshes from OBJ (.obj)";

const LIBRARY: &str = "name the OBJ file (.obj) that it belongs to; colours are not read from it";
const MATERIALS: &str = "a material library of an OBJ file (.mtl)";

const SIGNATURES: [(&[u8], &str, &str); 28] = [
    (b"\xff\xfe", "text in UTF-16", ENCODED),
    (b"\xfe\xff", "text in UTF-16", ENCODED),
    (b"\x1f\x8b", "compressed by gzip", PACKED),
    (b"BZh", "compressed by bzip2", PACKED),
    (b"\xfd7zXZ", "compressed by xz", PACKED),
    (b"\x28\xb5\x2f\xfd", "compressed by Zstandard", PACKED),
    (b"7z\xbc\xaf", "a 7z archive", PACKED),
    (
        b"PK\x03\x04",
        "a ZIP archive (3MF, USDZ or another)",
        EXPORT,
    ),
    (b"ply\n", "a PLY file", EXPORT),
    (b"ply\r", "a PLY file", EXPORT),
    (b"glTF", "a binary glTF file (GLB)", EXPORT),
    (b"Kaydara FBX Binary", "an FBX file", EXPORT),
    (b"; FBX", "an FBX file", EXPORT),
    (b"BLENDER", "a file of Blender", EXPORT),
    (b"ISO-10303-21", "a STEP or IFC file", EXPORT),
    (b"#VRML V", "a VRML file", EXPORT),
    (b"#usda 1", "a USD file", EXPORT),
    (b"PXR-USDC", "a USD file", EXPORT),
    (b"\x89PNG", "a PNG picture", PICTURE),
    (b"\xff\xd8\xff", "a JPEG picture", PICTURE),
    (b"GIF8", "a GIF picture", PICTURE),
    (b"v/1\x01", "an OpenEXR picture", PICTURE),
    (b"#?RADIANCE", "a Radiance HDR picture", PICTURE),
    (b"P3\n", "a PPM picture", PICTURE),
    (b"P6\n", "a PPM picture", PICTURE),
    (b"PF\n", "a PFM picture", PICTURE),
    (b"newmtl ", MATERIALS, LIBRARY),
    (b"<", "an XML file (COLLADA, X3D or another)", EXPORT),
];

impl Foreign {
    /// The same where a scene is wanted, not a mesh.
    pub(crate) fn help_for_scenes(&self) -> Cow<'static, str> {
        if self.help == EXPORT {
            let help = format!(
                "{EXPORT}; then name it in a scene file (.toml): mesh = {{ file = \"NAME.obj\" }}"
            );
            return help.into();
        }
        self.help.into()
    }
}

/// Bytes of a file in which its format shows.
const LOOKED_AT: usize = 4096;

/// What a file is, if it can be no scene and no OBJ mesh.
pub(crate) fn foreign(bytes: &[u8]) -> Option<Foreign> {
    let known = SIGNATURES.iter().find(|known| bytes.starts_with(known.0));
    if let Some(&(_, name, help)) = known {
        return Some(Foreign { name, help });
    }
    let start = &bytes[..bytes.len().min(LOOKED_AT)];
    let text = String::from_utf8_lossy(start);
    let mut first = text.lines().take(1);
    if first.any(|line| line.starts_with("# Blender") && line.contains("MTL File")) {
        let (name, help) = (MATERIALS, LIBRARY);
        return Some(Foreign { name, help });
    }
    let words: Vec<&str> = text.split_whitespace().take(2).collect();
    let name = if is_binary_stl(bytes) {
        "a binary STL file"
    } else if words.first() == Some(&"solid") && text.contains("facet") {
        "an ASCII STL file"
    } else if text.trim_start().starts_with('{') {
        "a JSON file (glTF or another)"
    } else if words.first() == Some(&"OFF") {
        "an OFF file"
    } else if words == ["0", "SECTION"] {
        "a DXF file"
    } else if start.contains(&0) {
        "a binary file of a format that is not known"
    } else {
        return None;
    };
    Some(Foreign { name, help: EXPORT })
}

/// 80 bytes of any content, the number of triangles, and 50 bytes for each.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..84).and_then(|count| count.try_into().ok());
    let size = |count| 84 + 50 * u64::from(u32::from_le_bytes(count));
    count.map(size) == Some(bytes.len() as u64)
}
