//! Turns a [`Mesh`](radiosity_geometry::Mesh) with one colour per patch and a camera into
//! pictures: patch-constant, smooth, or with exact direct light, from one pass over the pixels.
//!
//! A diffuse surface of radiosity `B` shows the radiance `L = B / pi` in every direction, on its
//! front; its back is black, and so is the background. [`Image`] holds linear radiance,
//! [`Picture`] what a screen shows.
//!
//! This crate knows nothing of matrices, or of how the radiosities came about.

mod bicubic;
mod direct;
mod encode;
mod exposed;
mod false_color;
mod fields;
mod gather;
mod hanging;
mod image;
mod interpolate;
mod lettering;
mod lines;
mod params;
mod picture;
mod render;
mod resample;
mod samples;
mod shade;
mod sheet;
mod spots;
mod tone;
mod vertex;
mod view;

#[cfg(feature = "openexr")]
pub use encode::encode_exr;
pub use encode::{Metadata, PictureFormat, encode, encode_deep_png, encode_hdr, encode_pfm};
pub use false_color::{ColorScale, with_legend};
pub use fields::Fields;
pub use image::{Image, Values};
pub use lines::Outlines;
pub use params::ImageParams;
pub use picture::{DeepPicture, Picture};
pub use render::{Renderer, Shading, ShadingParams};
pub use sheet::{contact_sheet, thumbnail_width};
pub use tone::{Curve, Exposure, LUMINANCE, ToneMap, Transfer};

/// Red, green, blue.
pub type Rgb = [f32; 3];

/// `weight * color`, added to a sum.
pub(crate) fn add_scaled(sum: &mut Rgb, weight: f32, color: Rgb) {
    for (sum, channel) in sum.iter_mut().zip(color) {
        *sum += weight * channel;
    }
}
