//! What scenes mean when they are right, and what is said when they are wrong.

mod errors;
mod files;
mod meshes;
mod names;
mod obj;

use crate::{MeshFiles, Scene, SceneError};
use proptest::prelude::*;
use radiosity_geometry::{Shape, SurfaceId};
use std::fmt::Write;
use std::ops::Deref;
use std::path::Path;

const GOOD: &str = r#"
[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
vertical_fov = 40

[materials.white]
reflectance = 0.75

[materials.lamp]
reflectance = [0.1, 0.2, 0.3]
emission = 12

[[surfaces]]
name = "floor"
material = "white"
parallelogram = { corner = [0, 0, 0], edge_a = [1, 0, 0], edge_b = [0, 1, 0] }

[[surfaces]]
name = "wing"
material = "lamp"
triangle = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]
"#;

/// A scene, and what is noted of its files.
#[derive(Debug)]
pub(crate) struct Parsed {
    scene: Scene,
    pub(crate) notes: Vec<String>,
}

impl Deref for Parsed {
    type Target = Scene;

    fn deref(&self) -> &Scene {
        &self.scene
    }
}

/// A scene of which nobody wants more.
pub(crate) fn parse(path: &Path, text: &str) -> Result<Parsed, SceneError> {
    parse_with(path, text, MeshFiles::InFolder)
}

fn parse_with(path: &Path, text: &str, mesh_files: MeshFiles) -> Result<Parsed, SceneError> {
    let loaded = crate::parse(path, text, mesh_files)?;
    loaded.tables.finish()?;
    Ok(Parsed {
        scene: loaded.scene,
        notes: loaded.notes,
    })
}

fn load(path: &Path, mesh_files: MeshFiles) -> Result<Parsed, SceneError> {
    parse_with(path, &crate::read(path)?, mesh_files)
}

fn parse_text(text: &str) -> Result<Parsed, String> {
    parse(Path::new("scenes/test.toml"), text).map_err(|error| error.to_string())
}

/// The error after one replacement in a good scene.
fn error_of(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from}");
    parse_text(&GOOD.replacen(from, to, 1)).expect_err(to)
}

/// Views keep the order of the file.
#[test]
fn views_have_cameras_of_their_own() {
    let view = |name: &str| {
        format!(
            "[[views]]\nname = \"{name}\"\ncamera = {{ position = [0, 5, 0], look_at = [0, 0, 0], \
             up = [0, 0, 1], vertical_fov = 40 }}\n"
        )
    };
    let with = |names: &[&str]| {
        let views: String = names.iter().map(|name| view(name)).collect();
        parse_text(&format!("{GOOD}\n{views}"))
    };
    let scene = with(&["top", "side_2"]).unwrap();
    let names: Vec<&str> = scene.views.iter().map(|view| view.name.as_str()).collect();
    assert_eq!(names, ["top", "side_2"]);
    assert_eq!(scene.views[0].camera.position().y, 5.0);
    for (names, what) in [
        (&["top", "top"][..], "another view has this name already"),
        (&["all"], "this stands for all views"),
        (&["camera"], "this stands for all views"),
        (&["a/b"], "files are named after it"),
        (&[""], "must be some text"),
    ] {
        let error = with(names).expect_err(what);
        assert!(error.contains(what), "{error}");
    }
}

#[test]
fn a_scene_means_what_it_says() {
    let scene = parse_text(GOOD).unwrap();
    assert_eq!(scene.name, "test");
    assert_eq!(scene.surfaces[1].name, "wing");
    assert_eq!(scene.material(SurfaceId(0), 0).reflectance, [0.75; 3]);
    assert_eq!(scene.material(SurfaceId(1), 0).emission, [12.0; 3]);
    assert!(matches!(scene.surfaces[1].shape, Shape::Triangle(_)));
    assert!(scene.camera.is_some() && scene.views.is_empty());
    assert_eq!(scene.surfaces[1].group, "wing", "a group of its own");
    let grouped = GOOD.replace("name = \"wing\"", "name = \"wing\"\ngroup = \"floor\"");
    assert_eq!(parse_text(&grouped).unwrap().surfaces[1].group, "floor");
}

const TUBE: &str = "[[surfaces]]\nname = \"tube\"\nmaterial = \"tube\"\n\
    triangle = [[0, 0, 2], [1, 0, 2], [0, 1, 2]]\n";

#[test]
fn materials_belong_to_lights() {
    let light = |scene: &Scene, material: usize| scene.materials[material].light;
    let scene = parse_text(GOOD).unwrap();
    assert_eq!((light(&scene, 0), light(&scene, 1)), (Some(0), None));
    assert_eq!(scene.lights[0].name, "lamp");
    assert_eq!(scene.lights[0].dimming(), [1.0; 3]);
    let more = "[lights.ceiling]\ndim = 0.5\ntint = [1, 0.5, 0]\n\
        [materials.tube]\nreflectance = 0\nemission = 3\nlight = \"ceiling\"\n\
        [materials.lamp]";
    let unused = GOOD.replace("[materials.lamp]", more);
    assert_eq!(
        parse_text(&unused).unwrap().lights.len(),
        1,
        "no surface is a tube"
    );
    let text = format!("{unused}{TUBE}");
    let scene = parse_text(&text).unwrap();
    let names: Vec<&str> = scene
        .lights
        .iter()
        .map(|light| light.name.as_str())
        .collect();
    assert_eq!(names, ["lamp", "ceiling"]);
    assert_eq!(scene.lights[1].dimming(), [0.5, 0.25, 0.0]);
    let both = text.replace("emission = 12", "emission = 12\nlight = \"ceiling\"");
    let scene = parse_text(&both).unwrap();
    assert_eq!(scene.lights.len(), 1);
    assert_eq!((light(&scene, 0), light(&scene, 1)), (Some(0), Some(0)));
}

/// One mistake per line; the messages are in the snapshot, to be read as a user would.
#[test]
fn mistakes_are_explained() {
    let mistakes = [
        ("reflectance = 0.75", "reflectance = 1.5"),
        ("reflectance = 0.75", "reflectance = nan"),
        ("reflectance = 0.75", "reflectance = [0.5, 0.5]"),
        ("reflectance = 0.75", "reflectance = \"white\""),
        ("reflectance = 0.75", "reflectence = 0.75"),
        ("reflectance = 0.75", ""),
        ("emission = 12", "emission = [12, -1, 0]"),
        ("material = \"white\"", "material = \"whit\""),
        ("material = \"white\"", "material = \"xyz\""),
        ("name = \"wing\"", "name = \"floor\""),
        ("name = \"wing\"", "name = \"\""),
        ("name = \"wing\"", "name = \"wing\"\ngroup = \" \""),
        (
            "name = \"wing\"",
            "name = \"wing\"\ngroup = \"wings\"\nmaterial = \"lamp\"\n\
             triangle = [[0, 0, 9], [1, 0, 9], [0, 1, 9]]\n\
             [[surfaces]]\nname = \"c\"\ngroup = \"wing\"",
        ),
        ("emission = 12", "emission = 1e-170"),
        ("reflectance = 0.75", "reflectance = 0.75\nlight = \"lamp\""),
        ("emission = 12", "emission = 12\nlight = \" \""),
        ("[camera]", "[lights.lampe]\ndim = 0.5\n[camera]"),
        ("[camera]", "[lights.lamp]\ndim = -1\n[camera]"),
        ("[camera]", "[lights.lamp]\ntint = [1, 2, inf]\n[camera]"),
        ("[camera]", "[lights.lamp]\ndimm = 1\n[camera]"),
        (
            "material = \"lamp\"",
            "material = \"lamp\"\nmaterials = { base = \"white\" }",
        ),
        ("edge_b = [0, 1, 0]", "edge_b = [2, 0, 0]"),
        ("edge_b = [0, 1, 0]", "edge_b = [inf, 0, 0]"),
        ("edge_b = [0, 1, 0]", "edge_b = [0, 1]"),
        ("edge_b = [0, 1, 0]", "edge_b = [0, 1, 0, 0.5]"),
        ("position = [0, 0, 5]", "position = [0,5, 0,5, 5,0]"),
        ("[[0, 0, 1], ", "[[0, 0, 1,5], "),
        ("emission = 12", "emission = [1,5, 2,5, 3]"),
        ("[1, 0, 1], ", ""),
        (
            "parallelogram = ",
            "triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\nparallelogram = ",
        ),
        ("parallelogram = ", "quad = "),
        (
            "triangle = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]",
            "quad = [[0, 0, 1], [1, 0, 1], [1, 1, 2], [0, 1, 1]]",
        ),
        ("look_at = [0, 0, 0]", "look_at = [0, 0, 5]"),
        ("look_at = [0, 0, 0]", "look_at = [0, 7, 5]"),
        ("look_at = [0, 0, 0]", ""),
        ("vertical_fov = 40", "vertical_fov = 180"),
        ("[camera]", "[camra]"),
        ("[camera]", "[camera"),
        (
            "parallelogram = { corner = [0, 0, 0], edge_a = [1, 0, 0], edge_b = [0, 1, 0] }",
            "mesh = { file = \"missing.obj\" }",
        ),
    ];
    let mut report = String::new();
    for (from, to) in mistakes {
        let to_line = to.replace('\n', " | ");
        writeln!(report, "{from}  =>  {to_line}\n{}\n", error_of(from, to)).unwrap();
    }
    insta::assert_snapshot!(report);
}

proptest! {
    /// Whatever a damaged file says: an error or a scene, never a panic.
    #[test]
    fn damaged_scenes_do_no_harm(at in 0usize..600, cut in 0usize..40, insert in ".{0,8}") {
        let mut chars: Vec<char> = GOOD.chars().collect();
        let start = at.min(chars.len());
        let end = (start + cut).min(chars.len());
        chars.splice(start..end, insert.chars());
        let _ = parse_text(&chars.into_iter().collect::<String>());
    }
}
