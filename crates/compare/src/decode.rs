//! Pictures from files' bytes: EXR, HDR, PFM, PPM and PNG, as linear radiance.

use crate::portable;
use crate::size::{PER_BYTE, SizeError, check_size};
use image::codecs::hdr::HdrDecoder;
use image::{ImageDecoder, ImageError};
use radiosity_renderer::{Image, Transfer};
use std::io::Cursor;

/// How the levels of an 8-bit picture came from radiance:
/// `level = transfer(exposure * L)`, in units of the brightest level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// Factor from radiance to brightness.
    pub exposure: f64,
    /// The curve, whatever a PNG says of itself.
    pub transfer: Option<Transfer>,
    /// The curve of pictures that say nothing of themselves.
    pub usual: Transfer,
}

/// A picture as linear radiance.
#[derive(Clone, Debug, PartialEq)]
pub struct Decoded {
    /// Radiance in W/(m^2 sr).
    pub image: Image,
    /// Whether it was made of levels, whose brightest stands for anything brighter too.
    pub levels: bool,
}

/// Why bytes are not a picture.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DecodeError {
    /// None of the known formats.
    #[error("is none of the formats that can be read: OpenEXR, Radiance HDR, PFM, PPM, PNG")]
    Unknown,
    /// OpenEXR, which this build does not read.
    #[error("is an OpenEXR file, which this build does not read: build with the feature `openexr`")]
    LeftOut,
    /// A picture of no pixels, or of too many for its file.
    #[error("{0}")]
    Size(#[from] SizeError),
    /// A known format with something wrong in it.
    #[error("is not a good {format} file: {problem}")]
    Broken {
        /// The format's name.
        format: &'static str,
        /// What is wrong.
        problem: String,
    },
}

impl Screen {
    /// Radiance of a level between 0 and 1.
    fn radiance(&self, level: f64, own: Option<Transfer>) -> f32 {
        let transfer = self.transfer.or(own).unwrap_or(self.usual);
        (transfer.decode(level) / self.exposure) as f32
    }
}

/// Reads a picture whose format its first bytes tell. Levels become radiance as `screen` says;
/// OpenEXR, HDR and PFM hold radiance already.
pub fn decode_picture(bytes: &[u8], screen: &Screen) -> Result<Decoded, DecodeError> {
    const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";
    const EXR: &[u8] = b"\x76\x2f\x31\x01";
    let linear = |image| Decoded {
        image,
        levels: false,
    };
    let shown = |image| Decoded {
        image,
        levels: true,
    };
    if bytes.starts_with(PNG) {
        png_radiance(bytes, screen).map(shown)
    } else if bytes.starts_with(EXR) {
        #[cfg(feature = "openexr")]
        return exr_radiance(bytes).map(linear);
        #[cfg(not(feature = "openexr"))]
        Err(DecodeError::LeftOut)
    } else if bytes.starts_with(b"#?RADIANCE") {
        hdr_radiance(bytes).map(linear)
    } else if bytes.starts_with(b"PF") || bytes.starts_with(b"Pf") {
        portable::float_map(bytes).map(linear)
    } else if bytes.starts_with(b"P3") || bytes.starts_with(b"P6") {
        portable::pixmap(bytes, |level| screen.radiance(level, None)).map(shown)
    } else {
        Err(DecodeError::Unknown)
    }
}

fn png_radiance(bytes: &[u8], screen: &Screen) -> Result<Image, DecodeError> {
    let broken = |error: png::DecodingError| DecodeError::Broken {
        format: "PNG",
        problem: error.to_string(),
    };
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    // Of no use here, and packed as well.
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let mut reader = decoder.read_info().map_err(broken)?;
    let own = own_transfer(reader.info());
    let (width, height) = (reader.info().width, reader.info().height);
    check_size((width.into(), height.into()), bytes, PER_BYTE)?;
    let size = reader.output_buffer_size().ok_or(DecodeError::Unknown)?;
    let mut data = vec![0; size];
    let info = reader.next_frame(&mut data).map_err(broken)?;
    let levels: fn(&[u8]) -> f64 = match info.bit_depth {
        png::BitDepth::Sixteen => |two| f64::from(u16::from_be_bytes([two[0], two[1]])) / 65535.0,
        _ => |one| f64::from(one[0]) / 255.0,
    };
    let sample_size = if info.bit_depth == png::BitDepth::Sixteen {
        2
    } else {
        1
    };
    let channels = info.color_type.samples();
    let pixel = |samples: &[u8]| {
        let channel = |c: usize| screen.radiance(levels(&samples[c * sample_size..]), own);
        match channels {
            1 | 2 => [channel(0); 3],
            _ => [0, 1, 2].map(channel),
        }
    };
    let pixels = data.chunks_exact(channels * sample_size);
    Ok(Image {
        width,
        height,
        pixels: pixels.map(pixel).collect(),
    })
}

/// The curve that a PNG says it has.
fn own_transfer(info: &png::Info<'_>) -> Option<Transfer> {
    let gamma = info.gamma().map(|g| 1.0 / f64::from(g.into_value()));
    match info.srgb {
        Some(_) => Some(Transfer::Srgb),
        None => gamma.filter(|gamma| gamma.is_finite()).map(Transfer::Gamma),
    }
}

#[cfg(feature = "openexr")]
fn exr_radiance(bytes: &[u8]) -> Result<Image, DecodeError> {
    use exr::prelude::{ReadChannels, ReadLayers, read};
    let broken = |error: exr::error::Error| DecodeError::Broken {
        format: "OpenEXR",
        problem: error.to_string(),
    };
    let meta = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false);
    for header in meta.map_err(broken)?.headers {
        let size = header.layer_size;
        check_size((size.width() as u64, size.height() as u64), bytes, PER_BYTE)?;
        check_blocks(&header, bytes)?;
    }
    let set = |image: &mut Image, at: exr::math::Vec2<usize>, (r, g, b): (f32, f32, f32)| {
        let index = at.y() * image.width as usize + at.x();
        image.pixels[index] = [r, g, b];
    };
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| Image::black(size.width() as u32, size.height() as u32),
            set,
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(broken)?;
    Ok(image.layer_data.channel_data.pixels)
}

/// Pictures are unpacked block by block, of which a small one may claim to have large ones, or ones of
/// many channels; by three channels a pixel is counted.
#[cfg(feature = "openexr")]
fn check_blocks(header: &exr::meta::header::Header, bytes: &[u8]) -> Result<(), DecodeError> {
    let size = header.max_block_pixel_size();
    let pixels_wide = size.width() * header.channels.list.len().div_ceil(3);
    let checked = check_size((pixels_wide as u64, size.height() as u64), bytes, PER_BYTE);
    checked.map_err(|_| DecodeError::Broken {
        format: "OpenEXR",
        problem: format!(
            "its blocks of {} x {} pixels with {} channels are too large for a file of {} bytes",
            size.width(),
            size.height(),
            header.channels.list.len(),
            bytes.len()
        ),
    })
}

fn hdr_radiance(bytes: &[u8]) -> Result<Image, DecodeError> {
    let broken = |error: ImageError| DecodeError::Broken {
        format: "HDR",
        problem: error.to_string(),
    };
    let decoder = HdrDecoder::new(Cursor::new(bytes)).map_err(broken)?;
    let (width, height) = decoder.dimensions();
    check_size((width.into(), height.into()), bytes, PER_BYTE)?;
    let mut image = Image::black(width, height);
    let data = bytemuck::cast_slice_mut(&mut image.pixels);
    decoder.read_image(data).map_err(broken)?;
    Ok(image)
}
