//! Rays, with the per-ray constants of the watertight tests.

use crate::bounds::Aabb;
use glam::DVec3;

/// `origin + t direction`; `t` is measured in units of the direction's length.
///
/// Carries the shear of Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection"
/// (JCGT 2013): it maps the ray onto the axis of its largest component, so that every polygon
/// is tested in one common plane and two polygons that share an edge agree about it.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where the ray starts.
    pub origin: DVec3,
    /// Where it goes; any non-zero length.
    pub direction: DVec3,
    /// The axis of the largest component last.
    pub(crate) axes: [usize; 3],
    pub(crate) shear: [f64; 2],
}

/// Widens the exit of a slab so that rounding never makes a ray miss a box it touches: three
/// roundings of half an ulp each on either side (Ize, "Robust BVH Ray Traversal", JCGT 2013).
const SLAB_EXIT: f64 = 1.0 + 4.0 * f64::EPSILON;

impl Ray {
    /// A ray from `origin` towards `origin + direction`.
    pub fn new(origin: DVec3, direction: DVec3) -> Ray {
        let z = largest_axis(direction);
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let along = direction[z];
        Ray {
            origin,
            direction,
            axes,
            shear: [direction[axes[0]] / along, direction[axes[1]] / along],
        }
    }

    /// The point at parameter `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }

    /// Where the ray enters a box, if that happens at a parameter in `from..=to`.
    pub(crate) fn enters(&self, bounds: &Aabb, from: f64, to: f64) -> Option<f64> {
        let inverse = self.direction.map(finite_inverse);
        let a = (bounds.min - self.origin) * inverse;
        let b = (bounds.max - self.origin) * inverse;
        let entry = a.min(b).max_element().max(from);
        let exit = (a.max(b) * SLAB_EXIT).min_element().min(to);
        (entry <= exit).then_some(entry)
    }

    /// Whether the infinite line of the ray passes through a convex polygon, its boundary
    /// included. A line within the polygon's plane does not.
    ///
    /// Every corner is rounded once, the same for all polygons that share it, and a product
    /// of rounded numbers never compares the wrong way round: an edge function has the right
    /// sign or is zero, and zero counts as inside. So lines through shared edges and corners
    /// cannot slip between neighbours. (`mul_add` would break that symmetry.)
    pub(crate) fn pierces(&self, corners: &[DVec3; 4]) -> bool {
        let [a, b, c, d] = corners.map(|corner| self.project(corner));
        let edges = [edge(a, b), edge(b, c), edge(c, d), edge(d, a)];
        let any_positive = edges.iter().any(|&e| e > 0.0);
        let any_negative = edges.iter().any(|&e| e < 0.0);
        any_positive != any_negative
    }

    fn project(&self, corner: DVec3) -> [f64; 2] {
        let v = corner - self.origin;
        let z = v[self.axes[2]];
        [
            v[self.axes[0]] - self.shear[0] * z,
            v[self.axes[1]] - self.shear[1] * z,
        ]
    }
}

fn edge(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn largest_axis(v: DVec3) -> usize {
    let v = v.abs();
    if v.x >= v.y && v.x >= v.z {
        0
    } else if v.y >= v.z {
        1
    } else {
        2
    }
}

/// `1 / x`, kept finite so that a slab test never multiplies zero by infinity.
fn finite_inverse(x: f64) -> f64 {
    const LARGEST: f64 = 1e300;
    if x.abs() < 1.0 / LARGEST {
        LARGEST.copysign(x)
    } else {
        1.0 / x
    }
}
