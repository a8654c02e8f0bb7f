//! Turns a [`Mesh`](radiosity_geometry::Mesh) with one colour per patch and a camera into
//! linear images ([`Image`](radiosity_image::Image)): patch-constant, smooth, or with exact direct
//! light, from one pass over the pixels. [`Outlines`] draws the borders of patches over them.
//!
//! A diffuse surface of radiosity `B` shows the radiance `L = B / pi` in every direction, on its
//! front; its back is black, and so is the background.
//!
//! This crate knows nothing of matrices, of how the radiosities came about, or of how images are
//! shown and encoded.

mod bicubic;
mod direct;
mod fields;
mod gather;
mod hanging;
mod hidden_patches;
mod interpolate;
mod irradiance_filter;
mod overlay;
mod params;
mod pixel_filter;
mod pixel_sampler;
mod render;
mod samples;
mod shade;
mod shading_normals;
mod vertex;
mod weld;

pub use fields::Fields;
pub use overlay::Outlines;
pub use params::ImageParams;
pub use render::{Renderer, Rendering, Shading};

use radiosity_image::Rgb;

/// `weight * color`, added to a sum.
pub(crate) fn add_scaled(sum: &mut Rgb, weight: f32, color: Rgb) {
    for (sum, channel) in sum.iter_mut().zip(color) {
        *sum += weight * channel;
    }
}
