//! Form factors that are known in closed form.

use std::f64::consts::PI;

/// The form factor from a point to a rectangle parallel to its surface, with a corner right above
/// it (Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-3).
pub(crate) fn corner_factor(a: f64, b: f64, distance: f64) -> f64 {
    let (x, y) = (a / distance, b / distance);
    let (p, q) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    (x / p * (y / p).atan() + y / q * (x / q).atan()) / (2.0 * PI)
}
