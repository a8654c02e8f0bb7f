//! What scene files say of parameters, and what is said when they are wrong.

use super::*;
use radiosity_form_factors::Mode;
use radiosity_image::{Curve, Exposure, Transfer};
use radiosity_solver::{Method, Relaxation};
use std::fmt::Write;

pub(crate) const GOOD: &str = r#"[image]
width = 320
exposure = "auto"
gamma = "srgb"

[discretization]
divisions = 5

[form_factors]
mode = "monte-carlo"

[solver]
method = "conjugate-gradients"
relaxation = 1.5

[materials.white]
reflectance = 0.75

[[surfaces]]
name = "floor"
material = "white"
divisions = [3, 4]
parallelogram = { corner = [0, 0, 0], edge_a = [1, 0, 0], edge_b = [0, 1, 0] }

[[surfaces]]
name = "wing"
material = "white"
max_patch_edge = 0.25
triangle = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]

[[surfaces]]
name = "plain"
material = "white"
triangle = [[0, 0, 2], [1, 0, 2], [0, 1, 2]]
"#;

pub(crate) fn parse(text: &str) -> Result<Project, String> {
    let project = Project::parse("scenes/test.toml".as_ref(), text);
    project.map_err(|error| error.to_string())
}

#[test]
fn tables_are_parameters() {
    let Project { params, notes, .. } = parse(GOOD).unwrap();
    assert_eq!((params.image.width, params.image.height), (320, 480));
    assert_eq!(params.image.exposure, Exposure::Automatic);
    assert_eq!(params.image.gamma, Transfer::Srgb);
    assert_eq!(params.form_factors.mode, Mode::MonteCarlo);
    assert_eq!(params.solver.method, Method::ConjugateGradients);
    assert_eq!(params.solver.relaxation, Relaxation::Factor(1.5));
    assert_eq!(params.discretization.default, Divisions::uniform(5));
    let own = &params.discretization.surfaces;
    assert_eq!(own["floor"], Divisions::Count { a: 3, b: 4 });
    assert_eq!(own["wing"], Divisions::MaxEdge(0.25));
    assert_eq!(own.len(), 2);
    assert!(notes.is_empty());
}

#[test]
fn what_is_not_said_has_defaults() {
    let scene_alone = GOOD.split_once("[materials").unwrap().1;
    let Project { params, .. } = parse(&format!("[materials{scene_alone}")).unwrap();
    let surfaces = params.discretization.surfaces.clone();
    let discretization = Discretization {
        default: Divisions::uniform(12),
        surfaces,
    };
    assert_eq!(
        params,
        Params {
            discretization,
            ..Params::default()
        }
    );
    let image = params.image;
    assert_eq!((image.width, image.height), (640, 480));
    assert_eq!((image.subpixels, image.samples), (2, 4));
    assert_eq!(image.exposure, Exposure::Automatic);
    assert_eq!(image.gamma, Transfer::Srgb);
    assert_eq!((image.tone, image.dither), (Curve::Clamp, false));
    assert_eq!(
        (params.form_factors.mode, params.form_factors.points),
        (Mode::Accurate, 3)
    );
    assert_eq!(
        (params.solver.residual, params.solver.max_sweeps),
        (1e-6, 200)
    );
    assert_eq!(params.solver.method, Method::GaussSeidel);
    assert_eq!(params.solver.relaxation, Relaxation::Automatic);
}

#[test]
fn old_names_are_read_with_a_note() {
    let old = GOOD.replace("relaxation = 1.5", "tolerance = 1e-4");
    let Project { params, notes, .. } = parse(&old).unwrap();
    assert_eq!(params.solver.residual, 1e-4);
    assert_eq!(notes.len(), 1);
    assert!(notes[0].contains("`tolerance` of [solver] is called `residual` now"));
}

/// Programs may keep parameters in files of their own.
#[test]
fn parameters_are_written_as_they_are_read() {
    let text = GOOD.replace("divisions = [3, 4]", "divisions = \"none\"");
    let Project { params, .. } = parse(&text).unwrap();
    assert_eq!(params.discretization.surfaces["floor"], Divisions::Uncut);
    let text = serde_json::to_string(&params).unwrap();
    assert_eq!(serde_json::from_str::<Params>(&text).unwrap(), params);
    let read = |text| serde_json::from_str::<Params>(text);
    let one_count = read(r#"{"discretization": {"default": {"divisions": 5}}}"#).unwrap();
    assert_eq!(one_count.discretization.default, Divisions::uniform(5));
    assert!(read(r#"{"discretization": {"divisions": 5}}"#).is_err());
}

/// One mistake per line; the messages are in the snapshot, to be read as a user would.
#[test]
fn mistakes_are_explained() {
    let mistakes = [
        ("relaxation = 1.5", "relaxation = 2"),
        ("relaxation = 1.5", "relaxation = \"fast\""),
        ("relaxation = 1.5", "residual = 0"),
        ("relaxation = 1.5", "tolerance = 0"),
        ("relaxation = 1.5", "tolerance = 1e-4\nresidual = 1e-4"),
        ("relaxation = 1.5", "max_sweeps = 0"),
        ("\"conjugate-gradients\"", "\"jacobi\""),
        ("divisions = [3, 4]", "divisions = [3, 4, 5]"),
        ("max_patch_edge = 0.25", "divisions = 0"),
        ("max_patch_edge = 0.25", "divisions = -3"),
        ("max_patch_edge = 0.25", "max_patch_edge = 0"),
        ("divisions = [3, 4]", "divisions = 3\nmax_patch_edge = 0.5"),
        ("divisions = 5", "divisions = 5\nmax_patch_edge = 0.5"),
        ("divisions = [3, 4]", "divison = 3"),
        ("divisions = [3, 4]", "divisions = \"all\""),
        ("max_patch_edge = 0.25", "divisions = [2, 3]"),
        ("[materials.white]", "[material.white]"),
        ("[image]\n", "image = 3\n[images]\n"),
        ("width = 320", "width = 0"),
        ("width = 320", "crease_angle = 200"),
        ("width = 320", "tone = \"film\""),
        ("width = 320", "widht = 320"),
        ("exposure = \"auto\"", "exposure = -1"),
        ("exposure = \"auto\"", "exposure = \"bright\""),
        ("gamma = \"srgb\"", "gamma = \"rgb\""),
        ("\"monte-carlo\"", "\"reguler\""),
        ("mode = \"monte-carlo\"", "tolerance = 0.5"),
        ("mode = \"monte-carlo\"", "points = 65"),
        ("mode = \"monte-carlo\"", "pairs = 0"),
        ("[form_factors]", "[form_factor]"),
        ("[form_factors]", "[video]"),
    ];
    let mut report = String::new();
    for (from, to) in mistakes {
        assert!(GOOD.contains(from), "{from}");
        let error = parse(&GOOD.replacen(from, to, 1)).expect_err(to);
        let to_line = to.replace('\n', " | ");
        writeln!(report, "{from}  =>  {to_line}\n{error}\n").unwrap();
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
            let project = Project::open(&path).unwrap_or_else(|error| panic!("{error}"));
            let text = std::fs::read_to_string(&path).unwrap();
            assert!(text.starts_with("# "), "{}", path.display());
            assert!(project.scene.camera.is_some() && project.notes.is_empty());
            names.push(project.scene.name);
        }
    }
    for name in [
        "cornell",
        "cornell-closed",
        "cornell-course",
        "cornell-course-triangles",
        "cornell-triangles",
        "furnace",
        "knot",
    ] {
        assert!(names.iter().any(|n| n == name), "{name}");
    }
}
