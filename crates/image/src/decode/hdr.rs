//! Radiance's pictures: a common exponent for three channels of 8 bits.

use super::DecodeError;
use super::size::{PER_BYTE, check_size};
use crate::image::Image;
use image::codecs::hdr::HdrDecoder;
use image::{ImageDecoder, ImageError};
use std::io::Cursor;

pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    decoder(bytes).map(|decoder| decoder.dimensions())
}

pub(super) fn decode(bytes: &[u8]) -> Result<Image, DecodeError> {
    let decoder = decoder(bytes)?;
    let (width, height) = decoder.dimensions();
    let mut image = Image::black(width, height);
    let data = bytemuck::cast_slice_mut(&mut image.pixels);
    decoder.read_image(data).map_err(|error| broken(&error))?;
    Ok(image)
}

/// Behind the head, of a size that is read.
fn decoder(bytes: &[u8]) -> Result<HdrDecoder<Cursor<&[u8]>>, DecodeError> {
    let decoder = HdrDecoder::new(Cursor::new(bytes)).map_err(|error| broken(&error))?;
    let (width, height) = decoder.dimensions();
    check_size((width.into(), height.into()), bytes, PER_BYTE)?;
    Ok(decoder)
}

fn broken(error: &ImageError) -> DecodeError {
    DecodeError::Broken {
        format: "HDR",
        problem: error.to_string(),
    }
}
