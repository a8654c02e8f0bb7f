//! OpenEXR.

use super::DecodeError;
use super::size::{PER_BYTE, check_size};
use crate::image::Image;
use exr::error::Error;
use exr::math::Vec2;
use exr::meta::MetaData;
use exr::meta::header::Header;
use exr::prelude::{ReadChannels, ReadLayers, read};
use std::io::Cursor;

/// The first layer that has red, green and blue.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, DecodeError> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false);
    for header in meta.map_err(|error| broken(&error))?.headers {
        let size = header.layer_size;
        check_size((size.width() as u64, size.height() as u64), bytes, PER_BYTE)?;
        check_blocks(&header, bytes)?;
    }
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| Image::black(size.width() as u32, size.height() as u32),
            set_pixel,
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| broken(&error))?;
    Ok(image.layer_data.channel_data.pixels)
}

fn set_pixel(image: &mut Image, at: Vec2<usize>, (r, g, b): (f32, f32, f32)) {
    let index = at.y() * image.width as usize + at.x();
    image.pixels[index] = [r, g, b];
}

/// Pictures are unpacked block by block, of which a small one may claim to have large ones, or ones of
/// many channels; by three channels a pixel is counted.
fn check_blocks(header: &Header, bytes: &[u8]) -> Result<(), DecodeError> {
    let size = header.max_block_pixel_size();
    let channels = header.channels.list.len();
    let pixels_wide = size.width() * channels.div_ceil(3);
    let checked = check_size((pixels_wide as u64, size.height() as u64), bytes, PER_BYTE);
    checked.map_err(|_| DecodeError::Broken {
        format: FORMAT,
        problem: format!(
            "its blocks of {} x {} pixels with {channels} channels are too large for a file of {} bytes",
            size.width(),
            size.height(),
            bytes.len()
        ),
    })
}

const FORMAT: &str = "OpenEXR";

fn broken(error: &Error) -> DecodeError {
    DecodeError::Broken {
        format: FORMAT,
        problem: error.to_string(),
    }
}
