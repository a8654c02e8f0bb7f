//! What arrives at patches.

use super::factors::Factors;
use super::light::{PatchLight, exchanging};
use crate::error::Error;
use radiosity_form_factors::FormFactors;

/// The mean of what arrives at patches, hidden parts included, W/m^2: with the mean radiosity `B`,
/// emission `E` and reflectance `rho`, it is the `H` of `B = E + rho H`. It makes the form factors,
/// if nobody holds them.
pub fn mean_irradiance(factors: &Factors<'_>, light: &PatchLight) -> Result<Vec<[f32; 3]>, Error> {
    let of_elements = light.radiosity_of_elements(factors.params.mode);
    let whole = vec![1.0; of_elements.len()];
    Ok(irradiance(
        &factors.made()?.form_factors,
        &of_elements,
        &whole,
    ))
}

/// `H_i = sum_j F_ij B_j`, on what is visible of patches.
pub(super) fn irradiance(
    factors: &FormFactors,
    exitance: &[[f32; 3]],
    visible: &[f32],
) -> Vec<[f32; 3]> {
    let total = factors.total_area;
    let area = |(area, &share): (&f64, &f32)| area * f64::from(exchanging(share));
    let areas: Vec<f64> = factors.areas.iter().zip(visible).map(area).collect();
    let mut result = vec![[0.0; 3]; exitance.len()];
    for c in 0..3 {
        let channel: Vec<f64> = exitance.iter().map(|of| f64::from(of[c])).collect();
        let sums = factors.exchange.product(&channel);
        for ((result, sum), area) in result.iter_mut().zip(sums).zip(&areas) {
            // A covered patch has no area.
            result[c] = if *area > 0.0 {
                (sum * total / area) as f32
            } else {
                0.0
            };
        }
    }
    result
}
