//! Comparing results on the command line.

use crate::place::{Place, SCENE};
use std::fs;

/// A picture against itself as levels errs by the rounding of levels and nothing more; the
/// exposure and gamma come from the scene.
#[test]
fn pictures_of_all_formats_are_compared() {
    let place = Place::new();
    let shown = "[image]\nexposure = 1\ngamma = 2.2";
    place.write("room.toml", &SCENE.replace("[image]", shown));
    place.succeed("reference room.toml --spp 8");
    let compare = "compare out/room-reference.png out/room-reference.pfm --scene room.toml";
    let json = place.json(&format!("{compare} --difference levels.png"));
    let all = &json["regions"]["all"];
    let percent = |value: &serde_json::Value| value.as_f64().unwrap() / 100.0;
    let (rmse, max) = (
        percent(&all["rmse_percent"]),
        percent(&all["percentiles"]["max"]),
    );
    let map = fs::read(place.path("out/room-reference.pfm")).unwrap();
    let mean = mean_of_unclamped(&map);
    // Half a level of brightness: gamma / 510 where a level is brightest, in the scene's
    // exposure 1.
    let half_a_level = 2.2 / 510.0 / mean;
    assert!(0.0 < rmse && rmse < max && max < half_a_level, "{json}");
    assert_eq!(json["difference"], "levels.png");
    assert!(
        fs::read(place.path("levels.png"))
            .unwrap()
            .starts_with(b"\x89PNG")
    );
    let said = place.succeed("compare out/room-reference.pfm out/room-reference.pfm");
    assert!(said.contains("all"), "{said}");
    place.succeed("compare out/room-reference.pfm out/room-reference.pfm --difference zero.pfm");
    let zero = fs::read(place.path("zero.pfm")).unwrap();
    assert!(zero[14..].iter().all(|&byte| byte == 0));
}

/// The mean of the pixels of a float map that are at most 1 in all channels.
fn mean_of_unclamped(map: &[u8]) -> f64 {
    let values: Vec<f32> = map[14..]
        .as_chunks::<4>()
        .0
        .iter()
        .map(|&four| f32::from_le_bytes(four))
        .collect();
    let pixels = values.as_chunks::<3>().0.iter();
    let unclamped: Vec<_> = pixels.filter(|p| p.iter().all(|&c| c <= 1.0)).collect();
    let sum: f64 = unclamped
        .iter()
        .flat_map(|p| p.iter())
        .map(|&c| f64::from(c))
        .sum();
    sum / (3.0 * unclamped.len() as f64)
}

/// The solver's table against the oracle's, both of the same patches.
#[test]
fn tables_are_compared() {
    let place = Place::new();
    let flat = evenly_cut();
    place.write("flat.toml", &flat);
    place.succeed("reference flat.toml --patches 3 --spp 2000");
    place.succeed("solve flat.toml --no-cache --patches 3 --export solved.csv");
    let compare = "compare solved.csv out/flat-reference.csv --scene flat.toml --patches 3";
    let json = place.json(compare);
    let surfaces = json["regions"].as_object().unwrap();
    let names: Vec<&str> = surfaces.keys().map(String::as_str).collect();
    assert_eq!(names, ["all", "block", "floor", "wing"]);
    let rmse = json["regions"]["all"]["rmse_percent"].as_f64().unwrap();
    assert!(0.0 < rmse && rmse < 50.0, "{json}");
    let said = place.succeed(compare);
    assert!(said.contains("the reference's own noise is"), "{said}");
    assert!(
        said.contains("left out: lamp, the only one (emits)"),
        "{said}"
    );
    let itself = place.json("compare solved.csv solved.csv --scene flat.toml --patches 3");
    assert_eq!(itself["regions"]["all"]["rmse_percent"], 0.0);
}

/// The scene of [`crate::place::SCENE`] without divisions of single surfaces.
fn evenly_cut() -> String {
    crate::place::SCENE
        .replace("divisions = 1\n", "")
        .replace("divisions = 2\n", "")
}

#[test]
fn what_cannot_be_compared_is_said() {
    let place = Place::new();
    place.write("a.csv", "surface,ia,ib,B_r,B_g,B_b\n");
    place.write("a.ppm", "P3 1 1 255 1 2 3\n");
    place.write("b.ppm", "P3 2 1 255 1 2 3 4 5 6\n");
    for (arguments, expected) in [
        ("compare a.csv a.csv", "name their --scene"),
        ("compare a.ppm a.csv", "cannot be compared with a table"),
        (
            "compare a.csv a.csv --scene room.toml",
            "the table lacks patch",
        ),
        (
            "compare a.ppm b.ppm",
            "1 x 1 pixels, but the reference 2 x 1",
        ),
        (
            "compare a.ppm a.ppm --regions b.ppm",
            "b.ppm is not a good PNG",
        ),
        ("compare none.png a.ppm", "cannot read none.png"),
        (
            "compare a.ppm a.ppm --patches 3",
            "--divisions and --coarsen are for tables",
        ),
        (
            "compare a.csv a.csv --scene room.toml --gamma 2",
            "are for pictures",
        ),
        (
            "compare room.toml a.ppm",
            "room.toml is none of the formats",
        ),
    ] {
        let (code, message) = place.fail(arguments);
        assert_eq!(code, 3, "{arguments}: {message}");
        assert!(message.contains(expected), "{arguments}: {message}");
        assert!(
            message.starts_with("error: ") && message.lines().count() == 1,
            "{message}"
        );
    }
}

/// Opening a pipe waits for a writer, and a device does not end.
#[cfg(unix)]
#[test]
fn exponents_are_positive() {
    let place = Place::new();
    fs::write(place.path("a.ppm"), "P3 1 1 255 1 2 3\n").unwrap();
    for gamma in ["-1", "0", "nan", "inf"] {
        let (code, message) = place.fail(&format!("compare a.ppm a.ppm --gamma {gamma}"));
        assert_eq!(code, 2, "{message}");
        assert!(
            message.contains("--gamma must be a positive number"),
            "{message}"
        );
    }
}

#[test]
fn what_is_no_regular_file_is_refused() {
    let place = Place::new();
    place.write("b.csv", "");
    let made = std::process::Command::new("mkfifo")
        .args([place.path("pipe.csv"), place.path("pipe.png")])
        .status();
    assert!(made.unwrap().success());
    for command in [
        "compare pipe.png pipe.png",
        "compare pipe.csv b.csv --scene room.toml",
        "compare /dev/zero /dev/zero",
        "inspect pipe.png",
    ] {
        let (code, message) = place.fail(command);
        assert_eq!(code, 3);
        assert!(message.contains("it is no regular file"), "{message}");
    }
}

/// Nor is a name of other bytes a reason to fail.
#[cfg(target_os = "linux")]
#[test]
fn paths_may_be_of_any_bytes() {
    use std::os::unix::ffi::OsStrExt;
    let place = Place::new();
    let name = |end: &str| [b"p\xff", end.as_bytes()].concat();
    let path = |end: &str| place.0.path().join(std::ffi::OsStr::from_bytes(&name(end)));
    fs::write(path(".pfm"), b"PF\n1 1\n-1\n\0\0\0\x3f\0\0\0\x3f\0\0\0\x3f").unwrap();
    let mut command = place.command("compare --json");
    command.arg(path(".pfm")).arg(path(".pfm"));
    command.arg("--difference").arg(path("d.png"));
    let output = command.output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(json["found"].as_str().unwrap().contains("p\u{fffd}.pfm"));
    assert!(path("d.png").is_file());
}
