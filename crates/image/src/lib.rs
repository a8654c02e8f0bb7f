//! Turns linear images into what screens show and files hold, and files back into linear images.
//!
//! | from | by | to |
//! |---|---|---|
//! | [`Image`]: linear radiance, W/(m^2 sr) | [`ToneMap`] | [`Rgb8Image`], [`Rgb16Image`]: levels |
//! | [`Image`] | [`Image::weighted`] | [`Values`]: one number per pixel, in its own unit |
//! | [`Values`] | [`ColorScale`], [`with_legend`] | [`Rgb8Image`] in false colours |
//! | levels | [`encode()`], [`encode_png16`] | bytes of PNG, PPM |
//! | [`Image`] | [`encode_pfm`], [`encode_hdr`], `encode_exr` | bytes of PFM, Radiance HDR, OpenEXR |
//! | bytes of any of these | [`decode_picture`] | [`Decoded`]: linear radiance again |
//! | a grey PNG | [`decode_regions`] | [`Regions`]: a number per pixel |
//! | several [`Rgb8Image`]s | [`contact_sheet()`] | one [`Rgb8Image`] |
//!
//! Pixels run row by row from the top left; channels are red, green and blue of linear sRGB.
//! OpenEXR needs the feature `openexr`.
//!
//! This crate knows nothing of scenes, meshes or cameras, and touches no files: it reads and makes
//! bytes.
//!
//! ```
//! use radiosity_image::{
//!     DecodeParams, Image, PictureFormat, ToneMap, Transfer, decode_picture, encode,
//! };
//!
//! let image = Image {
//!     width: 2,
//!     height: 1,
//!     pixels: vec![[0.0, 0.1, 0.2], [0.05, 0.1, 0.15]],
//! };
//! // Radiance 0.25 is as bright as the screen gets.
//! let tone_map = ToneMap::clamped(4.0, Transfer::Srgb);
//! let shown = tone_map.apply(&image);
//! let png = encode(&shown, PictureFormat::Png(Transfer::Srgb), &[]);
//!
//! let params = DecodeParams { exposure: 4.0, ..DecodeParams::default() };
//! let decoded = decode_picture(&png, &params)?;
//! // A level is at most 2.4 / 255 of the brightest wide, and rounds by half of that.
//! let rounding = 0.5 * 2.4 / 255.0 * 0.25;
//! assert!((decoded.image.pixels[1][2] - 0.15).abs() < rounding);
//! # Ok::<(), radiosity_image::DecodeError>(())
//! ```

mod contact_sheet;
mod decode;
mod encode;
mod false_color;
mod image;
mod legend;
mod percentile;
mod rgb8_image;
mod text;
mod tone;

pub use contact_sheet::{contact_sheet, thumbnail_width};
pub use decode::{
    DecodeError, DecodeParams, Decoded, Regions, RegionsError, SizeError, decode_picture,
    decode_regions, picture_size,
};
#[cfg(feature = "openexr")]
pub use encode::encode_exr;
pub use encode::{Metadata, PictureFormat, encode, encode_hdr, encode_pfm, encode_png16};
pub use false_color::ColorScale;
pub use image::{Image, Values};
pub use legend::with_legend;
pub use percentile::percentile;
pub use rgb8_image::{Rgb8Image, Rgb16Image};
pub use tone::{Curve, Exposure, LUMINANCE, ToneMap, Transfer};

/// Red, green, blue.
pub type Rgb = [f32; 3];
