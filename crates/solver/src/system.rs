//! The linear system.

use crate::Rgb;
use radiosity_matrix::Exchange;

/// `(I - rho F) B = E` for each light, by its parts. All slices but the lights are indexed by
/// patch.
#[derive(Clone, Copy, Debug)]
pub struct System<'a> {
    /// The form factors `F`, and the areas that exchange light. Radiosities are means over these.
    pub exchange: &'a dyn Exchange,
    /// Diffuse reflectance of each patch, in [0, 1].
    pub reflectance: &'a [Rgb],
    /// Of each light, the radiant exitance that each patch emits itself, W/m^2, >= 0.
    pub lights: &'a [Vec<Rgb>],
}

impl System<'_> {
    pub(crate) fn areas(&self) -> &[f64] {
        self.exchange.areas()
    }

    pub(crate) fn size(&self) -> usize {
        self.exchange.size()
    }

    /// The sum of each row of `F`.
    pub(crate) fn row_sums(&self) -> Vec<f64> {
        let sums = self.exchange.product(&vec![[1.0; 3]; self.size()], 1);
        sums.into_iter().map(|[sum, ..]| sum).collect()
    }
}
