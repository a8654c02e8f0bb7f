//! The radiosities.

use crate::{Convergence, Rgb};

/// The radiosities that each light makes, and how they were reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Of each light, the radiosity `B` of each patch: radiant exitance in W/m^2 per channel, of
    /// the light as it is stated, undimmed.
    pub lights: Vec<Vec<[f32; 3]>>,
    /// Of each light, the part of that which each patch reflects of what arrives straight from
    /// emitters, without any reflection before.
    pub direct: Vec<Vec<[f32; 3]>>,
    /// The course of the iteration.
    pub report: Convergence,
}

/// The radiosities of all lights together, each dimmed by a factor per channel: their sum, no
/// matter how the factors change. None without lights.
///
/// # Panics
///
/// If there are not as many factors as lights.
pub fn superpose(lights: &[Vec<[f32; 3]>], dimming: &[Rgb]) -> Vec<[f32; 3]> {
    assert_eq!(dimming.len(), lights.len(), "a factor for each light");
    let patches = lights.first().map_or(0, Vec::len);
    let mut sum = vec![[0.0; 3]; patches];
    for (light, factor) in lights.iter().zip(dimming) {
        let factor = factor.map(|channel| channel as f32);
        for (sum, radiosity) in sum.iter_mut().zip(light) {
            for c in 0..3 {
                sum[c] += factor[c] * radiosity[c];
            }
        }
    }
    sum
}
