//! Names of a size that nobody prints.

use super::meshes::MeshScene;
use super::{GOOD, Parsed, parse, parse_text};
use std::path::Path;

/// So much of an error or note can be printed.
const PRINTABLE: usize = 8000;

fn long() -> String {
    "näm".repeat(25_000)
}

#[track_caller]
fn assert_is_refused(error: Result<Parsed, String>, expected: &str) {
    let error = error.unwrap_err();
    assert!(error.len() < PRINTABLE, "{} bytes", error.len());
    assert!(error.contains(expected), "{error}");
}

#[test]
fn names_of_scenes_have_limits() {
    let limit = "must be at most 400 bytes long";
    for (from, to, expected) in [
        ("name = \"wing\"", "name = \"LONG\"", limit),
        (
            "name = \"wing\"",
            "name = \"wing\"\ngroup = \"LONG\"",
            limit,
        ),
        ("[materials.white]", "[materials.\"LONG\"]", limit),
        ("emission = 12", "emission = 12\nlight = \"LONG\"", limit),
        (
            "material = \"white\"",
            "material = \"LONG\"",
            "there is no material `nämnäm",
        ),
        (
            "[camera]",
            "[lights.\"LONG\"]\n[camera]",
            "there is no light `nämnäm",
        ),
        (
            "vertical_fov",
            "\"LONG\" = 1\nvertical_fov",
            "unknown field `nämnäm",
        ),
        (
            "[camera]",
            "[\"LONG\"]\n[camera]",
            "there is no table `nämnäm",
        ),
        (
            "name = \"wing\"",
            "\"LONG\" = 1\nname = \"wing\"",
            "there is no key `nämnäm",
        ),
        (
            "look_at = [0, 0, 0]",
            "\"LONG\" = 1, look_at = 7",
            "cannot read this scene",
        ),
    ] {
        let text = GOOD.replacen(from, to, 1).replace("LONG", &long());
        assert_is_refused(parse_text(&text), expected);
    }
}

#[test]
fn names_of_meshes_have_limits() {
    for (line, expected) in [
        ("g LONG", "this name has 100000 bytes"),
        ("usemtl LONG", "this name has 100000 bytes"),
        ("f LONG", "is no vertex"),
        ("f 1 2 3 LONG", "is no vertex"),
        ("v LONG 0 0\nf 1 2 4", "is no number"),
    ] {
        let obj = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{line}\nf 1 2 3\n").replace("LONG", &long());
        assert_is_refused(MeshScene::new(obj).parse("model.obj", " }"), expected);
    }
    let unknown = format!("{}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", long());
    let scene = MeshScene::new(unknown).parse("model.obj", " }").unwrap();
    assert!(scene.notes[0].len() < PRINTABLE);
}

#[test]
fn names_of_view3d_have_limits() {
    let vertices = "F 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 0 1 0\n";
    let parse = |lines: &str| {
        let text = format!("{vertices}{lines}\n").replace("LONG", &long());
        parse(Path::new("a.vs3"), &text).map_err(|error| error.to_string())
    };
    assert_is_refused(parse("S 1 1 2 3 0 0 0 1 LONG"), "has 100000 bytes");
    assert_is_refused(
        parse("S 1 1 2 3 LONG 0 0 1 a"),
        "expected the number of a vertex",
    );
    let scene = parse("C LONG=1\nS 1 1 2 3 0 0 0 1 a").unwrap();
    assert!(scene.notes[0].len() < PRINTABLE);
}
