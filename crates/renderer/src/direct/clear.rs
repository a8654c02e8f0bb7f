//! Emitters that are seen whole, from eight points at a time.

use super::{Emitter, Receivers};
use radiosity_geometry::DVec3;
use radiosity_simd::{Float, Simd, angle};
use std::f64::consts::TAU;

/// The form factors of points to an emitter that all of them see whole; see
/// [`form_factor`](super::pieces::form_factor).
#[inline(always)]
pub(super) fn clear_factors<S: Simd>(
    simd: S,
    emitter: &Emitter,
    points: &Receivers<S::F64>,
) -> S::F64 {
    let corners = emitter.polygon.corners();
    let mut sum = simd.splat_f64(0.0);
    let mut from = towards(simd, corners[corners.len() - 1], points);
    for &corner in corners {
        let to = towards(simd, corner, points);
        let cross = [
            from[1] * to[2] - from[2] * to[1],
            from[2] * to[0] - from[0] * to[2],
            from[0] * to[1] - from[1] * to[0],
        ];
        let length = dot(&cross, &cross).sqrt();
        sum = sum + angle(simd, length, dot(&from, &to)) / length * dot(&cross, &points.normals);
        from = to;
    }
    sum * simd.splat_f64(-1.0 / TAU)
}

/// The directions from points to a corner.
#[inline(always)]
fn towards<S: Simd>(simd: S, corner: DVec3, points: &Receivers<S::F64>) -> [S::F64; 3] {
    let [x, y, z] = &points.at;
    [
        simd.splat_f64(corner.x) - *x,
        simd.splat_f64(corner.y) - *y,
        simd.splat_f64(corner.z) - *z,
    ]
}

#[inline(always)]
fn dot<F: Float<f64>>(a: &[F; 3], b: &[F; 3]) -> F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
