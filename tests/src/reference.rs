//! The reference data.

use crate::in_checkout;
use radiosity::compare::{
    Decoded, Regions, Screen, Table, decode_picture, decode_regions, parse_table,
};

fn data(name: &str) -> Vec<u8> {
    std::fs::read(in_checkout(&format!("tests/data/{name}"))).expect("the data is there")
}

/// The path-traced radiosities of the 12 x 12 grids of `cornell.toml`.
pub fn radiosity_table() -> Table {
    parse_table(&data("cornell-radiosity-12x12.csv")).expect("the table is well-formed")
}

/// The path-traced picture of `cornell.toml`, with the course's pixel filter.
pub fn radiance() -> Decoded {
    let linear = Screen {
        exposure: 1.0,
        gamma: None,
    };
    let bytes = data("cornell-radiance-course-filter.exr");
    decode_picture(&bytes, &linear).expect("the picture is well-formed")
}

/// The region of each pixel of that picture.
pub fn regions() -> Regions {
    decode_regions(&data("cornell-regions.png")).expect("the map is well-formed")
}
