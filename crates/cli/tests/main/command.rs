//! The command as its users and their scripts meet it.

use crate::place::Place;
use serde_json::Value;
use std::fs;
use std::path::Path;

pub(crate) fn keys(value: &Value) -> Vec<&str> {
    value
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect()
}

#[test]
fn render_reports_one_json_object() {
    let place = Place::new();
    let report = place.json("render room.toml --cache c -o pictures");
    assert_eq!(keys(&report), ["outputs", "patches", "scene", "stages"]);
    assert_eq!(report["scene"], "room");
    assert_eq!(report["patches"], 9 + 1 + 4 + 3);
    let stages = &report["stages"];
    assert_eq!(keys(stages), ["display", "form_factors", "solve"]);
    assert_eq!(
        keys(&stages["form_factors"]),
        [
            "cached",
            "classes",
            "reason",
            "row_background_mean",
            "row_backs_mean",
            "row_error_max",
            "row_error_mean",
            "row_sum_max_error",
            "row_sum_mean",
            "row_sum_mean_error",
            "rows_unbalanced",
            "seconds"
        ]
    );
    assert_eq!(
        keys(&stages["solve"]),
        [
            "cached",
            "converged",
            "energy_balance",
            "error",
            "method",
            "reason",
            "relaxation",
            "residual",
            "seconds",
            "stalled",
            "sweeps"
        ]
    );
    assert_eq!(keys(&stages["display"]), ["exposure", "seconds"]);
    assert_eq!(stages["solve"]["reason"], "nothing cached yet");
    assert_eq!(
        keys(&report["outputs"]),
        ["constant", "constant_png", "smooth", "smooth_png"]
    );
    for path in report["outputs"].as_object().unwrap().values() {
        assert!(place.path(path.as_str().unwrap()).is_file());
    }
}

#[test]
fn a_second_render_computes_neither_form_factors_nor_solution() {
    let place = Place::new();
    let cold = place.json("render room.toml --cache c");
    let pictures = || fs::read(place.path("out/room-smooth.png")).unwrap();
    let first = pictures();
    let warm = place.json("render room.toml --cache c");
    for stage in ["form_factors", "solve"] {
        assert_eq!(cold["stages"][stage]["cached"], false);
        assert_eq!(warm["stages"][stage]["cached"], true);
        assert_eq!(warm["stages"][stage]["reason"], Value::Null);
    }
    for figure in ["row_sum_mean", "row_sum_max_error"] {
        let [a, b] = [&cold, &warm].map(|r| r["stages"]["form_factors"][figure].clone());
        assert_eq!(a, b);
    }
    assert_eq!(pictures(), first);
}

#[test]
fn stages_rerun_alone() {
    let place = Place::new();
    place.succeed("form-factors room.toml --cache c");
    let solved = place.json("solve room.toml --cache c");
    assert_eq!(solved["stages"]["form_factors"]["cached"], true);
    assert_eq!(solved["stages"]["solve"]["cached"], false);
    let again = place.json("solve room.toml --cache c");
    assert_eq!(again["stages"]["solve"]["reason"], "asked for");
    let shown = place.json("display room.toml --cache c --size 8x8 --exposure 2");
    assert_eq!(shown["stages"]["solve"]["cached"], true);
    let forced = place.json("form-factors room.toml --cache c --recompute");
    assert_eq!(forced["stages"]["form_factors"]["reason"], "asked for");
    assert_eq!(keys(&forced["stages"]), ["form_factors"]);
}

#[test]
fn flags_override_the_scene() {
    let place = Place::new();
    let report = place.json("render room.toml --no-cache --divisions 2x5 --size 7x5");
    assert_eq!(report["patches"], 10 + 1 + 4 + 3);
    let header = fs::read(place.path("out/room-constant.ppm")).unwrap();
    assert!(header.starts_with(b"P6\n7 5\n255\n"));
    assert_eq!(report["stages"]["solve"]["reason"], "caching is off");
    let by_length = place.json("solve room.toml --no-cache --max-patch-edge 0.25");
    assert_eq!(
        by_length["patches"],
        16 + 1 + 4 + 2 * 2 + 2 * 4,
        "meshes are cut by length too"
    );
    let loose = place.json("solve room.toml --no-cache --residual 0.1 --max-sweeps 1");
    assert_eq!(loose["stages"]["solve"]["sweeps"], 1);
    for name in ["cg", "conjugate-gradients"] {
        let solved = place.json(&format!("solve room.toml --no-cache --solver {name}"));
        assert_eq!(solved["stages"]["solve"]["method"], "conjugate-gradients");
    }
}

#[test]
fn plain_ppm_is_text() {
    let place = Place::new();
    let report = place.json("render room.toml --no-cache --format plain-ppm");
    assert_eq!(report["outputs"]["smooth"], "out/room-smooth.plain.ppm");
    let text = fs::read_to_string(place.path("out/room-smooth.plain.ppm")).unwrap();
    assert!(text.starts_with("P3\n16 12\n255\n"));
    assert_eq!(text.split_whitespace().count(), 4 + 3 * 16 * 12);
}

#[test]
fn existing_pictures_are_replaced() {
    let place = Place::new();
    fs::create_dir(place.path("out")).unwrap();
    place.write("out/room-smooth.png", "old");
    place.succeed("render room.toml --no-cache");
    let picture = fs::read(place.path("out/room-smooth.png")).unwrap();
    assert!(picture.starts_with(b"\x89PNG"));
    let left = fs::read_dir(place.path("out")).unwrap().count();
    assert_eq!(left, 4, "nothing but the pictures stays");
}

#[test]
fn thread_counts_leave_no_trace_in_any_file() {
    let place = Place::new();
    for threads in [1, 3] {
        place.succeed(&format!(
            "render room.toml --threads {threads} --cache c{threads} -o o{threads}"
        ));
    }
    for (a, b) in [("c1", "c3"), ("o1", "o3")] {
        let names = |folder: &str| {
            let entries = fs::read_dir(place.path(folder)).unwrap();
            let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name()).collect();
            names.sort();
            names
        };
        assert_eq!(names(a), names(b));
        for name in names(a) {
            let [x, y] = [a, b].map(|folder| fs::read(place.path(folder).join(&name)).unwrap());
            assert_eq!(x, y, "{}", Path::new(&name).display());
        }
    }
}

#[test]
fn closure_says_why_it_changes_nothing() {
    let place = Place::new();
    let said = place.succeed("form-factors room.toml --no-cache --closure");
    assert!(said.contains("note: closure changed nothing"), "{said}");
}

#[test]
fn pictures_that_replace_others_say_so() {
    let place = Place::new();
    let render = "render room.toml --cache c --format png --shading smooth";
    let first = place.succeed(render);
    assert!(first.ends_with("out/room-smooth.png\n"), "{first}");
    let second = place.succeed(render);
    assert!(
        second.ends_with("out/room-smooth.png (replaced)\n"),
        "{second}"
    );
}

/// Statistics of rows, convergence and names of files are for those who ask.
#[test]
fn more_is_printed_on_request() {
    let place = Place::new();
    let short = place.succeed("render room.toml --cache c");
    let long = place.succeed("render room.toml --cache c --verbose");
    for detail in [
        "of what leaves a patch",
        "the errors of a row",
        "residual ",
        "kept in ",
    ] {
        assert!(!short.contains(detail), "{short}");
        assert!(long.contains(detail), "{detail} in {long}");
    }
}

#[test]
fn nothing_but_text_is_printed_where_there_is_no_terminal() {
    let place = Place::new();
    let (_, stdout, stderr) = place.run("render room.toml --mode regular --points 8 --patches 6");
    assert!(
        !stdout.contains('\x1b') && !stderr.contains('\x1b'),
        "{stderr}"
    );
    assert_eq!(stderr, "");
}

#[test]
fn shells_and_man_know_the_commands() {
    let place = Place::new();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = place.succeed(&format!("completions {shell}"));
        assert!(script.contains("turntable"), "{shell}");
    }
    place.succeed("man pages");
    let page = fs::read_to_string(place.path("pages/radiosity-render.1")).unwrap();
    assert!(page.contains("Longest edge of a patch") && page.contains("Examples:"));
    place.write("file", "");
    let (code, message) = place.fail("man file");
    assert_eq!(code, 1);
    assert!(
        message.starts_with("error: cannot write file: "),
        "{message}"
    );
}

#[test]
fn help_is_for_strangers() {
    let place = Place::new();
    let mut help = place.succeed("--help");
    help += &place.succeed("help render");
    insta::assert_snapshot!(help);
}
