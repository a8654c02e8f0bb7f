//! Portable network graphics: grey or colour, of 8 or 16 bits.

use super::size::{PER_BYTE, check_size};
use super::{DecodeError, DecodeParams};
use crate::image::Image;
use crate::tone::Transfer;
use std::io::Cursor;

pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    reader(bytes).map(|reader| reader.info().size())
}

/// The radiance that levels stand for.
pub(super) fn decode(bytes: &[u8], params: &DecodeParams) -> Result<Image, DecodeError> {
    let mut reader = reader(bytes)?;
    let own = own_transfer(reader.info());
    let (width, height) = reader.info().size();
    let size = reader.output_buffer_size().ok_or(DecodeError::Unknown)?;
    let mut data = vec![0; size];
    let info = reader
        .next_frame(&mut data)
        .map_err(|error| broken(&error))?;
    let channels = info.color_type.samples();
    let sample_size = if info.bit_depth == png::BitDepth::Sixteen {
        2
    } else {
        1
    };
    let radiance = |samples: &[u8], channel: usize| {
        let sample = &samples[channel * sample_size..][..sample_size];
        params.radiance(level(sample), own)
    };
    let pixel = |samples: &[u8]| match channels {
        1 | 2 => [radiance(samples, 0); 3],
        _ => [0, 1, 2].map(|channel| radiance(samples, channel)),
    };
    let pixels = data.chunks_exact(channels * sample_size);
    Ok(Image {
        width,
        height,
        pixels: pixels.map(pixel).collect(),
    })
}

/// Behind the head, of a size that is read.
fn reader(bytes: &[u8]) -> Result<png::Reader<Cursor<&[u8]>>, DecodeError> {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    // Of no use here, and packed as well.
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let reader = decoder.read_info().map_err(|error| broken(&error))?;
    let (width, height) = reader.info().size();
    check_size((width.into(), height.into()), bytes, PER_BYTE)?;
    Ok(reader)
}

/// The level of a sample of one or two bytes, from 0 to 1.
fn level(sample: &[u8]) -> f64 {
    match *sample {
        [high, low] => f64::from(u16::from_be_bytes([high, low])) / 65535.0,
        _ => f64::from(sample[0]) / 255.0,
    }
}

/// The curve that a PNG says it has.
fn own_transfer(info: &png::Info<'_>) -> Option<Transfer> {
    let gamma = info.gamma().map(|g| 1.0 / f64::from(g.into_value()));
    match info.srgb {
        Some(_) => Some(Transfer::Srgb),
        None => gamma.filter(|gamma| gamma.is_finite()).map(Transfer::Gamma),
    }
}

fn broken(error: &png::DecodingError) -> DecodeError {
    DecodeError::Broken {
        format: "PNG",
        problem: error.to_string(),
    }
}
