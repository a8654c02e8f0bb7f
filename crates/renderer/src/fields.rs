//! What is known of the light, patch by patch.

use crate::Rgb;

/// What is shown of each patch; all slices are indexed by patch. It is the radiosity, or another
/// quantity that is made in the same way: irradiance, for one, is shown by a reflectance of 1 and an
/// emission of 0.
#[derive(Clone, Copy, Debug)]
pub struct Fields<'a> {
    /// Radiant exitance that patches send to others, W/m^2: where direct light comes from.
    pub sources: &'a [Rgb],
    /// What patches send to others beside, W/m^2: where indirect light comes from.
    pub reflected: &'a [Rgb],
    /// What is shown of the patch's own exitance.
    pub emission: &'a [Rgb],
    /// Diffuse reflectance, in [0, 1]: how much is shown of what arrives.
    pub reflectance: &'a [Rgb],
    /// Radiosity of what can be seen of patches, W/m^2: all that is shown.
    pub radiosity: &'a [Rgb],
    /// The part of it that is light straight from emitters, reflected once.
    pub direct: &'a [Rgb],
    /// The share of the patch that can be seen, in [0, 1]; of 0, neighbours take nothing over.
    pub visible: &'a [f32],
}
