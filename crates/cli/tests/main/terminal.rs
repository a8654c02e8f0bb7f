//! What is printed, whatever names are made of and wherever it goes.

use crate::place::{Place, SCENE};
use std::fs;

/// Names that would recolour the terminal, ring, go back to the line's begin, and turn the
/// direction of writing.
const HOSTILE: &str = r"fl\u001b[41mo\u0007o\rr\n\u009b1m\u202E";
const SHOWN: &str = r"fl\u{1b}[41mo\u{7}o\u{d}r\u{a}\u{9b}1m\u{202e}";

fn hostile() -> Place {
    let place = Place::new();
    let scene = SCENE.replace("name = \"floor\"", &format!("name = \"{HOSTILE}\""));
    let lamp = scene.replace("[materials.lamp]", "[materials.\"lamp\\u001b[7m\"]");
    let scene = lamp.replace("material = \"lamp\"", "material = \"lamp\\u001b[7m\"");
    place.write("room.toml", &scene);
    place
}

fn is_plain(text: &str) -> bool {
    let is_command = |c: char| c.is_control() && c != '\n' || c == '\u{202e}';
    !text.chars().any(is_command)
}

#[test]
fn names_do_not_reach_the_terminal_as_commands() {
    let place = hostile();
    place.succeed("solve room.toml --cache c --export a.csv");
    let files = place.artifacts().into_iter();
    let inspect = files.map(|file| format!("inspect {} --scene room.toml", file.display()));
    let mut commands = vec![
        "check room.toml".to_owned(),
        "compare a.csv a.csv --scene room.toml".to_owned(),
        "compare a.csv a.csv --scene room.toml --json".to_owned(),
        "form-factors room.toml --cache c --json".to_owned(),
        "cache list --cache c".to_owned(),
        "display room.toml --cache c --factors-of floor:0,0".to_owned(),
        "render room.toml --cache c --dim x=1".to_owned(),
    ];
    commands.extend(inspect);
    let mut all = String::new();
    for command in commands {
        let (_, stdout, stderr) = place.run(&command);
        assert!(
            is_plain(&stdout) && is_plain(&stderr),
            "{command}: {stdout}{stderr}"
        );
        all += &stdout;
        all += &stderr;
    }
    assert!(all.contains(SHOWN), "{all}");
    assert!(all.contains(r"lamp\u{1b}[7m"), "{all}");
}

/// What is wrong with the command line is told with the arguments in it.
#[test]
fn arguments_do_not_reach_the_terminal_as_commands() {
    let place = Place::new();
    let hostile = "x\x1b[41m\x07\r\u{9b}1m\u{202e}";
    let shown = r"x\u{1b}[41m\u{7}\u{d}\u{9b}1m\u{202e}";
    for arguments in [
        vec![hostile.to_owned()],
        vec!["render".to_owned(), format!("--{hostile}")],
        vec!["render".to_owned(), format!("--threads={hostile}")],
        vec!["solve".to_owned(), "--dim".to_owned(), hostile.to_owned()],
        vec!["solve".to_owned(), format!("--export={hostile}")],
    ] {
        let output = place.command("").args(&arguments).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{message:?}");
        assert!(is_plain(&message), "{message:?}");
        assert!(message.contains(shown), "{arguments:?}: {message:?}");
    }
}

#[test]
fn json_has_the_names_as_they_are() {
    let place = hostile();
    place.succeed("solve room.toml --cache c --export a.csv");
    let json = place.json("compare a.csv a.csv --scene room.toml");
    let names: Vec<&String> = json["regions"].as_object().unwrap().keys().collect();
    assert!(
        names.contains(&&"fl\u{1b}[41mo\u{7}o\rr\n\u{9b}1m\u{202e}".to_owned()),
        "{names:?}"
    );
}

#[test]
fn long_names_do_not_flood_the_terminal() {
    let place = Place::new();
    let name = format!("name = \"{}\"", "f".repeat(300));
    place.write("room.toml", &SCENE.replace("name = \"floor\"", &name));
    place.succeed("solve room.toml --cache c --export a.csv");
    let said = place.succeed("compare a.csv a.csv --scene room.toml");
    assert!(said.contains("fff ... 252 characters ... fff"), "{said}");
    assert!(said.lines().all(|line| line.len() < 200), "{said}");
    let (_, message) = place.fail(&format!("check {}", "n".repeat(100_000)));
    assert!(message.len() < 6000, "{}", message.len());
}

/// Spreadsheets run what looks like a formula.
#[test]
fn names_in_tables_are_no_formulas() {
    let place = Place::new();
    let scene = SCENE.replace("name = \"floor\"", "name = \"=HYPERLINK(1)\"");
    place.write("room.toml", &scene);
    place.succeed("solve room.toml --cache c --export a.csv");
    place.succeed("form-factors room.toml --cache c --export f.csv --by surface");
    place.succeed("form-factors room.toml --cache c --export p.csv");
    for file in ["a.csv", "f.csv", "f.rows.csv", "p.rows.csv"] {
        let text = fs::read_to_string(place.path(file)).unwrap();
        assert!(text.contains("'=HYPERLINK(1)"), "{file}: {text}");
        assert!(
            !text.contains("\n=") && !text.contains(",="),
            "{file}: {text}"
        );
    }
    let json = place.json("compare a.csv a.csv --scene room.toml");
    assert!(json["regions"]["=HYPERLINK(1)"].is_object(), "{json}");
}

/// With the sentence that says so, after the work is done.
#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_an_error() {
    let place = Place::new();
    place.succeed("solve room.toml --cache c --export a.csv");
    let file = place.artifact("form-factors");
    let commands = [
        "render room.toml --cache c".to_owned(),
        "render room.toml --cache c --json".to_owned(),
        "form-factors room.toml --cache c --export f.csv".to_owned(),
        "solve room.toml --cache c".to_owned(),
        "relight room.toml --cache c".to_owned(),
        "display room.toml --cache c".to_owned(),
        "reference room.toml --spp 2".to_owned(),
        "compare a.csv a.csv --scene room.toml".to_owned(),
        "check room.toml".to_owned(),
        "cache list --cache c".to_owned(),
        format!("inspect {}", file.display()),
        "help".to_owned(),
        "--version".to_owned(),
    ];
    for command in commands {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let program = env!("CARGO_BIN_EXE_radiosity");
        let output = std::process::Command::new(program)
            .args(command.split(' '))
            .current_dir(place.0.path())
            .stdout(full)
            .output()
            .unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{command}: {message}");
        let sentence = "error: cannot write standard output: ";
        assert!(message.contains(sentence), "{command}: {message}");
    }
    assert!(place.path("f.csv").is_file());
}
