//! Linear images from files' bytes: EXR, HDR, PFM, PPM and PNG.

mod hdr;
mod head;
#[cfg(feature = "openexr")]
mod openexr;
mod png;
mod portable;
mod regions;
mod size;

use crate::image::Image;
use crate::tone::Transfer;
use head::Format;
pub use head::picture_size;
pub use regions::{Regions, RegionsError, decode_regions};
pub use size::SizeError;

/// How the levels of a picture came from radiance:
/// `level = transfer(exposure * L)`, in units of the brightest level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DecodeParams {
    /// Factor from radiance to brightness, > 0.
    pub exposure: f64,
    /// The transfer curve, whatever a PNG says of itself.
    pub transfer: Option<Transfer>,
    /// The transfer curve of pictures that say nothing of theirs.
    pub default_transfer: Transfer,
}

impl Default for DecodeParams {
    /// Brightness is radiance, and pictures that say nothing have a gamma of 2.2.
    fn default() -> DecodeParams {
        DecodeParams {
            exposure: 1.0,
            transfer: None,
            default_transfer: Transfer::Gamma(2.2),
        }
    }
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

impl DecodeParams {
    /// Radiance of a level between 0 and 1; `own` is the curve that the file states.
    fn radiance(&self, level: f64, own: Option<Transfer>) -> f32 {
        let transfer = self.transfer.or(own).unwrap_or(self.default_transfer);
        (transfer.decode(level) / self.exposure) as f32
    }
}

/// Reads a picture whose format its first bytes tell. Levels become radiance as `params` say;
/// OpenEXR, HDR and PFM hold radiance already.
///
/// ```
/// use radiosity_image::{DecodeParams, Transfer, decode_picture};
///
/// let ppm = b"P3 2 1 255\n0 0 0 255 255 255\n";
/// let params = DecodeParams { exposure: 4.0, ..DecodeParams::default() };
/// let decoded = decode_picture(ppm, &params)?;
/// assert_eq!(decoded.image.pixels, [[0.0; 3], [0.25; 3]]);
/// // The brightest level stands for anything brighter, too.
/// assert!(decoded.levels);
///
/// let error = decode_picture(b"GIF89a", &params).unwrap_err();
/// assert!(error.to_string().starts_with("is none of the formats that can be read"));
/// # Ok::<(), radiosity_image::DecodeError>(())
/// ```
pub fn decode_picture(bytes: &[u8], params: &DecodeParams) -> Result<Decoded, DecodeError> {
    let linear = |image| Decoded {
        image,
        levels: false,
    };
    let of_levels = |image| Decoded {
        image,
        levels: true,
    };
    match Format::of(bytes)? {
        Format::Png => png::decode(bytes, params).map(of_levels),
        #[cfg(feature = "openexr")]
        Format::OpenExr => openexr::decode(bytes).map(linear),
        #[cfg(not(feature = "openexr"))]
        Format::OpenExr => Err(DecodeError::LeftOut),
        Format::Hdr => hdr::decode(bytes).map(linear),
        Format::FloatMap => portable::float_map(bytes).map(linear),
        Format::Pixmap => {
            portable::pixmap(bytes, |level| params.radiance(level, None)).map(of_levels)
        }
    }
}
