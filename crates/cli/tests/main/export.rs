//! Form factors as other programs read them.

use crate::place::Place;
use crate::tables::{number, read_table};
use std::collections::BTreeMap;
use std::fs;

/// A matrix of NumPy's format 1.0, read as its description says.
fn read_npy(place: &Place, name: &str) -> Vec<Vec<f64>> {
    let bytes = fs::read(place.path(name)).unwrap();
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
    let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let (head, data) = bytes[10..].split_at(length);
    assert_eq!((10 + length) % 64, 0);
    let head = std::str::from_utf8(head).unwrap();
    assert!(head.starts_with("{'descr': '<f4', 'fortran_order': False, 'shape': ("));
    assert!(head.ends_with('\n'));
    let shape = head.split(['(', ')']).nth(1).unwrap();
    let shape: Vec<usize> = shape.split(", ").map(|n| n.parse().unwrap()).collect();
    let values: Vec<f64> = data
        .as_chunks::<4>()
        .0
        .iter()
        .map(|bytes| f64::from(f32::from_le_bytes(*bytes)))
        .collect();
    assert_eq!(values.len(), shape[0] * shape[1]);
    values.chunks(shape[1]).map(<[f64]>::to_vec).collect()
}

/// The scene with its lamp and its wing in one group.
fn grouped() -> Place {
    let place = Place::new();
    let group = |text: &str, name: &str| text.replace(name, &format!("{name}\ngroup = \"others\""));
    let scene = group(crate::place::SCENE, "name = \"lamp, the only one\"");
    place.write("room.toml", &group(&scene, "name = \"wing\""));
    place
}

#[test]
fn the_matrix_is_that_of_the_rows() {
    let place = Place::new();
    let report = place.json("form-factors room.toml --cache c --export f.npy");
    assert_eq!(report["outputs"]["export"], "f.npy");
    assert_eq!(report["outputs"]["export_rows"], "f.rows.csv");
    let factors = read_npy(&place, "f.npy");
    let rows = read_table(&place, "f.rows.csv");
    assert_eq!((factors.len(), rows.len()), (17, 17));
    assert_eq!(
        (&rows[9]["name"][..], &rows[10]["name"][..]),
        ("lamp", "wing")
    );
    for (i, row) in rows.iter().enumerate() {
        // Each of the row's numbers is rounded to 24 bits.
        let sum: f64 = factors[i].iter().sum();
        assert!((sum - number(row, "fronts")).abs() < 1e-6, "{row:?}");
        let [fronts, backs, sky] = ["fronts", "backs", "sky"].map(|share| number(row, share));
        let rest = (1.0 - fronts - backs).max(0.0);
        assert!((sky - rest).abs() < 1e-8, "{row:?}");
        for (j, other) in rows.iter().enumerate() {
            let [forth, back] = [
                number(row, "area") * factors[i][j],
                number(other, "area") * factors[j][i],
            ];
            assert!((forth - back).abs() <= 1e-6 * forth, "reciprocity");
        }
    }
    place.succeed("form-factors room.toml --cache c --export f.csv");
    let text = fs::read_to_string(place.path("f.csv")).unwrap();
    let same = |line: &str| {
        line.split(',')
            .map(|x| x.parse::<f32>().unwrap().into())
            .collect()
    };
    assert_eq!(text.lines().map(same).collect::<Vec<Vec<f64>>>(), factors);
}

#[test]
fn parts_are_means_of_their_patches() {
    let place = grouped();
    place.succeed("form-factors room.toml --cache c --export f.npy");
    place.succeed("form-factors room.toml --cache c --export g.csv --by group");
    place.succeed("form-factors room.toml --cache c --export g.npy --by group");
    let (factors, rows) = (read_npy(&place, "f.npy"), read_table(&place, "f.rows.csv"));
    let groups = read_table(&place, "g.rows.csv");
    let names: Vec<&str> = groups.iter().map(|group| &group["name"][..]).collect();
    assert_eq!(names, ["floor", "others", "block"]);
    let group_of = |row: usize| match &rows[row]["name"][..] {
        "lamp" | "wing" => "others",
        name => name,
    };
    let lines = read_table(&place, "g.csv");
    let matrix = read_npy(&place, "g.npy");
    let place_of = |name: &str| names.iter().position(|known| *known == name).unwrap();
    assert!(lines.len() >= 6, "all that see each other: {lines:?}");
    for line in &lines {
        let (from, to) = (place_of(&line["from"]), place_of(&line["to"]));
        let members = |name| (0..rows.len()).filter(move |&row| group_of(row) == name);
        let (mut exchange, mut area) = (0.0, 0.0);
        for i in members(&line["from"]) {
            area += number(&rows[i], "area");
            let factor: f64 = members(&line["to"]).map(|j| factors[i][j]).sum();
            exchange += number(&rows[i], "area") * factor;
        }
        let found = number(line, "F");
        assert!((found - exchange / area).abs() < 1e-6, "{line:?}");
        assert!((found - matrix[from][to]).abs() < 1e-7);
        let of_row = number(&groups[from], "error");
        assert!(number(line, "error") <= 1.01 * of_row, "{line:?}");
    }
    place.succeed("form-factors room.toml --cache c --export s.csv --by surface");
    let all = read_table(&place, "s.csv");
    place.succeed("form-factors room.toml --cache c --export t.csv --by surface --sparse 0.05");
    let some = read_table(&place, "t.csv");
    let large = all.iter().filter(|line| number(line, "F") >= 0.05);
    assert!(large.eq(&some) && some.len() < all.len());
    assert!(
        read_table(&place, "t.rows.csv")
            .iter()
            .all(|row| number(row, "dropped") < 0.3)
    );
}

/// The inside of a unit cube.
const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    g floor\nf 1 2 3 4\ng walls\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n\
    g ceiling\nf 5 8 7 6\n";

#[test]
fn groups_of_a_mesh_file_are_parts() {
    let place = Place::new();
    place.write("cube.obj", CUBE);
    let surface = "[materials.white]\nreflectance = 0.5\n[[surfaces]]\nname = \"cube\"\n\
        material = \"white\"\nmesh = { file = \"cube.obj\" }\ndivisions = 3\n";
    place.write("cube.toml", surface);
    place.succeed("form-factors cube.toml --cache c --export f.csv --by group");
    let lines = read_table(&place, "f.csv");
    let factor = |from: &str, to: &str| {
        let is_it = |line: &&BTreeMap<_, _>| line["from"] == from && line["to"] == to;
        number(lines.iter().find(is_it).unwrap(), "F")
    };
    // Of opposite squares (Howell, C-11), to its published digits.
    let opposite = 0.199_825;
    assert!((factor("cube/floor", "cube/ceiling") - opposite).abs() < 2e-6);
    assert!((factor("cube/floor", "cube/walls") - (1.0 - opposite)).abs() < 2e-6);
}

/// Plates above a floor, far from each other, in no order of their places.
#[test]
fn rows_are_in_the_order_of_the_file() {
    let place = Place::new();
    let mut obj = String::new();
    let groups = [
        ("west", 0),
        ("far east", 90),
        ("middle", 40),
        ("west", 3),
        ("east", 60),
    ];
    for (group, x) in groups {
        let far = x + 1;
        let corners = format!("v {x} 0 1\nv {x} 1 1\nv {far} 1 1\nv {far} 0 1\n");
        obj += &format!("{corners}g {group}\nf -4 -3 -2 -1\n");
    }
    place.write("plates.obj", &obj);
    let scene = "[materials.white]\nreflectance = 0.5\n\
        [[surfaces]]\nname = \"plates\"\nmaterial = \"white\"\nmesh = { file = \"plates.obj\" }\n\
        [[surfaces]]\nname = \"floor\"\nmaterial = \"white\"\ndivisions = 1\n\
        parallelogram = { corner = [0, 0, 0], edge_a = [99, 0, 0], edge_b = [0, 1, 0] }\n";
    place.write("plates.toml", scene);
    let names = |by: &str| {
        place.succeed(&format!(
            "form-factors plates.toml --cache c --export f.csv --by {by}"
        ));
        let mut names: Vec<String> = read_table(&place, "f.csv")
            .into_iter()
            .map(|line| line["from"].clone())
            .collect();
        names.dedup();
        let rows = read_table(&place, "f.rows.csv");
        assert!(names.iter().eq(rows.iter().map(|row| &row["name"])));
        names
    };
    let groups = ["west", "far east", "middle", "east"].map(|group| format!("plates/{group}"));
    assert_eq!(
        names("group"),
        [&groups[..], &["floor".to_owned()]].concat()
    );
    assert_eq!(names("surface"), ["plates", "floor"]);
}

#[test]
fn what_is_left_out_is_told() {
    let place = Place::new();
    place.succeed("form-factors room.toml --cache c --export f.npy");
    place.succeed("form-factors room.toml --cache c --export f.csv --sparse 0.01");
    let (factors, rows) = (read_npy(&place, "f.npy"), read_table(&place, "f.rows.csv"));
    let mut kept = vec![0.0; rows.len()];
    for line in read_table(&place, "f.csv") {
        let [i, j] = ["row", "column"].map(|index| number(&line, index) as usize);
        let factor = number(&line, "F");
        assert!(factor >= 0.01 && factor as f32 == factors[i][j] as f32);
        kept[i] += factor;
    }
    for (row, kept) in rows.iter().zip(kept) {
        let sum = kept + number(row, "dropped");
        // Three digits of what was dropped.
        let rounding = 1e-6 + 0.01 * number(row, "dropped");
        assert!((sum - number(row, "fronts")).abs() < rounding, "{row:?}");
    }
    assert!(rows.iter().any(|row| number(row, "dropped") > 0.0));
}

#[test]
fn exports_that_make_no_sense_are_refused() {
    let place = Place::new();
    let (code, message) = place.fail("form-factors room.toml --export f.npy --sparse 0.1");
    assert_eq!(code, 3);
    assert!(message.contains("--sparse is for .csv alone"), "{message}");
    let (code, message) = place.fail("form-factors room.toml --export f.xls");
    assert_eq!(code, 2);
    assert!(message.contains("ends in .npy or .csv"), "{message}");
    let (code, _) = place.fail("form-factors room.toml --by surface");
    assert_eq!(code, 2);
    let (code, _) = place.fail("form-factors room.toml --export missing/f.npy");
    assert_eq!(code, 1);
}

/// The limit ends the command when it writes, which is after it has said so.
#[cfg(unix)]
#[test]
fn exports_of_hundreds_of_megabytes_are_announced() {
    let place = Place::new();
    let program = env!("CARGO_BIN_EXE_radiosity");
    let announced = |arguments: &str| {
        let export = format!("{program} form-factors room.toml --no-cache {arguments}");
        let limited = format!("ulimit -c 0; ulimit -f 8; exec {export}");
        let mut command = assert_cmd::Command::new("sh");
        let command = command.args(["-c", &limited]).current_dir(&place.0);
        String::from_utf8(command.output().unwrap().stderr).unwrap()
    };
    let regular = "--mode regular --points 1 --patches 106 --export";
    let said = announced(&format!("{regular} f.npy"));
    assert!(
        said.contains("warning: the export will take 506 MB of disk"),
        "{said}"
    );
    let said = announced(&format!("{regular} f.csv --by surface"));
    assert!(!said.contains("warning: the export"), "{said}");
}
