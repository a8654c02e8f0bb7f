//! From a file to a scene, and what the file says beside.

use crate::camera::{camera, views};
use crate::error::SceneError;
use crate::file::{SceneFile, TABLES};
use crate::input::{self, MeshFiles};
use crate::light::{keep_used, lights};
use crate::material::materials;
use crate::scene::Scene;
use crate::signature::foreign;
use crate::source::Source;
use crate::surface::{SurfaceReader, Surfaces};
use crate::tables::Tables;
use crate::toml_error::error_of;
use crate::vs3;
use serde::Deserialize;
use serde::de::IntoDeserializer;
use std::path::Path;
use toml::de::DeTable;

/// A scene, and what its file says beside.
pub struct Loaded<'t> {
    /// The scene.
    pub scene: Scene,
    /// Tables that are no part of it.
    pub tables: Tables<'t>,
    /// Notes for the user: parts of the files that are ignored or left out.
    pub notes: Vec<String>,
}

/// Reads the text of a scene file (TOML, or `.vs3` of View3D).
pub fn read(path: &Path) -> Result<String, SceneError> {
    if ends_in(path, "obj") {
        let help = "write a scene file with a surface: mesh = { file = \"NAME.obj\" }";
        return Err(SceneError::of_file(
            path,
            "this is a mesh, not a scene",
            help,
        ));
    }
    let bytes = input::read(path).map_err(|error| {
        let title = format!("cannot read the scene: {error}");
        SceneError::of_file(path, &title, "give the path of a scene file (.toml, .vs3)")
    })?;
    if let Some(format) = foreign(&bytes) {
        let title = format!("the scene is {}, which is not read", format.name);
        return Err(SceneError::of_file(path, &title, &format.help_for_scenes()));
    }
    // Comments and names of View3D may be in any encoding.
    String::from_utf8(bytes).or_else(|error| match ends_in(path, "vs3") {
        true => Ok(String::from_utf8_lossy(error.as_bytes()).into_owned()),
        false => {
            let title = "the scene is no text in UTF-8";
            Err(SceneError::of_file(path, title, "save it as UTF-8"))
        }
    })
}

fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

/// Checks the text of a scene file; `path` says by its ending what kind it is, is what errors name,
/// and meshes are relative to it.
pub fn parse<'t>(
    path: &'t Path,
    text: &'t str,
    mesh_files: MeshFiles,
) -> Result<Loaded<'t>, SceneError> {
    let source = Source { path, text };
    if ends_in(path, "vs3") {
        let (scene, notes) = vs3::parse(&source)?;
        let tables = Tables::none(source);
        return Ok(Loaded {
            scene,
            tables,
            notes,
        });
    }
    let document = DeTable::parse(text).map_err(|error| error_of(&source, &error, 0..0))?;
    let (document, tables) = Tables::split(source, document, &TABLES);
    if let Some(error) = tables.mistyped(document.get_ref()) {
        return Err(error);
    }
    let file = SceneFile::deserialize(document.into_deserializer());
    let file = file.map_err(|error| error_of(&source, &error, 0..0))?;
    let (scene, notes) = scene(source, file, mesh_files)?;
    Ok(Loaded {
        scene,
        tables,
        notes,
    })
}

fn scene(
    source: Source<'_>,
    file: SceneFile,
    mesh_files: MeshFiles,
) -> Result<(Scene, Vec<String>), SceneError> {
    let path = source.path;
    if file.surfaces.is_empty() {
        let help = "add [[surfaces]], each with a `name`, a `material` and a shape like \
                    quad = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]";
        return Err(SceneError::of_file(path, "the scene has no surfaces", help));
    }
    let camera = file.camera.as_ref().map(|table| camera(&source, table));
    let (mut materials, names) = materials(&source, file.materials)?;
    let lights = lights(&source, &names, &file.lights)?;
    let context = SurfaceReader {
        source,
        folder: path.parent().unwrap_or(Path::new("")),
        mesh_files,
        materials: &materials,
    };
    let Surfaces { surfaces, notes } = context.surfaces(&file.surfaces)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let lights = keep_used(lights, &mut materials, &surfaces);
    let scene = Scene {
        surfaces,
        camera: camera.transpose()?,
        views: views(&source, &file.views)?,
        materials,
        lights,
        ..Scene::new(&name)
    };
    Ok((scene, notes))
}
