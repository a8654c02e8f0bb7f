//! The integrand of the form factor.

use radiosity_geometry::DVec3;
use std::f64::consts::PI;

/// `cos_i cos_j / (pi r^2)` between two points, zero unless both fronts face each other.
///
/// With `d` the vector from `p` to `q`, `cos_i = d . n_i / r` and `cos_j = -d . n_j / r`: no
/// square root is needed.
pub(crate) fn kernel(p: DVec3, normal_p: DVec3, q: DVec3, normal_q: DVec3) -> f64 {
    let d = q - p;
    let (height_of_q, height_of_p) = (d.dot(normal_p), -d.dot(normal_q));
    if height_of_q <= 0.0 || height_of_p <= 0.0 {
        return 0.0;
    }
    let squared = d.length_squared();
    height_of_q * height_of_p / (PI * squared * squared)
}
