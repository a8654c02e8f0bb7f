//! The command as its users and their scripts meet it.

use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A small room with a lamp, a triangle and a mesh.
const SCENE: &str = r#"
[camera]
position = [0.5, 0.5, 3]
look_at = [0.5, 0.5, 0]
vertical_fov = 30

[image]
width = 16
height = 12

[discretization]
divisions = 3

[materials.white]
reflectance = 0.7

[materials.lamp]
reflectance = 0
emission = [4, 3, 2]

[[surfaces]]
name = "floor"
material = "white"
parallelogram = { corner = [0, 0, 1], edge_a = [1, 0, 0], edge_b = [0, 0, -1] }

[[surfaces]]
name = "lamp, the only one"
material = "lamp"
divisions = 1
parallelogram = { corner = [0.3, 1, 0.3], edge_a = [0.4, 0, 0], edge_b = [0, 0, 0.4] }

[[surfaces]]
name = "wing"
material = "white"
divisions = 2
triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]

[[surfaces]]
name = "block"
material = "white"
mesh = { file = "block.obj" }
"#;

const BLOCK: &str = "v 0.6 0.2 0.2\nv 0.9 0.2 0.2\nv 0.9 0.2 0.5\nv 0.6 0.2 0.5\n\
    v 0.6 0.4 0.35\nf 4 3 2 1\nf 1 5 4\nf 4 5 3\n";

/// An L of six corners, and a triangle beside it.
const BENT: &str = "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nv 3 0 0\n\
    f 1 2 3 4 5 6\nf 1 7 2\n";

/// Two squares so close that one point on each overestimates their form factor 40 times.
const NARROW_GAP: &str = r#"
discretization = { divisions = 1 }
form_factors = { points = 1 }

[materials.white]
reflectance = 0.7
emission = 1

[[surfaces]]
name = "below"
material = "white"
quad = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]

[[surfaces]]
name = "above"
material = "white"
quad = [[0, 0, 0.1], [0, 1, 0.1], [1, 1, 0.1], [1, 0, 0.1]]
"#;

/// A folder with the scene, where the command runs.
struct Place(TempDir);

impl Place {
    fn new() -> Place {
        let place = Place(TempDir::new().unwrap());
        place.write("room.toml", SCENE);
        place.write("block.obj", BLOCK);
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    /// Runs with `arguments` apart by spaces; exit code, standard output and error.
    fn run(&self, arguments: &str) -> (i32, String, String) {
        let output = self.command(arguments).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (
            output.status.code().unwrap(),
            text(output.stdout),
            text(output.stderr),
        )
    }

    fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_radiosity"));
        command
            .args(arguments.split(' '))
            .current_dir(self.0.path())
            .env("XDG_CACHE_HOME", self.path("platform-cache"));
        command
    }

    fn succeed(&self, arguments: &str) -> String {
        let (code, stdout, stderr) = self.run(arguments);
        assert_eq!(code, 0, "{arguments}: {stderr}");
        stdout
    }

    fn json(&self, arguments: &str) -> Value {
        let stdout = self.succeed(&format!("{arguments} --json"));
        assert_eq!(stdout.lines().count(), 1, "exactly one line: {stdout}");
        serde_json::from_str(&stdout).unwrap()
    }

    /// The message of a run that must fail, with its exit code.
    fn fail(&self, arguments: &str) -> (i32, String) {
        let (code, stdout, stderr) = self.run(arguments);
        assert_ne!(code, 0, "{arguments}: {stdout}");
        assert!(!stderr.contains("panicked"), "{stderr}");
        (
            code,
            stderr.replace(&self.0.path().display().to_string(), "PLACE"),
        )
    }
}

fn keys(value: &Value) -> Vec<&str> {
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
            "reason",
            "row_sum_max_error",
            "row_sum_mean",
            "seconds"
        ]
    );
    assert_eq!(
        keys(&stages["solve"]),
        [
            "cached",
            "converged",
            "energy_balance",
            "reason",
            "residual",
            "seconds",
            "sweeps"
        ]
    );
    assert_eq!(keys(&stages["display"]), ["seconds"]);
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
    let report = place.json("render room.toml --no-cache --patches 2x5 --size 7x5");
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
    let loose = place.json("solve room.toml --no-cache --tolerance 0.1 --max-sweeps 1");
    assert_eq!(loose["stages"]["solve"]["sweeps"], 1);
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
fn radiosities_are_exported_in_input_order() {
    let place = Place::new();
    let report = place.json("solve room.toml --no-cache --export table.csv");
    assert_eq!(report["outputs"]["export"], "table.csv");
    let table = fs::read_to_string(place.path("table.csv")).unwrap();
    let cells: Vec<String> = table
        .lines()
        .map(|line| line.rsplitn(4, ',').last().unwrap().to_owned())
        .collect();
    assert_eq!(table.lines().next(), Some("surface,ia,ib,B_r,B_g,B_b"));
    assert_eq!(cells[1..4], ["floor,0,0", "floor,0,1", "floor,0,2"]);
    assert_eq!(cells[10], "\"lamp, the only one\",0,0");
    assert_eq!(
        cells[11..15],
        ["wing,0,0", "wing,0,1", "wing,0,2", "wing,1,0"]
    );
    assert_eq!(cells[15..], ["block,0,0", "block,1,0", "block,2,0"]);
    place.write("block.obj", BENT);
    place.succeed("solve room.toml --no-cache --export bent.csv");
    let bent = fs::read_to_string(place.path("bent.csv")).unwrap();
    let cell = |line: &str| line.split(',').take(3).collect::<Vec<_>>().join(",");
    let cells: Vec<String> = bent.lines().skip(15).map(cell).collect();
    assert_eq!(
        cells,
        [
            "block,0,0",
            "block,0,1",
            "block,0,2",
            "block,0,3",
            "block,1,0"
        ]
    );
    let lamp = table.lines().nth(10).unwrap();
    assert!(
        lamp.ends_with(",4,3,2"),
        "a black lamp shows what it emits: {lamp}"
    );
}

/// The oracle: bytes depend on samples and seed, not on threads; both float maps are there.
#[test]
fn reference_pictures_are_traced() {
    let place = Place::new();
    for threads in [1, 3] {
        let output = format!("reference room.toml --spp 8 --threads {threads} -o o{threads}");
        let said = place.succeed(&output);
        assert!(said.contains("8 walks per pixel"), "{said}");
    }
    for file in [
        "room-reference.pfm",
        "room-reference-error.pfm",
        "room-reference.png",
    ] {
        let [a, b] = ["o1", "o3"].map(|folder| fs::read(place.path(folder).join(file)).unwrap());
        assert_eq!(a, b);
    }
    let map = fs::read(place.path("o1/room-reference.pfm")).unwrap();
    assert!(map.starts_with(b"PF\n16 12\n-1.0\n"));
    assert_eq!(map.len(), 14 + 12 * 16 * 12);
    let said = place.succeed("reference room.toml --error 20");
    let error = said
        .split("error ")
        .nth(1)
        .unwrap()
        .split(' ')
        .next()
        .unwrap();
    assert!(error.parse::<f64>().unwrap() <= 20.0, "{said}");
    assert!(
        place
            .succeed("reference room.toml --time 0.01")
            .contains("walks per pixel")
    );
}

/// Patch radiosities of the solver and of the oracle are tables with the same rows.
#[test]
fn reference_tables_have_the_rows_of_solutions() {
    let place = Place::new();
    let flat = SCENE
        .replace("divisions = 1\n", "")
        .replace("divisions = 2\n", "");
    place.write("flat.toml", &flat);
    place.succeed("reference flat.toml --patches 3 --spp 200");
    place.succeed("solve flat.toml --no-cache --patches 3 --export solved.csv");
    let read = |path: &str| fs::read_to_string(place.path(path)).unwrap();
    let (traced, solved) = (read("out/flat-reference.csv"), read("solved.csv"));
    assert!(traced.starts_with("surface,ia,ib,B_r,B_g,B_b,se_r,se_g,se_b\n"));
    // Names may contain commas, so cells are counted from the right.
    let cells = |table: &str, values: usize| -> Vec<String> {
        let cell = |line: &str| line.rsplitn(values + 1, ',').last().unwrap().to_owned();
        table.lines().map(cell).collect()
    };
    assert_eq!(cells(&traced, 6), cells(&solved, 3));
}

#[test]
fn the_cache_is_listed_and_emptied() {
    let place = Place::new();
    assert!(place.succeed("cache list").starts_with("0 artifacts"));
    place.succeed("render room.toml");
    let list = place.succeed("cache list");
    assert!(
        list.contains("form-factors") && list.contains("solution"),
        "{list}"
    );
    assert!(
        list.contains("2 artifacts") && list.contains("platform-cache"),
        "{list}"
    );
    assert!(place.succeed("cache clean").starts_with("removed 2 files"));
    assert!(place.succeed("cache list").starts_with("0 artifacts"));
}

#[test]
fn check_computes_nothing() {
    let place = Place::new();
    let said = place.succeed("check room.toml --patches 100");
    assert!(
        said.contains("10,008 patches") && said.contains("200 MB of disk"),
        "{said}"
    );
    assert!(!place.path("out").exists() && !place.path("platform-cache").exists());
}

#[test]
fn nothing_but_text_is_printed_where_there_is_no_terminal() {
    let place = Place::new();
    let (_, stdout, stderr) = place.run("render room.toml --points 8 --patches 6");
    assert!(
        !stdout.contains('\x1b') && !stderr.contains('\x1b'),
        "{stderr}"
    );
    assert_eq!(stderr, "");
}

/// The messages and exit codes, to be read as a user would.
#[test]
fn failures_are_explained() {
    let place = Place::new();
    place.write(
        "bad.toml",
        &SCENE.replace("reflectance = 0.7", "reflectance = 7"),
    );
    place.write("hot.toml", NARROW_GAP);
    let blind = SCENE.split("[image]").nth(1).unwrap();
    place.write("blind.toml", &format!("[image]{blind}"));
    place.write("file", "");
    let commands = [
        "render bad.toml",
        "render missing.toml",
        "render nothing",
        "render blind.toml",
        "render room.toml --patches 900",
        "render room.toml --patches 2000",
        "solve hot.toml --no-cache",
        "render room.toml --no-cache -o file",
        "render room.toml --patches 0",
        "render room.toml --patches 3 --max-patch-edge 1",
        "solve room.toml --export table.txt",
        "rendr room.toml",
    ];
    let mut report = String::new();
    for command in commands {
        let (code, message) = place.fail(command);
        // What the machine has free is another matter.
        let message = message.split(", but only").next().unwrap();
        report += &format!(
            "$ radiosity {command}\n{}\n[exit code {code}]\n\n",
            message.trim_end()
        );
    }
    insta::assert_snapshot!(report);
}

/// Killed at many moments of its life, some of them while it writes.
#[test]
fn a_killed_run_leaves_nothing_broken() {
    let place = Place::new();
    let arguments = "render room.toml --cache c --patches 20 --points 2 --format ppm";
    for delay in 0..25 {
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_radiosity"))
            .args(arguments.split(' '))
            .current_dir(place.0.path())
            .stdout(std::process::Stdio::null())
            .stderr(std::process::Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(std::time::Duration::from_millis(5 * delay));
        child.kill().unwrap();
        child.wait().unwrap();
        let list = place.succeed("cache list --cache c");
        assert!(!list.contains("unusable"), "{list}");
        if let Ok(picture) = fs::read(place.path("out/room-smooth.ppm")) {
            assert_eq!(picture.len(), 13 + 3 * 16 * 12);
        }
        if delay % 5 == 0 {
            place.succeed("cache clean --cache c");
        }
    }
    place.succeed("render room.toml --cache c");
}

#[test]
fn runs_side_by_side_do_not_disturb_each_other() {
    let place = Place::new();
    std::thread::scope(|scope| {
        for _ in 0..6 {
            scope.spawn(|| place.succeed("render room.toml --cache c"));
        }
    });
    assert!(
        place
            .succeed("cache list --cache c")
            .contains("2 artifacts")
    );
    assert_eq!(fs::read_dir(place.path("out")).unwrap().count(), 4);
}

/// Nobody reads what is printed: no panic, and results all the same.
#[test]
fn a_closed_pipe_is_no_error() {
    let place = Place::new();
    for arguments in ["render room.toml --json", "check room.toml", "cache list"] {
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_radiosity"))
            .args(arguments.split(' '))
            .current_dir(place.0.path())
            .env("XDG_CACHE_HOME", place.path("platform-cache"))
            .stdout(std::process::Stdio::piped())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{arguments}: {stderr}");
    }
    assert!(place.path("out/room-smooth.png").is_file());
}

#[test]
fn results_that_cannot_be_written_are_refused_before_the_work() {
    let place = Place::new();
    place.write("file", "");
    for arguments in [
        "render room.toml -o file",
        "solve room.toml --export file/x.csv",
    ] {
        let (code, message) = place.fail(arguments);
        assert_eq!(code, 1, "{message}");
        assert!(
            !place.path("platform-cache").exists(),
            "nothing was computed"
        );
    }
}

#[test]
fn stages_before_a_failure_are_reported() {
    let place = Place::new();
    place.write("hot.toml", NARROW_GAP);
    let (code, stdout, _) = place.run("solve hot.toml --no-cache");
    assert_eq!(code, 5);
    assert!(
        stdout.contains("form factors") && stdout.contains("warning"),
        "{stdout}"
    );
}

#[test]
fn help_is_for_strangers() {
    let place = Place::new();
    let mut help = place.succeed("--help");
    help += &place.succeed("help render");
    insta::assert_snapshot!(help);
}
