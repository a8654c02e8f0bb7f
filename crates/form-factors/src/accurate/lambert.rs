//! The exchange of a small patch with a large polygon, whose edges are far from it.
//!
//! What a point sees of a polygon has a closed form (Lambert, "Photometria", 1760; Cohen & Wallace,
//! eq. 4.10): with unit vectors `u_k` from the point to the corners and its normal `n`
//!
//! ```text
//! F = 1 / (2 pi)  sum over edges k:  angle(u_k, u_k+1)  n . (u_k x u_k+1) / |u_k x u_k+1|
//! ```
//!
//! Its terms are angles, so rounding is that of numbers near 1, however large the polygon is. As a
//! function of the point it has singularities at the polygon's edges alone, and none at its inside,
//! however near that is: away from the edges few points of Gauss's rule do.

use crate::accurate::contour::Integral;
use crate::accurate::patch_quadrature::tensor_rule;
use libm::atan2;
use radiosity_geometry::{DVec3, fan};
use std::f64::consts::TAU;

/// Along each edge of the small patch.
const POINTS: usize = 3;
/// The distance of the edges, in radii of the small patch.
const FAR: f64 = 10.0;
/// What the rule leaves beyond that, relative to the exchange: `FAR^-6`, as many orders as it is
/// exact to, and as it is for patches far apart ([`crate::accurate::far_field`]) a fiftieth of it.
const ERROR: f64 = 2e-8;

/// `S` of a small convex polygon with a large one, each wholly in front of the other; `None` if the
/// edges of the large one are too near.
pub(crate) fn exchange(small: &[DVec3], normal: DVec3, large: &[DVec3]) -> Option<Integral> {
    let center = small.iter().sum::<DVec3>() / small.len() as f64;
    let radius = small.iter().map(|corner| corner.distance(center));
    let radius = radius.fold(0.0, f64::max);
    let is_far = |k: usize| distance(center, edge(large, k)) >= FAR * radius;
    if !(0..large.len()).all(is_far) {
        return None;
    }
    let pieces = fan(small);
    let samples = pieces.iter().flat_map(|piece| tensor_rule(piece, POINTS));
    let value: f64 = samples.map(|s| s.area * seen(s.point, normal, large)).sum();
    let rounding = ERROR * value;
    Some(Integral { value, rounding })
}

/// What a point sees of a polygon in front of it: its form factor.
fn seen(point: DVec3, normal: DVec3, corners: &[DVec3]) -> f64 {
    let of_edge = |k: usize| {
        let [from, to] = edge(corners, k).map(|corner| (corner - point).normalize());
        let across = to.cross(from);
        let sine = across.length();
        // An edge that points to the point is seen as a point.
        if sine == 0.0 {
            0.0
        } else {
            atan2(sine, from.dot(to)) * normal.dot(across) / sine
        }
    };
    (0..corners.len()).map(of_edge).sum::<f64>() / TAU
}

fn edge(corners: &[DVec3], k: usize) -> [DVec3; 2] {
    [corners[k], corners[(k + 1) % corners.len()]]
}

/// From a point to the nearest point of an edge.
fn distance(point: DVec3, [start, end]: [DVec3; 2]) -> f64 {
    let (along, offset) = (end - start, point - start);
    let place = (offset.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (offset - place * along).length()
}
