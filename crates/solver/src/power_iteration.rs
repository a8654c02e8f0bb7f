//! The spectral radius of `rho F`: the factor by which light grows per bounce in the long run.

use crate::{Rgb, System};

const ITERATIONS: usize = 300;

/// The spectral radius over all channels, by power iteration from equal radiosities.
///
/// `rho F` is non-negative, so its spectral radius is its largest eigenvalue and belongs to a
/// non-negative vector (Perron-Frobenius), which the start is not orthogonal to.
pub(crate) fn spectral_radius(system: &System<'_>) -> f64 {
    let mut x = vec![[1.0; 3]; system.size()];
    let mut growth = [0.0; 3];
    for _ in 0..ITERATIONS {
        let before = channel_norms(system, &x);
        let irradiance = system.irradiance(&x);
        for ((x, h), rho) in x.iter_mut().zip(&irradiance).zip(system.reflectance) {
            *x = std::array::from_fn(|c| rho[c] * h[c]);
        }
        let after = channel_norms(system, &x);
        growth = std::array::from_fn(|c| {
            if before[c] > 0.0 {
                after[c] / before[c]
            } else {
                0.0
            }
        });
        for x in &mut x {
            *x = std::array::from_fn(|c| if after[c] > 0.0 { x[c] / after[c] } else { 0.0 });
        }
    }
    growth.into_iter().fold(0.0, f64::max)
}

fn channel_norms(system: &System<'_>, x: &[Rgb]) -> Rgb {
    std::array::from_fn(|c| system.norm(x.iter().map(|x| [x[c], 0.0, 0.0])))
}
