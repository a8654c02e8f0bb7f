//! The portable formats: float maps (PF) and pixmaps (P3, P6), as the Netpbm manual and
//! Debevec's PFM description define them.

use super::DecodeError;
use super::size::{PER_BYTE, check_size};
use crate::image::Image;

const FLOAT_MAP: &str = "PFM";
const PIXMAP: &str = "PPM";

/// The width and height of a float map.
pub(crate) fn size_of_float_map(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    Header::after_magic(bytes).size(FLOAT_MAP)
}

/// The width and height of a pixmap.
pub(crate) fn size_of_pixmap(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    Header::after_magic(bytes).size(PIXMAP)
}

/// A float map of three channels, of either byte order; rows come from the bottom up.
pub(super) fn float_map(bytes: &[u8]) -> Result<Image, DecodeError> {
    let broken = |problem: &str| broken(FLOAT_MAP, problem);
    let mut header = Header::new(bytes);
    if header.token() != Some("PF") {
        return Err(broken("it has no three channels (PF)"));
    }
    let (width, height) = header.size(FLOAT_MAP)?;
    let scale: f32 = header.number().ok_or_else(|| broken("no scale"))?;
    if scale == 0.0 || !scale.is_finite() {
        return Err(broken("the scale must be a number other than 0"));
    }
    let data = header.data();
    let row = 12 * width as usize;
    if data.len() != row * height as usize {
        return Err(broken(&wrong_length(row * height as usize, data.len())));
    }
    let value = |four: [u8; 4]| {
        let value = if scale < 0.0 {
            f32::from_le_bytes(four)
        } else {
            f32::from_be_bytes(four)
        };
        value * scale.abs()
    };
    let mut pixels = Vec::with_capacity(data.len() / 12);
    for row in data.chunks_exact(row).rev() {
        let values: Vec<f32> = row.as_chunks::<4>().0.iter().map(|&v| value(v)).collect();
        pixels.extend_from_slice(values.as_chunks::<3>().0);
    }
    Ok(Image {
        width,
        height,
        pixels,
    })
}

/// A pixmap, of text (P3) or of bytes (P6, two bytes a sample above 255 levels), with the radiance
/// of levels between 0 and 1.
pub(super) fn pixmap(bytes: &[u8], radiance: impl Fn(f64) -> f32) -> Result<Image, DecodeError> {
    let broken = |problem: &str| broken(PIXMAP, problem);
    let mut header = Header::new(bytes);
    let plain = header.token() == Some("P3");
    let (width, height) = header.size(PIXMAP)?;
    let brightest: u16 = header
        .number()
        .ok_or_else(|| broken("no brightest level"))?;
    if brightest == 0 {
        return Err(broken("the brightest level must not be 0"));
    }
    let count = 3 * width as usize * height as usize;
    let samples: Vec<u16> = if plain {
        std::iter::from_fn(|| header.number()).take(count).collect()
    } else if brightest < 256 {
        header.data().iter().map(|&byte| byte.into()).collect()
    } else {
        let words = header.data().as_chunks::<2>().0.iter();
        words.map(|&word| u16::from_be_bytes(word)).collect()
    };
    if samples.len() != count {
        return Err(broken(&wrong_length(count, samples.len())));
    }
    if samples.iter().any(|&sample| sample > brightest) {
        return Err(broken("a sample is brighter than the brightest level"));
    }
    let of_sample = |sample: u16| radiance(f64::from(sample) / f64::from(brightest));
    let triples = samples.as_chunks::<3>().0.iter();
    Ok(Image {
        width,
        height,
        pixels: triples.map(|triple| triple.map(of_sample)).collect(),
    })
}

fn broken(format: &'static str, problem: &str) -> DecodeError {
    DecodeError::Broken {
        format,
        problem: problem.to_owned(),
    }
}

fn wrong_length(expected: usize, found: usize) -> String {
    format!("{expected} samples or bytes should follow the header, not {found}")
}

/// Words apart by white space; `#` begins a comment that ends with the line.
struct Header<'a> {
    bytes: &'a [u8],
    rest: &'a [u8],
}

impl<'a> Header<'a> {
    fn new(bytes: &'a [u8]) -> Header<'a> {
        Header { bytes, rest: bytes }
    }

    /// Behind the word that tells the format.
    fn after_magic(bytes: &'a [u8]) -> Header<'a> {
        let mut header = Header::new(bytes);
        header.token();
        header
    }

    fn token(&mut self) -> Option<&'a str> {
        loop {
            let start = self.rest.iter().position(|b| !b.is_ascii_whitespace())?;
            self.rest = &self.rest[start..];
            if self.rest[0] != b'#' {
                break;
            }
            let line = self.rest.iter().position(|&b| b == b'\n')?;
            self.rest = &self.rest[line..];
        }
        let end = self.rest.iter().position(u8::is_ascii_whitespace);
        let (token, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = rest;
        str::from_utf8(token).ok()
    }

    fn number<T: std::str::FromStr>(&mut self) -> Option<T> {
        self.token()?.parse().ok()
    }

    fn size(&mut self, format: &'static str) -> Result<(u32, u32), DecodeError> {
        let size = self.number().zip(self.number());
        let (width, height): (u32, u32) =
            size.ok_or_else(|| broken(format, "it has no width and height"))?;
        check_size((width.into(), height.into()), self.bytes, PER_BYTE)?;
        Ok((width, height))
    }

    /// What follows the single white space after the header.
    fn data(&self) -> &'a [u8] {
        self.rest.get(1..).unwrap_or_default()
    }
}
