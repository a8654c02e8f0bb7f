//! The measure for tables of radiosities.

use proptest::prelude::*;
use radiosity_compare::{Cell, Table, TableError, compare_tables, parse_table};

const HEADER: &str = "surface,ia,ib,B_r,B_g,B_b\n";

fn table(rows: &str) -> Table {
    parse_table(format!("{HEADER}{rows}").as_bytes()).unwrap()
}

fn cell(surface: &str, ia: u32, area: f64, emits: bool) -> Cell {
    Cell {
        surface: surface.to_owned(),
        cell: [ia, 0],
        area,
        emits,
    }
}

fn cells() -> [Cell; 5] {
    [
        cell("floor, the large", 0, 3.0, false),
        cell("floor, the large", 1, 1.0, false),
        cell("wall", 0, 2.0, false),
        cell("lamp", 0, 9.0, true),
        cell("outside", 0, 9.0, false),
    ]
}

const REFERENCE: &str = "\"floor, the large\",0,0,1,1,1\n\"floor, the large\",1,0,2,2,2\n\
    wall,0,0,4,4,4\nlamp,0,0,50,50,50\noutside,0,0,0,0,0\n";

/// Weights are areas; emitters and unlit surfaces do not count, however wrong; rows may come in
/// any order.
#[test]
fn patches_count_by_area() {
    let found = "wall,0,0,4,4,4\n\"floor, the large\",1,0,3,3,3\n\"floor, the large\",0,0,1,1,1\n\
        outside,0,0,7,7,7\nlamp,0,0,0,0,0\n";
    let errors = compare_tables(&cells(), &table(found), &table(REFERENCE)).unwrap();
    let [(floor, on_floor), (wall, on_wall), (all, overall)] = &errors[..] else {
        panic!("{errors:?}");
    };
    assert_eq!([floor, wall, all], ["floor, the large", "wall", "all"]);
    let close = |a: f64, b: f64| (a - b).abs() < 1e-9;
    // The floor's mean is 5/4, its mean square difference 1/4.
    assert!(close(on_floor.rmse_percent, 40.0) && close(on_floor.bias_percent, 20.0));
    assert_eq!(on_wall.rmse_percent, 0.0);
    // Overall the mean is 13/6, the mean square difference 1/6.
    assert!(close(
        overall.rmse_percent,
        100.0 * (1.0 / 6.0_f64).sqrt() * 6.0 / 13.0
    ));
    assert!(close(overall.bias_percent, 100.0 / 13.0));
    assert_eq!(overall.values, 9);
}

#[test]
fn tables_of_other_patches_are_refused() {
    let compare = |found: &str| {
        let error = compare_tables(&cells(), &table(found), &table(REFERENCE)).unwrap_err();
        error.to_string()
    };
    let without_wall = REFERENCE.replace("wall,0,0,4,4,4\n", "");
    assert!(compare(&without_wall).contains("the table lacks patch 0,0 of `wall`"));
    let more = format!("{REFERENCE}wall,1,0,1,1,1\n");
    let said = compare(&more);
    assert!(
        said.contains("line 7 of the table: the scene has no patch 1,0 of `wall`"),
        "{said}"
    );
    let dark = "wall,0,0,0,0,0\n";
    let wall = [cell("wall", 0, 1.0, false)];
    let nothing = compare_tables(&wall, &table(dark), &table(dark));
    assert_eq!(nothing, Err(TableError::Nothing));
}

#[test]
fn standard_errors_are_read() {
    let text = "surface,ia,ib,B_r,B_g,B_b,se_r,se_g,se_b\nwall,3,4,1,2,3,0.1,0.2,0.3\n";
    let row = &parse_table(text.as_bytes()).unwrap().rows[0];
    assert_eq!(
        (row.cell, row.standard_error),
        ([3, 4], Some([0.1, 0.2, 0.3]))
    );
}

#[test]
fn tables_are_written_as_they_are_read() {
    let with_errors = "surface,ia,ib,B_r,B_g,B_b,se_r,se_g,se_b\n\
        \"floor, the large\",3,4,0.1,2,3e-20,1.23e-4,0.00e0,2.00e1\n";
    for text in [with_errors, &format!("{HEADER}{REFERENCE}")] {
        let written = parse_table(text.as_bytes()).unwrap().to_csv();
        let again = parse_table(&written).unwrap().to_csv();
        assert_eq!(written, again);
        let expected = text.replace("3e-20", "0.00000000000000000003");
        assert_eq!(String::from_utf8(written).unwrap(), expected);
    }
}

/// The noise is that of the reference, whatever the table itself tells.
#[test]
fn the_noise_of_the_reference_is_told() {
    let header = "surface,ia,ib,B_r,B_g,B_b,se_r,se_g,se_b\n";
    let parse = |row: &str| parse_table(format!("{header}{row}\n").as_bytes()).unwrap();
    let (found, reference) = (
        parse("wall,0,0,2,2,2,9,9,9"),
        parse("wall,0,0,1,2,3,0.1,0.2,0.1"),
    );
    let wall = [cell("wall", 0, 7.0, false)];
    let errors = compare_tables(&wall, &found, &reference).unwrap()[0].1;
    let noise = 50.0 * (0.06_f64 / 3.0).sqrt();
    assert!((errors.noise_percent.unwrap() - noise).abs() < 1e-9);
    let without = (errors.rmse_percent.powi(2) - noise.powi(2)).sqrt();
    assert!((errors.rmse_percent_without_noise() - without).abs() < 1e-9);
}

#[test]
fn blocks_of_cells_are_averaged() {
    let rows = (0..4).flat_map(|a| (0..2).map(move |b| format!("wall,{a},{b},{a},{b},1\n")));
    let text = format!(
        "{HEADER}{}floor,0,0,5,5,5\nfloor,0,1,7,7,7\n",
        rows.collect::<String>()
    );
    let table = parse_table(text.as_bytes()).unwrap();
    let error = table.coarsened(2).unwrap_err().to_string();
    assert_eq!(
        error,
        "line 10: the block of 2 x 2 cells that begins here has 2"
    );
    let wall = Table {
        rows: table.rows[..8].to_vec(),
    };
    let coarse = wall.coarsened(2).unwrap().rows;
    let found: Vec<_> = coarse.iter().map(|row| (row.cell, row.radiosity)).collect();
    assert_eq!(
        found,
        [([0, 0], [0.5, 0.5, 1.0]), ([1, 0], [2.5, 0.5, 1.0])]
    );
    assert_eq!(table.coarsened(1).unwrap(), table);
}

#[test]
fn mistakes_are_shown_by_line() {
    let message = |text: &str| parse_table(text.as_bytes()).unwrap_err().to_string();
    assert!(message("a,b\n1,2\n").contains("surface,ia,ib,B_r"));
    assert!(message("").contains("surface,ia,ib,B_r"));
    let bad = |rows: &str| message(&format!("{HEADER}{rows}"));
    assert!(
        bad("wall,0,0,1,1,1\nwall,x,0,1,1,1\n").starts_with("line 3: `x` is no whole number: ia")
    );
    assert!(bad("wall,0,0,1,nan,1\n").starts_with("line 2: `nan` is no number: B_g"));
    assert!(bad("wall,0,0,1\n").contains("line 2"));
    assert!(bad("wall,0,0,1,1,1\nwall,0,0,1,1,1\n").starts_with("line 3: this patch"));
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in "[\\PC\n,\"]{0,80}") {
        let _ = parse_table(text.as_bytes());
        let _ = parse_table(format!("{HEADER}{text}").as_bytes());
    }
}
