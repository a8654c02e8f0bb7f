//! OpenEXR.

use super::DecodeError;
use super::size::{PER_BYTE, check_size};
use crate::image::Image;
use exr::error::Error;
use exr::math::Vec2;
use exr::meta::header::Header;
use exr::meta::{Headers, MetaData};
use exr::prelude::{ReadChannels, ReadLayers, read};
use std::io::Cursor;

/// That of the largest layer.
pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    let headers = headers(bytes)?;
    let sizes = headers.iter().map(|header| header.layer_size);
    let size = sizes
        .max_by_key(|size| size.area())
        .ok_or(DecodeError::Unknown)?;
    Ok((size.width() as u32, size.height() as u32))
}

/// The heads of all layers, of sizes that are read.
fn headers(bytes: &[u8]) -> Result<Headers, DecodeError> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false);
    let headers = meta.map_err(|error| broken(&error))?.headers;
    for header in &headers {
        let size = header.layer_size;
        check_size((size.width() as u64, size.height() as u64), bytes, PER_BYTE)?;
        check_blocks(header, bytes)?;
    }
    Ok(headers)
}

/// The first layer that has red, green and blue.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, DecodeError> {
    headers(bytes)?;
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

/// Pictures are unpacked block by block, of which a small one may claim to have large ones, or ones
/// of many channels; by three channels a pixel is counted.
fn check_blocks(header: &Header, bytes: &[u8]) -> Result<(), DecodeError> {
    let size = header.max_block_pixel_size();
    let channels = header.channels.list.len();
    let pixels_wide = size.width() * channels.div_ceil(3);
    let checked = check_size((pixels_wide as u64, size.height() as u64), bytes, PER_BYTE);
    checked.map_err(|_| DecodeError::Broken {
        format: FORMAT,
        problem: format!(
            "its blocks of {} x {} pixels with {channels} channels are too large for a file of {} \
             bytes",
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
