//! The integrand of the form factor, and the regular rule over it.

use crate::points::Sample;
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

/// `S_ij` by all pairs of the given points. Visibility is asked only where the kernel is not
/// zero.
pub(crate) fn all_pairs(
    of_i: (&[Sample], DVec3),
    of_j: (&[Sample], DVec3),
    mut visible: impl FnMut(DVec3, DVec3) -> bool,
) -> f64 {
    let ((samples_i, normal_i), (samples_j, normal_j)) = (of_i, of_j);
    let mut sum = 0.0;
    for p in samples_i {
        let mut from_p = 0.0;
        for q in samples_j {
            let k = kernel(p.point, normal_i, q.point, normal_j);
            if k > 0.0 && visible(p.point, q.point) {
                from_p += q.area * k;
            }
        }
        sum += p.area * from_p;
    }
    sum
}
