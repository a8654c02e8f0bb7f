//! Portable pixmaps and float maps.

use crate::image::Image;
use crate::rgb8_image::Rgb8Image;
use std::fmt::Write;

/// The bytes of a portable float map (PF): linear numbers, 32-bit, little endian, rows from the
/// bottom up as the format wants them.
pub fn encode_pfm(image: &Image) -> Vec<u8> {
    let mut bytes = format!("PF\n{} {}\n-1.0\n", image.width, image.height).into_bytes();
    for row in image.pixels.chunks_exact(image.width as usize).rev() {
        for channel in row.iter().flatten() {
            bytes.extend(channel.to_le_bytes());
        }
    }
    bytes
}

fn header(magic: &str, picture: &Rgb8Image) -> String {
    format!("{magic}\n{} {}\n255\n", picture.width, picture.height)
}

/// One pixel a line: the format allows no line over 70 characters.
pub(super) fn plain_ppm(picture: &Rgb8Image) -> Vec<u8> {
    let mut text = header("P3", picture);
    text.reserve(12 * picture.bytes.len() / 3);
    for pixel in picture.bytes.chunks_exact(3) {
        writeln!(text, "{} {} {}", pixel[0], pixel[1], pixel[2]).expect("strings take all text");
    }
    text.into_bytes()
}

pub(super) fn ppm(picture: &Rgb8Image) -> Vec<u8> {
    [header("P6", picture).as_bytes(), &picture.bytes].concat()
}
