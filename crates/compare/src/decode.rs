//! Pictures from files' bytes: EXR, HDR, PFM, PPM and PNG, as linear radiance.

use crate::head::Format;
use crate::portable;
use crate::size::{PER_BYTE, SizeError, check_size};
use image::ImageDecoder;
use image::codecs::hdr::HdrDecoder;
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
    let linear = |image| Decoded {
        image,
        levels: false,
    };
    let shown = |image| Decoded {
        image,
        levels: true,
    };
    match Format::of(bytes)? {
        Format::Png => png_radiance(bytes, screen).map(shown),
        #[cfg(feature = "openexr")]
        Format::OpenExr => exr_radiance(bytes).map(linear),
        #[cfg(not(feature = "openexr"))]
        Format::OpenExr => Err(DecodeError::LeftOut),
        Format::Hdr => hdr_radiance(bytes).map(linear),
        Format::FloatMap => portable::float_map(bytes).map(linear),
        Format::Pixmap => portable::pixmap(bytes, |level| screen.radiance(level, None)).map(shown),
    }
}

/// Says what is wrong with a file of a format.
fn broken<E: std::fmt::Display>(format: &'static str) -> impl Fn(E) -> DecodeError {
    move |error| DecodeError::Broken {
        format,
        problem: error.to_string(),
    }
}

/// Behind the head of a PNG, of a size that is read.
pub(crate) fn png_reader(bytes: &[u8]) -> Result<png::Reader<Cursor<&[u8]>>, DecodeError> {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    // Of no use here, and packed as well.
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let reader = decoder.read_info().map_err(broken("PNG"))?;
    let (width, height) = reader.info().size();
    check_size((width.into(), height.into()), bytes, PER_BYTE)?;
    Ok(reader)
}

fn png_radiance(bytes: &[u8], screen: &Screen) -> Result<Image, DecodeError> {
    let mut reader = png_reader(bytes)?;
    let own = own_transfer(reader.info());
    let (width, height) = reader.info().size();
    let size = reader.output_buffer_size().ok_or(DecodeError::Unknown)?;
    let mut data = vec![0; size];
    let info = reader.next_frame(&mut data).map_err(broken("PNG"))?;
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

/// The heads of the layers of an OpenEXR file, of sizes that are read.
#[cfg(feature = "openexr")]
pub(crate) fn exr_headers(bytes: &[u8]) -> Result<exr::meta::Headers, DecodeError> {
    let meta = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false);
    let headers = meta.map_err(broken("OpenEXR"))?.headers;
    for header in &headers {
        let size = header.layer_size;
        check_size((size.width() as u64, size.height() as u64), bytes, PER_BYTE)?;
        check_blocks(header, bytes)?;
    }
    Ok(headers)
}

#[cfg(feature = "openexr")]
fn exr_radiance(bytes: &[u8]) -> Result<Image, DecodeError> {
    use exr::prelude::{ReadChannels, ReadLayers, read};
    exr_headers(bytes)?;
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
        .map_err(broken("OpenEXR"))?;
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

/// Behind the head of a Radiance picture, of a size that is read.
pub(crate) fn hdr_decoder(bytes: &[u8]) -> Result<HdrDecoder<Cursor<&[u8]>>, DecodeError> {
    let decoder = HdrDecoder::new(Cursor::new(bytes)).map_err(broken("HDR"))?;
    let (width, height) = decoder.dimensions();
    check_size((width.into(), height.into()), bytes, PER_BYTE)?;
    Ok(decoder)
}

fn hdr_radiance(bytes: &[u8]) -> Result<Image, DecodeError> {
    let decoder = hdr_decoder(bytes)?;
    let (width, height) = decoder.dimensions();
    let mut image = Image::black(width, height);
    let data = bytemuck::cast_slice_mut(&mut image.pixels);
    decoder.read_image(data).map_err(broken("HDR"))?;
    Ok(image)
}
