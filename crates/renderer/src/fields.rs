//! What is known of the light, patch by patch.

use crate::Rgb;

/// What is known of each patch; all slices are indexed by patch.
#[derive(Clone, Copy, Debug)]
pub struct Fields<'a> {
    /// Radiant exitance the patch emits itself, W/m^2.
    pub emission: &'a [Rgb],
    /// Diffuse reflectance, in [0, 1].
    pub reflectance: &'a [Rgb],
    /// Radiosity, W/m^2.
    pub radiosity: &'a [Rgb],
    /// The part of it that is light straight from emitters, reflected once.
    pub direct: &'a [Rgb],
    /// The share of the patch that can be seen, in [0, 1]. The rest, inside of something or
    /// covered, is taken to be dark.
    pub visible: &'a [f32],
}
