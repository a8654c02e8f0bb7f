//! The unoccluded exchange of two polygons as an integral along their contours.
//!
//! For polygons wholly in front of each other, Stokes' theorem gives (Sparrow, "A New and Simpler
//! Formulation for Radiative Angle Factors", 1963; Cohen & Wallace, eq. 4.17)
//!
//! ```text
//! S = 1 / (2 pi)  sum over edges a of i, b of j:  (t_a . t_b)  int_a int_b  ln r  ds dt
//! ```
//!
//! with unit tangents `t`. It holds for polygons that touch, where the area integral is singular.
//! Parallel edges, and with them all rectangles in a room of rectangles, are integrated in closed
//! form; others in closed form along one edge and by Gauss's rule along the other.

use crate::accurate::gauss;
use libm::{atan, log};
use radiosity_geometry::DVec3;
use std::f64::consts::TAU;

/// Edges of this cosine or less contribute nothing.
const PERPENDICULAR: f64 = 1e-15;
/// How often an edge is halved where it meets another. The integrand's derivative grows as a
/// logarithm there, so the last part's error is some 1e-5 of its length squared.
const MOST_HALVINGS: u32 = 12;

/// An edge of a contour.
#[derive(Clone, Copy)]
struct Edge {
    start: DVec3,
    tangent: DVec3,
    length: f64,
}

/// An integral, and what rounding may have done to it.
#[derive(Clone, Copy, Default)]
pub(crate) struct Integral {
    pub(crate) value: f64,
    pub(crate) rounding: f64,
}

impl Integral {
    pub(crate) fn add(&mut self, other: Integral) {
        self.value += other.value;
        self.rounding += other.rounding;
    }
}

/// Rounding of sums of products and logarithms, relative to the sum of their sizes.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// `S = A_i F_ij` of two polygons, each wholly in front of the other: the corners of each,
/// counter-clockwise seen from its front. Edges that part by no more than `tolerance`, to which
/// coordinates are rounded, are parallel.
///
/// The terms are as large as the square of the larger polygon, or of the distance, and cancel to
/// what is as small as the smaller one: `rounding` is what that costs.
pub(crate) fn exchange(i: &[DVec3], j: &[DVec3], tolerance: f64) -> Integral {
    // Any constant may be taken from the logarithm, as contours are closed: one that makes it
    // small keeps the rounding small.
    let unit = 1.0 / i[0].distance_squared(j[0]).max(i[0].distance_squared(i[1]));
    let (mut sum, mut size) = (0.0, 0.0);
    for a in edges(i) {
        for b in edges(j) {
            let cosine = a.tangent.dot(b.tangent);
            if cosine.abs() <= PERPENDICULAR {
                continue;
            }
            let sine = a.tangent.cross(b.tangent).length();
            let (integral, of_terms) = if sine * a.length.min(b.length) <= tolerance {
                parallel(&a, &b, unit)
            } else if a.length < b.length {
                skew(&a, &b, unit)
            } else {
                skew(&b, &a, unit)
            };
            sum += cosine * integral;
            size += cosine.abs() * of_terms;
        }
    }
    Integral {
        value: sum / TAU,
        rounding: ROUNDING * size / TAU,
    }
}

fn edges(corners: &[DVec3]) -> impl Iterator<Item = Edge> {
    let edge = |k: usize| {
        let (start, end) = (corners[k], corners[(k + 1) % corners.len()]);
        let length = start.distance(end);
        Edge {
            start,
            tangent: (end - start) / length,
            length,
        }
    };
    // The repeated corner of a triangle makes an edge without length.
    (0..corners.len())
        .map(edge)
        .filter(|edge| edge.length > 0.0)
}

/// `int int ln(r sqrt(unit))` over two parallel edges, by the second antiderivative of
/// `ln(x^2 + d^2) / 2`; and the sum of the sizes of its terms.
fn parallel(a: &Edge, b: &Edge, unit: f64) -> (f64, f64) {
    let offset = a.start - b.start;
    let squared = offset.cross(b.tangent).length_squared();
    let distance = squared.sqrt();
    let start = offset.dot(b.tangent);
    let end = (a.start + a.length * a.tangent - b.start).dot(b.tangent);
    let (low, high) = (start.min(end), start.max(end));
    let second = |x: f64| {
        let r = x * x + squared;
        if r == 0.0 {
            return 0.0;
        }
        let angle = if distance > 0.0 {
            2.0 * distance * x * atan(x / distance)
        } else {
            0.0
        };
        0.5 * (0.5 * (x * x - squared) * log(r * unit) + angle - 1.5 * x * x)
    };
    let terms = [high, low, high - b.length, low - b.length].map(second);
    (
        terms[0] - terms[1] - terms[2] + terms[3],
        terms.into_iter().map(f64::abs).sum(),
    )
}

/// The same over two edges at an angle: by Gauss's rule along `outer`.
fn skew(outer: &Edge, inner: &Edge, unit: f64) -> (f64, f64) {
    let mut parts = vec![(0.0, outer.length, 0)];
    let (mut sum, mut size) = (0.0, 0.0);
    while let Some((from, to, halvings)) = parts.pop() {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let point = |s: f64| outer.start + s * outer.tangent;
        // In the complex plane of s no singularity is nearer to the middle than the inner edge
        // is to that point, which bounds the error of Gauss's rule (Trefethen, "Is Gauss
        // Quadrature Better than Clenshaw-Curtis?", 2008).
        let clearance = distance(point(middle), inner) / half;
        let points = if clearance >= 8.0 {
            4
        } else if clearance >= 4.0 {
            5
        } else if clearance >= 2.0 || halvings == MOST_HALVINGS {
            8
        } else {
            parts.push((from, middle, halvings + 1));
            parts.push((middle, to, halvings + 1));
            continue;
        };
        for &(x, weight) in gauss::rule(points) {
            let [end, start] = along(point(from + 2.0 * half * x), inner, unit);
            sum += 2.0 * half * weight * (end - start);
            size += 2.0 * half * weight * (end.abs() + start.abs());
        }
    }
    (sum, size)
}

/// The antiderivative of `ln(r sqrt(unit))` from a point, at the end and at the start of an edge.
fn along(point: DVec3, edge: &Edge, unit: f64) -> [f64; 2] {
    let offset = point - edge.start;
    let foot = offset.dot(edge.tangent);
    let squared = offset.cross(edge.tangent).length_squared();
    let distance = squared.sqrt();
    let first = |x: f64| {
        let r = x * x + squared;
        if r == 0.0 {
            return 0.0;
        }
        let angle = if distance > 0.0 {
            2.0 * distance * atan(x / distance)
        } else {
            0.0
        };
        0.5 * (x * log(r * unit) + angle) - x
    };
    [first(edge.length - foot), first(-foot)]
}

/// From a point to the nearest point of an edge.
fn distance(point: DVec3, edge: &Edge) -> f64 {
    let offset = point - edge.start;
    let along = offset.dot(edge.tangent).clamp(0.0, edge.length);
    (offset - along * edge.tangent).length()
}

#[cfg(test)]
mod tests;
