//! The reference data.

use crate::in_checkout;
use radiosity::renderer::Image;
use std::collections::HashMap;
use std::fs::File;

/// Radiosity by surface and cell.
pub type RadiosityTable = HashMap<(String, u32, u32), [f64; 3]>;

/// The path-traced radiosities of the 12 x 12 grids of `cornell.toml`.
pub fn radiosity_table() -> RadiosityTable {
    let path = in_checkout("tests/data/cornell-radiosity-12x12.csv");
    let mut reader = csv::Reader::from_path(path).expect("the table is there");
    let mut table = RadiosityTable::new();
    for row in reader.records() {
        let row = row.expect("the table is well-formed");
        let number = |column: usize| row[column].parse::<f64>().expect("a number");
        let cell = (row[0].to_owned(), number(1) as u32, number(2) as u32);
        table.insert(cell, [number(3), number(4), number(5)]);
    }
    table
}

/// The path-traced picture of `cornell.toml`, with the course's pixel filter.
pub fn radiance() -> Image {
    use exr::prelude::*;
    let path = in_checkout("tests/data/cornell-radiance-course-filter.exr");
    let image = read_first_rgba_layer_from_file(
        path,
        |size, _| radiosity::renderer::Image::black(size.width() as u32, size.height() as u32),
        |image, at, (r, g, b, _): (f32, f32, f32, f32)| {
            let index = at.y() * image.width as usize + at.x();
            image.pixels[index] = [r, g, b];
        },
    );
    image
        .expect("the picture is well-formed")
        .layer_data
        .channel_data
        .pixels
}

/// The region of each pixel of that picture.
pub fn regions() -> Vec<u8> {
    let path = in_checkout("tests/data/cornell-regions.png");
    let file = File::open(path).expect("the regions are there");
    let mut decoder = png::Decoder::new(std::io::BufReader::new(file));
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().expect("a PNG");
    let size = reader.output_buffer_size().expect("a known size");
    let mut pixels = vec![0; size];
    let info = reader.next_frame(&mut pixels).expect("a whole PNG");
    assert_eq!(
        (info.color_type, info.bit_depth),
        (png::ColorType::Grayscale, png::BitDepth::Eight)
    );
    pixels
}
