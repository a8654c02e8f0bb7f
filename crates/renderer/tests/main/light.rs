//! The light on patches, and pictures of few samples.

use radiosity_image::Rgb;
use radiosity_renderer::{Fields, ImageParams};

/// [`Fields`] that own their numbers.
#[derive(Clone)]
pub(crate) struct Light {
    pub(crate) sources: Vec<Rgb>,
    pub(crate) reflectance: Vec<Rgb>,
    pub(crate) indirect: Vec<Rgb>,
    pub(crate) visible: Vec<f32>,
    pub(crate) shown: Vec<Rgb>,
    pub(crate) emission: Vec<Rgb>,
    pub(crate) direct: Vec<Rgb>,
    pub(crate) direct_gain: Vec<Rgb>,
    pub(crate) gathered_gain: Vec<Rgb>,
}

impl Light {
    /// None, on black patches that are seen whole.
    pub(crate) fn none(patches: usize) -> Light {
        let zero = vec![[0.0; 3]; patches];
        Light {
            sources: zero.clone(),
            reflectance: zero.clone(),
            indirect: zero.clone(),
            visible: vec![1.0; patches],
            shown: zero.clone(),
            emission: zero.clone(),
            direct: zero.clone(),
            direct_gain: zero.clone(),
            gathered_gain: zero,
        }
    }

    /// Radiosities on patches of equal material.
    pub(crate) fn of_radiosity(radiosity: &[Rgb]) -> Light {
        Light {
            shown: radiosity.to_vec(),
            ..Light::none(radiosity.len())
        }
    }

    pub(crate) fn fields(&self) -> Fields<'_> {
        Fields {
            sources: &self.sources,
            reflectance: &self.reflectance,
            indirect: &self.indirect,
            visible: &self.visible,
            shown: &self.shown,
            emission: &self.emission,
            direct: &self.direct,
            direct_gain: &self.direct_gain,
            gathered_gain: &self.gathered_gain,
        }
    }
}

/// A square picture of so many pixels a side, with one sample in the middle of each.
pub(crate) fn one_sample(pixels: u32) -> ImageParams {
    ImageParams {
        width: pixels,
        height: pixels,
        subpixels: 1,
        samples: 1,
        ..ImageParams::default()
    }
}
