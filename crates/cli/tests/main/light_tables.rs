//! Radiosities and irradiances as tables.

use crate::place::Place;
use crate::tables::{cells, number, read_table};

/// An L of six corners, and a triangle beside it.
const BENT: &str = "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nv 3 0 0\n\
    f 1 2 3 4 5 6\nf 1 7 2\n";

#[test]
fn radiosities_are_exported_in_input_order() {
    let place = Place::new();
    let report = place.json("solve room.toml --no-cache --export table.csv");
    assert_eq!(report["outputs"]["export"], "table.csv");
    let of_room = cells(&place, "table.csv");
    assert_eq!(of_room[..3], ["floor,0,0", "floor,0,1", "floor,0,2"]);
    assert_eq!(of_room[9], "lamp,0,0");
    assert_eq!(
        of_room[10..14],
        ["wing,0,0", "wing,0,1", "wing,0,2", "wing,1,0"]
    );
    assert_eq!(of_room[14..], ["block,0,0", "block,1,0", "block,2,0"]);
    place.write("block.obj", BENT);
    place.succeed("solve room.toml --no-cache --export bent.csv");
    assert_eq!(
        cells(&place, "bent.csv")[14..],
        [
            "block,0,0",
            "block,0,1",
            "block,0,2",
            "block,0,3",
            "block,1,0"
        ]
    );
    let lamp = &read_table(&place, "table.csv")[9];
    let shown = ["B_r", "B_g", "B_b"].map(|column| number(lamp, column));
    assert_eq!(shown, [4.0, 3.0, 2.0], "a black lamp shows what it emits");
}

/// `B = E + rho H` patch by patch, and means of surfaces and groups are those of their patches.
#[test]
fn tables_of_light_hang_together() {
    let place = Place::new();
    let solve = "solve room.toml --cache c --export";
    place.succeed(&format!("{solve} patches.csv"));
    let patches = read_table(&place, "patches.csv");
    for row in patches.iter().filter(|row| row["surface"] != "lamp") {
        for (b, h) in [("B_r", "H_r"), ("B_g", "H_g"), ("B_b", "H_b")] {
            let reflected = 0.7 * number(row, h);
            // The residual is 1e-6 of the emission: 9 patches of 4 W/m^2 have a norm of 12.
            assert!((number(row, b) - reflected).abs() < 1.2e-5, "{row:?}");
        }
    }
    let floor = &patches[0];
    assert_eq!(
        ["x", "y", "z"].map(|axis| (6.0 * number(floor, axis)).round()),
        [1.0, 0.0, 5.0]
    );
    for (by, column) in [("surface", "surface"), ("group", "group")] {
        place.succeed(&format!("{solve} means.csv --by {by}"));
        for mean in read_table(&place, "means.csv") {
            let of_name = patches.iter().filter(|row| row[column] == mean[column]);
            let sum = |value: &dyn Fn(&_) -> f64| of_name.clone().map(value).sum::<f64>();
            let area = sum(&|row| number(row, "area"));
            assert!((number(&mean, "area") / area - 1.0).abs() < 1e-6);
            for column in ["B_g", "H_g", "visible"] {
                let weighted = sum(&|row| number(row, "area") * number(row, column));
                assert!((number(&mean, column) - weighted / area).abs() < 1e-4);
            }
        }
    }
}
