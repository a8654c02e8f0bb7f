//! The spectral radius of `rho F`: the factor by which light grows per bounce in the long run.

use crate::{Rgb, System};
use radiosity_matrix::Triple;

/// Growth per step that changes by less than this has settled, as far as single precision tells.
const SETTLED: f64 = 1e-8;
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
        let before = norms(system, &x);
        x = averaged(system, &x);
        let after = norms(system, &x);
        for x in &mut x {
            *x = std::array::from_fn(|c| (f64::from(x[c]) / after[c]) as f32);
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

/// `(x + rho F x) / 2`.
fn averaged(system: &System<'_>, x: &[Triple<f32>]) -> Vec<Triple<f32>> {
    let arrives = system.exchange.product(x, 1);
    let at = |i: usize| {
        let rho = &system.reflectance[i];
        std::array::from_fn(|c| (0.5 * (f64::from(x[i][c]) + rho[c] * arrives[i][c])) as f32)
    };
    (0..x.len()).map(at).collect()
}

/// The area-weighted L2 norm of each channel.
fn norms(system: &System<'_>, x: &[Triple<f32>]) -> Rgb {
    let square = |c: usize| {
        let squares = x.iter().zip(system.areas());
        squares
            .map(|(x, area)| area * f64::from(x[c]).powi(2))
            .sum::<f64>()
    };
    std::array::from_fn(|c| square(c).sqrt())
}
