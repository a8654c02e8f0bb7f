//! Every note and warning of the command, and every error of its own, word for word. Those of scene
//! files have snapshots in `radiosity-scene`, the main exit codes in `failures`.

use crate::place::{Place, SCENE};
use crate::room::{ORDINARY, Room, text_of};
use std::fs;

/// A square of View3D, and how it says that it is closed.
const PLATE: &str = "C encl=1 eps=1e-4\nF 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 0 1 0\n\
    S 1 1 2 3 0 0 0 0.9 plate\n";

/// A triangle in front of the back of another.
const AWAY: &str = "F 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 0 1 0\nV 4 0 0 1\nV 5 1 0 1\nV 6 0 1 1\n\
    S 1 1 2 3 0 0 0 0.9 below\nS 2 4 5 6 0 0 0 0.9 above\n";

/// Scenes that deserve a word.
fn place() -> Place {
    let place = Place::new();
    let room = |name: &str, room: &Room| place.write(name, &text_of(room));
    room("good.toml", &ORDINARY);
    room(
        "outside-in.toml",
        &Room {
            inwards: false,
            ..ORDINARY
        },
    );
    room(
        "dark.toml",
        &Room {
            emission: 0.0,
            ..ORDINARY
        },
    );
    let good = text_of(&ORDINARY);
    place.write(
        "large.toml",
        &good.replace("divisions = 2", "divisions = 1"),
    );
    place.write("old.toml", &format!("{good}[solver]\ntolerance = 1e-3\n"));
    let poster = good.replace("[0.5, 0.5, 1.0]", "[0.5, 0.5, 0.0]");
    let poster = poster.replace("[0.5, 2.5, 1.0]", "[1.5, 0.5, 0.0]");
    let poster = poster.replace(
        "[1.5, 2.5, 1.0], [1.5, 0.5, 1.0]",
        "[1.5, 2.5, 0.0], [0.5, 2.5, 0.0]",
    );
    place.write("poster.toml", &poster);
    place.write(
        "far.toml",
        &SCENE.replace("[1, 0, 0], edge_b", "[4000, 0, 0], edge_b"),
    );
    place.write("plate.vs3", PLATE);
    place.write("away.vs3", AWAY);
    place.write("text.ppm", "P3 1 1 255 9 9 9\n");
    place.write("table.csv", "surface,ia,ib,B_r,B_g,B_b\nfloor,0,0,1,1,1\n");
    place.write("odd.csv", "surface,ia\nfloor,0\n");
    fs::create_dir(place.path("folder")).unwrap();
    place
}

/// Of all that is printed, notes and warnings with the name of the place left out.
fn remarks(place: &Place, arguments: &str) -> String {
    let (_, stdout, stderr) = place.run(arguments);
    assert!(!stderr.contains("panicked"), "{stderr}");
    let lines = stderr.lines().chain(stdout.lines()).map(str::trim);
    let lines = lines.filter(|line| line.starts_with("note:") || line.starts_with("warning:"));
    lines.map(|line| format!("{line}\n")).collect()
}

#[test]
fn notes_and_warnings_are_for_strangers() {
    let place = place();
    let commands = [
        "solve outside-in.toml --cache c",
        "check dark.toml",
        "check large.toml --divisions 1",
        "check far.toml",
        "check old.toml",
        "check poster.toml",
        "check poster.toml --mode regular",
        "check plate.vs3",
        "check good.toml --mode regular --tolerance 1e-3 --pairs 9 --seed 1",
        "check good.toml --points 4",
        "form-factors plate.vs3 --cache c --closure",
        "form-factors away.vs3 --cache c",
        "form-factors good.toml --cache c --mode regular --points 1 --divisions 8",
        "form-factors good.toml --cache c --mode monte-carlo --points 2 --divisions 8",
        "solve good.toml --cache c --max-sweeps 1",
        "solve good.toml --cache c --max-sweeps 2",
        "solve good.toml --cache c --residual 1e-15 --max-sweeps 1000",
        "solve good.toml --cache c --solver cg --relaxation 1.2",
        "render good.toml --cache c --dim lamp=0",
        "render good.toml --cache c --no-live --shading constant --show indirect --only lamp \
         --tint lamp=0,0,0",
    ];
    let report = commands.map(|command| {
        let said = remarks(&place, command);
        assert!(!said.is_empty(), "{command}");
        format!("$ radiosity {command}\n{said}\n")
    });
    insta::assert_snapshot!(report.concat());
}

#[test]
fn mistakes_on_the_command_line_are_explained() {
    let place = place();
    place.succeed("solve good.toml --cache c");
    let commands = [
        "check folder",
        "check text.ppm",
        "render good.toml --exposure 0",
        "render good.toml --size 0x6",
        "render good.toml --gather 0",
        "solve good.toml --residual 7",
        "form-factors good.toml --tolerance 7",
        "form-factors good.toml --export f.npy --sparse 1e-6",
        "form-factors good.toml --export nowhere/f.csv",
        "form-factors good.toml --export folder/f",
        "form-factors good.toml --by surface",
        "relight good.toml --dim lamp=0.5 --dim lamp=0.6",
        "relight good.toml --dim lamb=0.5",
        "relight good.toml --only floor",
        "render good.toml --cache c --mode regular --show error",
        "render good.toml --cache c --factors-of floor:9,9",
        "render good.toml --cache c --factors-of flor:0,0",
        "render good.toml --views side",
        "render good.toml --path 9",
        "compare text.ppm table.csv",
        "compare table.csv table.csv",
        "compare odd.csv table.csv --scene good.toml",
        "compare table.csv table.csv --scene good.toml --gamma 2.2",
        "compare table.csv table.csv --scene good.toml",
        "compare text.ppm text.ppm --coarsen 2",
        "compare text.ppm text.ppm --scene good.toml",
        "compare text.ppm nothing.png",
        "inspect nothing.bin",
        "inspect good.toml",
        "cache list --cache good.toml",
    ];
    let report = commands.map(|command| {
        let (code, message) = place.fail(command);
        let message = message.trim_end();
        format!("$ radiosity {command}\n{message}\n[exit code {code}]\n\n")
    });
    insta::assert_snapshot!(report.concat());
}

#[test]
fn an_unknown_instruction_set_is_told() {
    let place = place();
    let output = place
        .command("check good.toml")
        .env("RADIOSITY_SIMD", "mmx")
        .output();
    let said = String::from_utf8(output.unwrap().stderr).unwrap();
    let expected = "warning: RADIOSITY_SIMD is `mmx`, which this machine does not have: ";
    assert!(said.starts_with(expected), "{said}");
}
