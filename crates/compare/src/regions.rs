//! Maps that say which region of a picture a pixel belongs to.

use crate::decode::check_size;
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
    /// A PNG of another kind.
    #[error("is no map of regions: it must be a grey PNG of 8 bits, whose levels are the regions")]
    NotGrey,
}

/// Reads an 8-bit grey PNG whose levels are the numbers of regions.
pub fn decode_regions(bytes: &[u8]) -> Result<Regions, RegionsError> {
    let broken = |error: png::DecodingError| RegionsError::Png(error.to_string());
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().map_err(broken)?;
    let (width, height) = (reader.info().width, reader.info().height);
    let sized = check_size("PNG", width.into(), height.into());
    sized.map_err(|error| RegionsError::Png(error.to_string()))?;
    let size = reader.output_buffer_size().ok_or(RegionsError::NotGrey)?;
    let mut labels = vec![0; size];
    let info = reader.next_frame(&mut labels).map_err(broken)?;
    if (info.color_type, info.bit_depth) != (png::ColorType::Grayscale, png::BitDepth::Eight) {
        return Err(RegionsError::NotGrey);
    }
    Ok(Regions {
        width: info.width,
        height: info.height,
        labels,
    })
}
