//! Maps that say which region of a picture a pixel belongs to.

use super::size::{PER_BYTE_OF_MAP, SizeError, check_size};
use std::io::Cursor;

/// The region of each pixel, row by row from the top left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Regions {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// One number per pixel.
    pub labels: Vec<u8>,
}

/// Why bytes are no map of regions.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RegionsError {
    /// Not a PNG.
    #[error("is not a good PNG file: {0}")]
    Png(String),
    /// A map of no pixels, or of too many for its file.
    #[error("{0}")]
    Size(#[from] SizeError),
    /// A PNG of another kind.
    #[error("is no map of regions: it must be a grey PNG of 8 bits, whose levels are the regions")]
    NotGrey,
}

/// Reads an 8-bit grey PNG whose levels are the numbers of regions.
pub fn decode_regions(bytes: &[u8]) -> Result<Regions, RegionsError> {
    let broken = |error: png::DecodingError| RegionsError::Png(error.to_string());
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::IDENTITY);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let mut reader = decoder.read_info().map_err(broken)?;
    let info = reader.info();
    if (info.color_type, info.bit_depth) != (png::ColorType::Grayscale, png::BitDepth::Eight) {
        return Err(RegionsError::NotGrey);
    }
    let size = (u64::from(info.width), u64::from(info.height));
    check_size(size, bytes, PER_BYTE_OF_MAP)?;
    let size = reader.output_buffer_size().ok_or(RegionsError::NotGrey)?;
    let mut labels = vec![0; size];
    let info = reader.next_frame(&mut labels).map_err(broken)?;
    Ok(Regions {
        width: info.width,
        height: info.height,
        labels,
    })
}
