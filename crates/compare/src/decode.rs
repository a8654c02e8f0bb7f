//! Pictures from files' bytes: EXR, HDR, PFM, PPM and PNG, as linear radiance.

use crate::portable;
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
    if bytes.starts_with(PNG) {
        png_levels(bytes, screen)
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
        let levels = portable::levels(bytes)?;
        let radiance = |level| screen.radiance(level, None);
        Ok(levels.map(radiance))
    } else {
        Err(DecodeError::Unknown)
    }
}

/// A picture of levels between 0 and 1.
pub(crate) struct Levels {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) pixels: Vec<[f64; 3]>,
}

impl Levels {
    fn map(self, radiance: impl Fn(f64) -> f32) -> Decoded {
        let pixels = self.pixels.into_iter();
        Decoded {
            image: Image {
                width: self.width,
                height: self.height,
                pixels: pixels.map(|pixel| pixel.map(&radiance)).collect(),
            },
            levels: true,
        }
    }
}

fn png_levels(bytes: &[u8], screen: &Screen) -> Result<Decoded, DecodeError> {
    let broken = |error: png::DecodingError| DecodeError::Broken {
        format: "PNG",
        problem: error.to_string(),
    };
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(broken)?;
    let gamma = reader.info().gamma();
    let gamma = gamma.map(|g| 1.0 / f64::from(g.into_value()));
    let own = match reader.info().srgb {
        Some(_) => Some(Transfer::Srgb),
        None => gamma.filter(|gamma| gamma.is_finite()).map(Transfer::Gamma),
    };
    let (width, height) = (reader.info().width, reader.info().height);
    check_size("PNG", width.into(), height.into())?;
    let size = reader.output_buffer_size().ok_or(DecodeError::Unknown)?;
    let mut data = vec![0; size];
    let info = reader.next_frame(&mut data).map_err(broken)?;
    let samples: Vec<f64> = match info.bit_depth {
        png::BitDepth::Sixteen => {
            let words = data.as_chunks::<2>().0.iter();
            words
                .map(|&word| f64::from(u16::from_be_bytes(word)) / 65535.0)
                .collect()
        }
        _ => data.iter().map(|&byte| f64::from(byte) / 255.0).collect(),
    };
    let channels = info.color_type.samples();
    let pixel = |samples: &[f64]| match channels {
        1 | 2 => [samples[0]; 3],
        _ => [samples[0], samples[1], samples[2]],
    };
    let levels = Levels {
        width,
        height,
        pixels: samples.chunks_exact(channels).map(pixel).collect(),
    };
    Ok(levels.map(|level| screen.radiance(level, own)))
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
        check_size("OpenEXR", size.width() as u64, size.height() as u64)?;
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

fn hdr_radiance(bytes: &[u8]) -> Result<Image, DecodeError> {
    let broken = |error: ImageError| DecodeError::Broken {
        format: "HDR",
        problem: error.to_string(),
    };
    let decoder = HdrDecoder::new(Cursor::new(bytes)).map_err(broken)?;
    let (width, height) = decoder.dimensions();
    check_size("HDR", width.into(), height.into())?;
    let mut data = vec![0; 12 * width as usize * height as usize];
    decoder.read_image(&mut data).map_err(broken)?;
    let pixels = data.as_chunks::<12>().0.iter();
    let channel =
        |bytes: &[u8; 12], c: usize| f32::from_ne_bytes([0, 1, 2, 3].map(|k| bytes[4 * c + k]));
    Ok(Image {
        width,
        height,
        pixels: pixels.map(|p| [0, 1, 2].map(|c| channel(p, c))).collect(),
    })
}

/// Larger pictures are refused before memory is taken for them.
const MAX_PIXELS: u64 = 1 << 28;

/// Refuses pictures without pixels, or with more than memory is taken for.
pub(crate) fn check_size(format: &'static str, width: u64, height: u64) -> Result<(), DecodeError> {
    let pixels = width.checked_mul(height);
    match pixels {
        Some(1..=MAX_PIXELS) => Ok(()),
        _ => Err(DecodeError::Broken {
            format,
            problem: format!("{width} x {height} pixels are none, or too many"),
        }),
    }
}
