//! Scenes of meshes.

use super::{Parsed, parse};
use crate::Scene;
use proptest::prelude::*;
use radiosity_geometry::{DVec3, Shape, SurfaceId};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// A scene of one mesh, in a folder of its own.
pub(super) struct MeshScene(tempfile::TempDir);

impl MeshScene {
    pub(super) fn new(obj: impl AsRef<[u8]>) -> MeshScene {
        let folder = tempfile::TempDir::new().unwrap();
        std::fs::write(folder.path().join("model.obj"), obj).unwrap();
        MeshScene(folder)
    }

    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(super) fn text(file: &str, extra: &str) -> String {
        format!(
            "[materials.a]\nreflectance = 0.1\n[materials.b]\nreflectance = 0.2\n\
             [[surfaces]]\nname = \"thing\"\nmaterial = \"a\"\nmesh = {{ file = \"{file}\"{extra}\n"
        )
    }

    pub(super) fn parse(&self, file: &str, extra: &str) -> Result<Parsed, String> {
        let folder = self.0.path().display().to_string();
        parse(&self.path("scene.toml"), &MeshScene::text(file, extra))
            .map_err(|error| error.to_string().replace(&folder, "FOLDER"))
    }
}

const TWO_GROUPS: &str = "# two groups\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n\
    v 0 0 1\ng base\nf 1 2 3 4\ng side\nusemtl shiny thing\nf 1 2 5\n";

fn reflectances(scene: &Scene) -> Vec<f64> {
    let materials = &scene.surfaces[0].materials;
    materials
        .iter()
        .map(|&m| scene.materials[m].reflectance[0])
        .collect()
}

#[test]
fn groups_of_a_mesh_are_groups_of_the_scene() {
    let scene = MeshScene::new(TWO_GROUPS);
    let groups = |extra| {
        let scene = scene.parse("model.obj", extra).unwrap();
        [0, 1].map(|face| scene.group(SurfaceId(0), face).to_owned())
    };
    assert_eq!(groups(" }"), ["thing/base", "thing/side"]);
    assert_eq!(groups(" }\ngroup = \"all\""), ["all", "all"]);
    let one = MeshScene::new(TWO_GROUPS.replace("g side", "g base"));
    let one = one.parse("model.obj", " }").unwrap();
    assert_eq!(
        one.group(SurfaceId(0), 1),
        "thing",
        "one group is all of it"
    );
}

#[test]
fn meshes_take_materials_by_group_or_material_name() {
    let scene = MeshScene::new(TWO_GROUPS);
    let parse = |extra| scene.parse("model.obj", extra).unwrap();
    assert_eq!(reflectances(&parse(" }")), [0.1, 0.1]);
    assert_eq!(
        reflectances(&parse(" }\nmaterials = { base = \"b\" }")),
        [0.2, 0.1]
    );
    assert_eq!(
        reflectances(&parse(" }\nmaterials = { side = \"b\" }")),
        [0.1, 0.2]
    );
    let both = parse(" }\nmaterials = { side = \"a\", \"shiny thing\" = \"b\" }");
    assert_eq!(
        reflectances(&both),
        [0.1, 0.2],
        "the material name is the more specific one"
    );
}

#[test]
fn mesh_quads_stay_and_larger_polygons_become_triangles() {
    let faces = |obj: &str| {
        let scene = MeshScene::new(obj).parse("model.obj", " }").unwrap();
        let Shape::Mesh(mesh) = &scene.surfaces[0].shape else {
            panic!()
        };
        mesh.faces.iter().map(Vec::len).collect::<Vec<_>>()
    };
    assert_eq!(faces(TWO_GROUPS), [4, 3]);
    // An L of six corners: a fan from its first corner would leave it.
    let l = "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n";
    assert_eq!(faces(l), [3, 3, 3, 3]);
    let scene = MeshScene::new(l).parse("model.obj", " }").unwrap();
    let polygons = scene.surfaces[0].shape.polygons().unwrap();
    let area: DVec3 = polygons.iter().map(|(_, p)| p.area_vector()).sum();
    assert_eq!(area, DVec3::new(0.0, 0.0, 3.0));
    assert!(polygons.iter().all(|(_, p)| p.area_vector().z > 0.0));
}

#[test]
fn meshes_are_scaled_and_then_moved() {
    let scene = MeshScene::new(TWO_GROUPS);
    let scene = scene
        .parse("model.obj", ", scale = 2, translate = [0, 0, 7] }")
        .unwrap();
    let Shape::Mesh(mesh) = &scene.surfaces[0].shape else {
        panic!()
    };
    assert!(mesh.positions.contains(&DVec3::new(2.0, 2.0, 7.0)));
}

#[test]
fn comments_may_be_in_any_encoding() {
    let scene = MeshScene::new(b"# caf\xe9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert!(scene.parse("model.obj", " }").is_ok());
}

#[test]
fn tabs_and_continued_lines_are_read() {
    let obj = "v\t0 0 0\nv 1 0 0\nv 0 1 0\nusemtl\tred \nf 1 2 \\\n  3\nf 1 3 9\n";
    let error = MeshScene::new(obj).parse("model.obj", " }").unwrap_err();
    assert!(error.contains("model.obj:7:1"), "{error}");
    let good = MeshScene::new(obj.trim_end_matches("f 1 3 9\n"));
    let scene = good
        .parse("model.obj", " }\nmaterials = { red = \"b\" }")
        .unwrap();
    assert_eq!(reflectances(&scene), [0.2]);
}

#[test]
fn material_libraries_change_nothing() {
    for library in ["none.mtl", "names used"] {
        let obj = TWO_GROUPS.replace("none.mtl", library);
        let extra = " }\nmaterials = { \"shiny thing\" = \"b\" }";
        let scene = MeshScene::new(&obj).parse("model.obj", extra).unwrap();
        assert_eq!(reflectances(&scene), [0.1, 0.2]);
    }
}

#[test]
fn indented_lines_keep_their_names() {
    let obj = TWO_GROUPS
        .replace("\ng ", "\n  g ")
        .replace("\nusemtl", "\n\tusemtl");
    for (names, expected) in [
        ("base = \"b\"", [0.2, 0.1]),
        ("\"shiny thing\" = \"b\"", [0.1, 0.2]),
    ] {
        let extra = format!(" }}\nmaterials = {{ {names} }}");
        let scene = MeshScene::new(&obj).parse("model.obj", &extra).unwrap();
        assert_eq!(reflectances(&scene), expected);
    }
}

#[test]
fn a_mesh_is_not_a_scene() {
    let error = crate::read(Path::new("model.obj")).unwrap_err().to_string();
    assert!(
        error.contains("this is a mesh") && error.contains("mesh = {"),
        "{error}"
    );
}

#[test]
fn mesh_mistakes_are_explained() {
    let mut report = String::new();
    let mut add = |obj: &str, file: &str, extra: &str| {
        let error = MeshScene::new(obj).parse(file, extra).expect_err(obj);
        writeln!(report, "{error}\n").unwrap();
    };
    add("v 0 0 0\nv 1 x 0\nv 0 1 0\nf 1 2 3\n", "model.obj", " }");
    add(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\n# fine so far\nf 1 2 9\n",
        "model.obj",
        " }",
    );
    add(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 three\n",
        "model.obj",
        " }",
    );
    let degenerate = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nv 0 1 0\n";
    add(&format!("{degenerate}f 1 2 3\n"), "model.obj", " }");
    add(
        &format!("{degenerate}g other\nv 1 1 0\nf 1 2 6\nf 1 2 6 7\n"),
        "model.obj",
        " }",
    );
    add("v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n", "model.obj", " }");
    add("# nothing here\n", "model.obj", " }");
    add("v 0 0 0\nv 1 0 0\nf 1 2\n", "model.obj", " }");
    add(TWO_GROUPS, "modle.obj", " }");
    add(TWO_GROUPS, "model.obj", ", scale = 0 }");
    add(TWO_GROUPS, "model.obj", " }\nmaterials = { bse = \"b\" }");
    add(TWO_GROUPS, "model.obj", " }\nmaterials = { base = \"c\" }");
    insta::assert_snapshot!(report);
}

proptest! {
    #[test]
    fn damaged_meshes_do_no_harm(at in 0usize..120, cut in 0usize..20, insert in "[ -~\n]{0,8}") {
        let mut obj = TWO_GROUPS.to_owned();
        let start = at.min(obj.len());
        let end = (start + cut).min(obj.len());
        obj.replace_range(start..end, &insert);
        let source = crate::source::Source { path: Path::new("m.obj"), text: &obj };
        if let Ok(mesh) = crate::obj::parse(&source).and_then(|file| file.cut(&source)) {
            let _ = mesh.shape.polygons();
        }
    }
}
