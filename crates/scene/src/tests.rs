//! What scenes mean when they are right, and what is said when they are wrong.
//!
//! Long because: one table of all mistakes.

mod errors;
mod files;
mod meshes;
mod names;
mod obj;

use crate::{Automatic, Exposure, Gamma, Mode, Relaxation, Scene, SolverMethod, Tone, parse};
use proptest::prelude::*;
use radiosity_geometry::{Divisions, Shape, SurfaceId};
use std::fmt::Write;
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
divisions = [3, 4]
parallelogram = { corner = [0, 0, 0], edge_a = [1, 0, 0], edge_b = [0, 1, 0] }

[[surfaces]]
name = "wing"
material = "lamp"
max_patch_edge = 0.25
triangle = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]
"#;

fn parse_text(text: &str) -> Result<Scene, String> {
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
    assert_eq!(
        scene.geometry[0].divisions,
        Some(Divisions::Count { a: 3, b: 4 })
    );
    assert_eq!(scene.geometry[1].divisions, Some(Divisions::MaxEdge(0.25)));
    assert_eq!(scene.material(SurfaceId(0), 0).reflectance, [0.75; 3]);
    assert_eq!(scene.material(SurfaceId(1), 0).emission, [12.0; 3]);
    assert!(matches!(scene.geometry[1].shape, Shape::Triangle(_)));
    assert!(scene.camera.is_some() && scene.views.is_empty());
    assert_eq!(scene.surfaces[1].group, "wing", "a group of its own");
    let grouped = GOOD.replace("name = \"wing\"", "name = \"wing\"\ngroup = \"floor\"");
    assert_eq!(parse_text(&grouped).unwrap().surfaces[1].group, "floor");
}

#[test]
fn what_is_not_said_has_defaults() {
    let scene = parse_text(GOOD).unwrap();
    assert_eq!(scene.divisions, Divisions::uniform(12));
    assert_eq!((scene.image.width, scene.image.height), (640, 480));
    assert_eq!((scene.image.subpixels, scene.image.samples), (2, 4));
    assert_eq!(scene.image.exposure, Exposure::Factor(1.0));
    assert_eq!(scene.image.gamma, Gamma::Exponent(2.2));
    assert_eq!((scene.image.tone, scene.image.dither), (Tone::Clamp, false));
    assert_eq!(scene.image.crease_angle, 30.0);
    assert_eq!(
        (scene.form_factors.mode, scene.form_factors.points),
        (Mode::Accurate, 3)
    );
    assert_eq!(
        (scene.solver.tolerance, scene.solver.max_sweeps),
        (1e-6, 200)
    );
    assert_eq!(scene.solver.method, SolverMethod::GaussSeidel);
    assert_eq!(scene.solver.relaxation, Relaxation::Named(Automatic::Auto));
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
        ("[camera]", "[solver]\nrelaxation = 2\n[camera]"),
        ("[camera]", "[solver]\nrelaxation = \"fast\"\n[camera]"),
        ("[camera]", "[solver]\nmethod = \"jacobi\"\n[camera]"),
        ("max_patch_edge = 0.25", "materials = { base = \"white\" }"),
        ("edge_b = [0, 1, 0]", "edge_b = [2, 0, 0]"),
        ("edge_b = [0, 1, 0]", "edge_b = [inf, 0, 0]"),
        ("edge_b = [0, 1, 0]", "edge_b = [0, 1]"),
        ("edge_b = [0, 1, 0]", "edge_b = [0, 1, 0, 0.5]"),
        ("position = [0, 0, 5]", "position = [0,5, 0,5, 5,0]"),
        ("[[0, 0, 1], ", "[[0, 0, 1,5], "),
        ("emission = 12", "emission = [1,5, 2,5, 3]"),
        ("divisions = [3, 4]", "divisions = [3, 4, 5]"),
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
        ("max_patch_edge = 0.25", "divisions = [2, 3]"),
        ("max_patch_edge = 0.25", "divisions = 0"),
        ("max_patch_edge = 0.25", "divisions = -3"),
        ("max_patch_edge = 0.25", "max_patch_edge = 0"),
        ("divisions = [3, 4]", "divisions = 3\nmax_patch_edge = 0.5"),
        ("look_at = [0, 0, 0]", "look_at = [0, 0, 5]"),
        ("look_at = [0, 0, 0]", "look_at = [0, 7, 5]"),
        ("look_at = [0, 0, 0]", ""),
        ("vertical_fov = 40", "vertical_fov = 180"),
        ("[camera]", "[image]\nwidth = 0\n[camera]"),
        ("[camera]", "[image]\nexposure = -1\n[camera]"),
        ("[camera]", "[image]\nexposure = \"bright\"\n[camera]"),
        ("[camera]", "[image]\ngamma = \"rgb\"\n[camera]"),
        ("[camera]", "[image]\ntone = \"film\"\n[camera]"),
        ("[camera]", "[image]\ncrease_angle = 200\n[camera]"),
        ("[camera]", "[form_factors]\nmode = \"reguler\"\n[camera]"),
        ("[camera]", "[solver]\ntolerance = 0\n[camera]"),
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

#[test]
fn shipped_scenes_are_good_and_open_with_a_comment() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            let scene = crate::load(&path).unwrap_or_else(|error| panic!("{error}"));
            let text = std::fs::read_to_string(&path).unwrap();
            assert!(text.starts_with("# "), "{}", path.display());
            assert!(scene.camera.is_some());
            names.push(scene.name);
        }
    }
    for name in [
        "cornell",
        "cornell-closed",
        "cornell-triangles",
        "furnace",
        "knot",
    ] {
        assert!(names.iter().any(|n| n == name), "{name}");
    }
}

/// The scene in the README, without its mesh.
#[test]
fn the_readme_tells_the_truth() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../README.md");
    let readme = std::fs::read_to_string(path).unwrap();
    let scene = readme
        .split("```toml\n")
        .nth(1)
        .unwrap()
        .split("```")
        .next()
        .unwrap();
    let without_mesh = scene.rsplit_once("[[surfaces]]").unwrap().0;
    let scene = parse_text(without_mesh).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.surfaces.len(), 2);
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
