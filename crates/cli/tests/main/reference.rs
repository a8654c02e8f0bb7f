//! The oracle on the command line.

use crate::place::{Place, SCENE};
use crate::tables::cells;
use std::fs;

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

/// `--json` says what the lines say; dark scenes end, however small an error is asked for.
#[test]
fn runs_are_reported_for_scripts() {
    let place = Place::new();
    let json = place.json("reference room.toml --spp 8 --filter box");
    assert_eq!(
        (&json["scene"], &json["walks"]),
        (&"room".into(), &8.into())
    );
    assert!(json["picture"]["error_percent"].as_f64().unwrap() > 0.0);
    assert!(json["picture"]["vertices"].as_u64().unwrap() > 0);
    let radiance = json["outputs"]["radiance"].as_str().unwrap();
    let boxed = fs::read(place.path(radiance)).unwrap();
    place.succeed("reference room.toml --spp 8 --filter tents");
    assert_ne!(fs::read(place.path(radiance)).unwrap(), boxed);
    let json = place.json("reference room.toml --cells --spp 10");
    assert_eq!(json["patches"], 9 + 1 + 4 + 3);
    assert!(
        json["outputs"]["table"]
            .as_str()
            .unwrap()
            .ends_with("room-reference.csv")
    );
    place.write("dark.toml", &SCENE.replace("emission = [4, 3, 2]", ""));
    let json = place.json("reference dark.toml --error 0.001");
    assert_eq!(json["picture"]["error_percent"], 0.0);
}

/// The scene's own patches are those of solutions, whatever surfaces are cut into.
#[test]
fn reference_cells_are_the_solutions() {
    let place = Place::new();
    place.succeed("reference room.toml --cells --spp 100");
    place.succeed("solve room.toml --no-cache --export solved.csv");
    place.succeed("compare solved.csv out/room-reference.csv --scene room.toml");
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
    let traced = read("out/flat-reference.csv");
    assert!(traced.starts_with("surface,ia,ib,B_r,B_g,B_b,se_r,se_g,se_b\n"));
    assert_eq!(
        cells(&place, "out/flat-reference.csv"),
        cells(&place, "solved.csv")
    );
}

/// A standard error needs two samples, and flags of pictures change no table.
#[test]
fn what_means_nothing_is_refused() {
    let place = Place::new();
    for arguments in [
        "reference room.toml --spp 1",
        "reference room.toml --cells --size 8x6",
        "reference room.toml --patches 2 --exposure 3",
        "reference room.toml --cells --time 1",
    ] {
        assert_eq!(place.fail(arguments).0, 2, "{arguments}");
    }
    let json = place.json("reference room.toml --spp 2 --subpixels 1");
    assert_eq!(json["walks"], 2);
    assert!(json["picture"]["error_percent"].as_f64().unwrap() > 0.0);
}
