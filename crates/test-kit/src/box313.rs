//! A closed box of 313 rectangles with a cuboid in it, and its exact form factors: see
//! `tests/data/README.md`.

use crate::shipped::in_checkout;
use radiosity_geometry::{DVec3, Shape};
use std::path::PathBuf;

/// How many rectangles there are.
pub const ELEMENTS: usize = 313;

/// The rectangles.
pub fn shapes() -> Vec<Shape> {
    let path = data("polygons.csv");
    let text = std::fs::read_to_string(&path);
    let text = text.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    text.lines().skip(1).map(rectangle).collect()
}

/// The factors from rectangle to rectangle, row by row; exact to 3e-7.
pub fn exact_factors() -> Vec<f32> {
    let path = data("form-factors.npy");
    let bytes = std::fs::read(&path);
    let bytes = bytes.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let values = &bytes[bytes.len() - 4 * ELEMENTS * ELEMENTS..];
    let values = values.as_chunks::<4>().0.iter();
    values.map(|&bytes| f32::from_le_bytes(bytes)).collect()
}

fn data(name: &str) -> PathBuf {
    in_checkout("tests/data/box313").join(name)
}

fn rectangle(line: &str) -> Shape {
    let number = |word: &str| {
        word.parse()
            .unwrap_or_else(|error| panic!("{word}: {error}"))
    };
    let numbers: Vec<f64> = line.split(',').map(number).collect();
    Shape::Quad([0, 1, 2, 3].map(|k: usize| DVec3::from_slice(&numbers[2 + 3 * k..])))
}
