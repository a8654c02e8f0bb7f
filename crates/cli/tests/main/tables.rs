//! Tables that the command has written, by the names of their columns.

use crate::place::Place;
use std::collections::BTreeMap;
use std::fs;

/// The lines of a table, by the names of its columns.
pub(crate) fn read_table(place: &Place, name: &str) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(place.path(name)).unwrap();
    let mut lines = text.lines().map(split);
    let columns = lines.next().unwrap();
    lines
        .map(|line| columns.iter().cloned().zip(line).collect())
        .collect()
}

/// The fields of a line; quotes are around whole fields in these tests.
fn split(line: &str) -> Vec<String> {
    let line = line.replace("\"lamp, the only one\"", "lamp");
    line.split(',').map(str::to_owned).collect()
}

/// Of each line of a table the patch, like `floor,0,1`.
pub(crate) fn cells(place: &Place, name: &str) -> Vec<String> {
    let cell = |line: BTreeMap<String, String>| {
        ["surface", "ia", "ib"]
            .map(|column| line[column].as_str())
            .join(",")
    };
    read_table(place, name).into_iter().map(cell).collect()
}

pub(crate) fn number(line: &BTreeMap<String, String>, column: &str) -> f64 {
    line[column].parse().unwrap()
}
