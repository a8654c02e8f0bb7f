//! The oracle on the command line.

mod place;

use place::{Place, SCENE};
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
