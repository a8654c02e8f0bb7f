//! The reference data.

use crate::in_checkout;
use radiosity::compare::{Table, parse_table};
use radiosity::geometry::PixelFilter;
use radiosity::image::{DecodeParams, Decoded, Regions, decode_picture, decode_regions};

fn data(name: &str) -> Vec<u8> {
    std::fs::read(in_checkout(&format!("tests/data/{name}"))).expect("the data is there")
}

/// The path-traced radiosities of the n x n grids of `cornell.toml`; n is 4, 12 or 24.
pub fn reference_table(n: u32) -> Table {
    parse_table(&data(&format!("cornell-radiosity-{n}x{n}.csv"))).expect("the table is well-formed")
}

/// The path-traced picture of `cornell.toml`.
pub fn radiance(filter: PixelFilter) -> Decoded {
    let name = match filter {
        PixelFilter::Tents => "cornell-radiance-course-filter.exr",
        PixelFilter::Box => "cornell-radiance-box.exr",
        other => panic!("there is no picture by {other:?}"),
    };
    decode_picture(&data(name), &DecodeParams::default()).expect("the picture is well-formed")
}

/// The region of each pixel of that picture.
pub fn regions() -> Regions {
    decode_regions(&data("cornell-regions.png")).expect("the map is well-formed")
}
