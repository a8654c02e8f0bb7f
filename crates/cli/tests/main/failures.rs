//! What goes wrong, and what must not go wrong with it.

use crate::place::{Place, SCENE};
use std::fs;

/// Two squares so close that one point on each overestimates their form factor 40 times.
const NARROW_GAP: &str = r#"
discretization = { divisions = 1 }
form_factors = { mode = "regular", points = 1 }

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
    place.write("empty.toml", "");
    place.write("picture.toml", "P6\n1 1\n255\n...");
    place.write("model.glb", "glTF...");
    place.write(
        "plate.vs3",
        "F 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 0 1 0\nS 1 1 2 3 0 0 0 0.9 plate\n",
    );
    let commands = [
        "render bad.toml",
        "render missing.toml",
        "render nothing",
        "render blind.toml",
        "check empty.toml",
        "check picture.toml",
        "render model.glb",
        "render plate.vs3",
        "reference plate.vs3",
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
    let arguments = "render room.toml --cache c --patches 20 --format ppm";
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
    assert!(place.succeed("cache list --cache c").contains("2 files"));
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
    assert!(stdout.contains("note: the form factors from"), "{stdout}");
}

#[test]
fn meshes_elsewhere_are_read_on_request() {
    let place = Place::new();
    fs::create_dir(place.path("in")).unwrap();
    place.write("in/room.toml", &SCENE.replace("block.obj", "../block.obj"));
    place.succeed("form-factors room.toml --cache c");
    let file = place.artifact("form-factors");
    for command in [
        "check in/room.toml",
        "solve in/room.toml --no-cache",
        "reference in/room.toml --cells --spp 2",
        &format!("inspect {} --scene in/room.toml", file.display()),
    ] {
        let (code, message) = place.fail(command);
        assert_eq!(code, 3, "{message}");
        let help = "= help: copy it there, or read it all the same: --allow-outside";
        assert!(
            message.starts_with("error: the mesh is outside"),
            "{message}"
        );
        assert!(message.contains(help), "{message}");
        place.succeed(&format!("{command} --allow-outside"));
    }
}

#[cfg(unix)]
#[test]
fn paths_of_scenes_need_not_be_text() {
    use std::os::unix::ffi::OsStrExt;
    let place = Place::new();
    let name = std::ffi::OsStr::from_bytes(b"caf\xe9.toml");
    fs::copy(place.path("room.toml"), place.0.path().join(name)).unwrap();
    place.command("check").arg(name).assert().success();
    let reference = "reference --cells --spp 2";
    place.command(reference).arg(name).assert().success();
}

/// `ulimit -v` is a machine that is too small: whatever the limit is, a run ends well or says so.
#[cfg(target_os = "linux")]
#[test]
fn limits_of_the_process_are_limits_of_memory() {
    let place = Place::new();
    let program = env!("CARGO_BIN_EXE_radiosity");
    let run = |limit: u32, arguments: &str| {
        let limited = format!("ulimit -v {limit}; exec \"$0\" {arguments}");
        let mut command = std::process::Command::new("sh");
        let command = command.args(["-c", &limited, program]);
        let output = command.current_dir(place.0.path()).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        (output.status.code(), stderr)
    };
    let solve = "solve room.toml --mode regular --points 1 --patches 150 --threads 2 --no-cache";
    let (code, message) = run(300_000, solve);
    assert_eq!(code, Some(4), "{message}");
    assert!(
        message.contains("of memory, but only") && message.contains("into fewer patches: about"),
        "{message}"
    );
    let (code, message) = run(300_000, &solve.replace("150", "20"));
    assert_eq!(code, Some(0), "{message}");
}
