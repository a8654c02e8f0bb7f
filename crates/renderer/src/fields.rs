//! What is known of the light, patch by patch.

use crate::Rgb;

/// The light on patches, and what of it is shown; all slices are indexed by patch.
///
/// Radiosity is shown where `shown` is the radiosity `B` and either gain is the reflectance. Other
/// quantities are made in the same way: irradiance has gains of 1, and no emission.
#[derive(Clone, Copy, Debug)]
pub struct Fields<'a> {
    /// Radiant exitance that patches emit, W/m^2: where direct light comes from.
    pub sources: &'a [Rgb],
    /// Diffuse reflectance, in [0, 1].
    pub reflectance: &'a [Rgb],
    /// What patches reflect of light that was reflected before, W/m^2.
    pub indirect: &'a [Rgb],
    /// The share of the patch that can be seen, in [0, 1]; of 0, neighbours take nothing over.
    pub visible: &'a [f32],
    /// All that is shown, on what can be seen of patches.
    pub shown: &'a [Rgb],
    /// The part of it that comes from nowhere, as emission does.
    pub emission: &'a [Rgb],
    /// The part of it that comes straight from emitters.
    pub direct: &'a [Rgb],
    /// How much is shown of the irradiance straight from emitters.
    pub direct_gain: &'a [Rgb],
    /// And of the irradiance from elsewhere, where it is gathered.
    pub gathered_gain: &'a [Rgb],
}
