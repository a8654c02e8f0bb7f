//! The spectral radius of `rho F`: the factor by which light grows per bounce in the long run.

use crate::{Rgb, System};

/// Growth per step that changes by less than this has settled.
const SETTLED: f64 = 1e-9;
const MAX_ITERATIONS: usize = 2000;

/// The spectral radius over all channels, by power iteration from equal radiosities.
///
/// `rho F` is non-negative, so its spectral radius is an eigenvalue (Perron-Frobenius). There
/// may be others of the same size, as in a pair of plates that light goes to and fro between,
/// and then the plain iteration never settles. `(I + rho F) / 2` has the same eigenvectors and
/// only one eigenvalue of that size, `(1 + radius) / 2`.
pub(crate) fn spectral_radius(system: &System<'_>) -> f64 {
    let mut x = vec![[1.0; 3]; system.size()];
    let mut growth: Rgb = [0.0; 3];
    for _ in 0..MAX_ITERATIONS {
        let before = channel_norms(system, &x);
        let irradiance = system.irradiance(&x);
        for ((x, h), rho) in x.iter_mut().zip(&irradiance).zip(system.reflectance) {
            *x = std::array::from_fn(|c| 0.5 * (x[c] + rho[c] * h[c]));
        }
        let after = channel_norms(system, &x);
        for x in &mut x {
            *x = std::array::from_fn(|c| x[c] / after[c]);
        }
        let previous = growth;
        growth = std::array::from_fn(|c| after[c] / before[c]);
        if (0..3).all(|c| (growth[c] - previous[c]).abs() < SETTLED * growth[c]) {
            break;
        }
    }
    let radius = |growth: f64| 2.0 * growth - 1.0;
    growth.map(radius).into_iter().fold(0.0, f64::max)
}

fn channel_norms(system: &System<'_>, x: &[Rgb]) -> Rgb {
    std::array::from_fn(|c| system.norm(x.iter().map(|x| [x[c], 0.0, 0.0])))
}
