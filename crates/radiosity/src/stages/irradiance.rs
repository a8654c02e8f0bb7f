//! What arrives at patches.

use super::factors::Factors;
use super::light::PatchLight;
use crate::error::Error;
use radiosity_form_factors::FormFactors;
use radiosity_matrix::Exchange;

/// The mean of what arrives at patches, W/m^2: with the mean radiosity `B`, emission `E` and
/// reflectance `rho`, it is the `H` of `B = E + rho H`. It makes the form factors, if nobody holds
/// them.
pub fn mean_irradiance(factors: &Factors<'_>, light: &PatchLight) -> Result<Vec<[f32; 3]>, Error> {
    let mut means = irradiance(&factors.made()?.form_factors, &light.radiosity);
    for (mean, share) in means.iter_mut().zip(&light.elements) {
        mean.iter_mut().for_each(|channel| *channel *= share);
    }
    Ok(means)
}

/// `H_i = sum_j F_ij B_j`, the mean of what arrives at elements.
pub(super) fn irradiance(factors: &FormFactors, exitance: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let arrives = factors.exchange.product(exitance, 1).into_iter();
    arrives
        .map(|rgb| rgb.map(|channel| channel as f32))
        .collect()
}
