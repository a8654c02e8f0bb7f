//! What pictures show, from where, and what files say of themselves.

use crate::place::{Place, SCENE};
use std::fs;

/// With two more views.
fn with_views(place: &Place) {
    let views = r#"
[[views]]
name = "top"
camera = { position = [0.5, 3, 0.5], look_at = [0.5, 0, 0.5], up = [0, 0, -1], vertical_fov = 30 }

[[views]]
name = "side"
camera = { position = [-2, 0.5, 0.5], look_at = [0.5, 0.5, 0.5], vertical_fov = 30 }
"#;
    place.write("views.toml", &format!("{SCENE}{views}"));
}

/// The names of all outputs.
fn outputs(place: &Place, arguments: &str) -> Vec<String> {
    let report = place.json(&format!("display {arguments} --no-cache"));
    let outputs = report["outputs"].as_object().unwrap();
    for path in outputs.values() {
        assert!(place.path(path.as_str().unwrap()).is_file(), "{path}");
    }
    outputs.keys().cloned().collect()
}

#[test]
fn pictures_are_named_after_view_quantity_and_shading() {
    let place = Place::new();
    with_views(&place);
    let names = |arguments: &str| outputs(&place, &format!("views.toml --format png {arguments}"));
    assert_eq!(names(""), ["constant", "smooth"]);
    assert_eq!(names("--views top --direct exact"), ["top-exact"]);
    assert_eq!(names("--shading smooth,exact,smooth"), ["exact", "smooth"]);
    assert_eq!(
        names("--views all --gather 2"),
        ["gathered", "side-gathered", "top-gathered"]
    );
    assert_eq!(
        names("--views camera,side --show illuminance,error --direct exact --sheet"),
        [
            "error-constant",
            "illuminance-exact",
            "sheet",
            "side-error-constant",
            "side-illuminance-exact"
        ]
    );
    assert_eq!(
        names("--factors-of floor:1,2 --isolines --patch-lines --log"),
        ["form-factors-constant"]
    );
    assert_eq!(
        names("--turntable 3 --backs transparent --direct exact"),
        [
            "turntable-0001-exact",
            "turntable-0002-exact",
            "turntable-0003-exact"
        ]
    );
    assert_eq!(
        names("--path 2 --show direct --direct exact"),
        ["path-0001-direct-exact", "path-0002-direct-exact"]
    );
    assert_eq!(
        names("--views all,top --turntable 1 --shading smooth,constant --show direct"),
        [
            "side-turntable-0001-direct-constant",
            "side-turntable-0001-direct-smooth",
            "top-turntable-0001-direct-constant",
            "top-turntable-0001-direct-smooth",
            "turntable-0001-direct-constant",
            "turntable-0001-direct-smooth"
        ]
    );
    // The first frame of a turn is the view itself, and a path begins and ends at views.
    let bytes = |name: &str| fs::read(place.path(&format!("out/views-{name}.ppm"))).unwrap();
    // The exposure depends on all that a run sees.
    names("--format ppm --views all --show light,direct --direct exact --exposure 2");
    let (first, last) = (bytes("direct-exact"), bytes("side-direct-exact"));
    let alone = bytes("exact");
    names("--format ppm --turntable 3 --direct exact --exposure 2");
    names("--format ppm --path 2 --show direct --direct exact --exposure 2");
    assert!(bytes("turntable-0001-exact") == alone);
    assert!(bytes("path-0001-direct-exact") == first && bytes("path-0002-direct-exact") == last);
}

/// Nothing is written, or even solved for, if one of the pictures cannot be made.
#[test]
fn what_cannot_be_made_is_refused_at_once() {
    let place = Place::new();
    let view = "[[views]]\nname = \"direct\"\n\
                camera = { position = [0.5, 0.5, 3], look_at = [0, 0, 0], vertical_fov = 30 }";
    place.write("direct.toml", &format!("{SCENE}{view}"));
    for (arguments, expected) in [
        (
            "direct.toml --views all --show light,direct",
            "two pictures would be called `direct-constant`",
        ),
        (
            "room.toml --mode regular --show light,error",
            "use --mode accurate",
        ),
    ] {
        let (code, message) = place.fail(&format!("render {arguments} --cache c"));
        assert_eq!(code, 3);
        assert!(message.contains(expected), "{message}");
    }
    assert!(!place.path("c").exists() && !place.path("out").exists());
}

/// Quantities that need form factors say where they had them from; and without a cache they are
/// estimated once.
#[test]
fn form_factors_are_made_once() {
    let place = Place::new();
    let report = place.json("display room.toml --cache c --show irradiance");
    assert_eq!(
        report["stages"]["form_factors"]["reason"],
        "nothing cached yet"
    );
    for entry in fs::read_dir(place.path("c")).unwrap() {
        let path = entry.unwrap().path();
        if path.to_string_lossy().contains("form-factors") {
            fs::remove_file(path).unwrap();
        }
    }
    // The solution is still there.
    let report = place.json("display room.toml --cache c --show irradiance,error");
    assert_eq!(
        report["stages"]["form_factors"]["reason"],
        "nothing cached yet"
    );
    assert_eq!(report["stages"]["solve"]["cached"], true);
    let all = "--show irradiance,illuminance,error --factors-of floor:1,1";
    let (_, _, stderr) = place.run(&format!("display room.toml --no-cache {all} --json"));
    let lines = stderr
        .lines()
        .filter(|line| line.starts_with("form factors"));
    assert_eq!(lines.count(), 1, "{stderr}");
}

/// A lamp alone is the others switched off; and switched off itself, it is dark.
#[test]
fn one_light_can_be_shown_alone() {
    let place = Place::new();
    let two = SCENE.replace("reflectance = 0.7", "reflectance = 0.7\nemission = 0.1");
    place.write("two.toml", &two);
    let picture = |flags: &str| {
        place.succeed(&format!("display two.toml --cache c --format ppm {flags}"));
        fs::read(place.path("out/two-smooth.ppm")).unwrap()
    };
    let alone = picture("--only lamp");
    assert!(alone == picture("--dim white=0"));
    assert!(alone != picture("") && alone != picture("--only white"));
    assert!(picture("--only lamp,white") == picture(""));
}

/// Twice the lumens are twice the illuminance, whatever the exposure.
#[test]
fn illuminance_has_a_scale() {
    let place = Place::new();
    let mean = |flags: &str| -> f32 {
        let show = "--show illuminance --direct exact --format pfm";
        place.succeed(&format!("display room.toml --no-cache {show} {flags}"));
        let bytes = fs::read(place.path("out/room-illuminance-exact.pfm")).unwrap();
        let channels = bytes[bytes.len() - 12 * 16 * 12..]
            .as_chunks::<4>()
            .0
            .iter();
        channels.map(|channel| f32::from_le_bytes(*channel)).sum()
    };
    let ratio = mean("--lumens-per-watt 200 --exposure 3") / mean("--lumens-per-watt 100");
    assert!((ratio - 2.0).abs() < 1e-5, "{ratio}");
}

#[test]
fn what_cannot_be_shown_is_explained() {
    let place = Place::new();
    with_views(&place);
    for (arguments, code, expected) in [
        ("views.toml --views tap", 3, "did you mean `top`?"),
        (
            "room.toml --path 5",
            3,
            "a path goes through two views at least",
        ),
        (
            "room.toml --factors-of floor:9,9",
            3,
            "there is no patch 9,9 on a surface `floor`",
        ),
        ("room.toml --factors-of floor", 2, "like floor:3,4"),
        (
            "room.toml --show error --mode regular",
            3,
            "use --mode accurate",
        ),
        ("room.toml --only lampe", 3, "did you mean `lamp`?"),
        ("room.toml --turntable 3 --path 3", 2, "cannot be used with"),
        (
            "room.toml --direct exact --gather 2",
            2,
            "cannot be used with",
        ),
        (
            "views.toml --views all,nonsense",
            3,
            "there is no view `nonsense`",
        ),
        ("room.toml --top 1e-300", 2, "between 1e-30 and 1e30"),
        ("--gather room.toml", 2, "a scene's name goes before it"),
        (
            "room.toml --gather 5000",
            2,
            "--gather must be between 1 and 4096",
        ),
        (
            "room.toml --samples 65",
            2,
            "--samples must be between 1 and 64",
        ),
        (
            "room.toml --exposure -1",
            2,
            "--exposure must be a positive number",
        ),
        (
            "room.toml --max-sweeps 0",
            2,
            "--max-sweeps must be at least 1",
        ),
    ] {
        let (found, message) = place.fail(&format!("display {arguments} --no-cache"));
        assert_eq!(found, code, "{arguments}: {message}");
        assert!(message.contains(expected), "{arguments}: {message}");
    }
}
