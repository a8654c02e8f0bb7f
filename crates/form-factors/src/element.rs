//! What the accurate estimator asks of a patch.

use crate::gauss;
use crate::points::Sample;
use arrayvec::ArrayVec;
use radiosity_geometry::{DVec3, Patch, Polygon};

/// Up to four corners, and one more where a plane cuts one off. Quads may be twisted by the
/// rounding of their corners, and then a plane nearly their own crosses all four edges.
pub(crate) type Corners = ArrayVec<DVec3, 8>;

/// The rules of 1, 2 and 3 points along each edge.
pub(crate) const RULES: usize = 3;

/// A patch, ready to be integrated over.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    pub(crate) corners: Corners,
    pub(crate) normal: DVec3,
    pub(crate) centroid: DVec3,
    /// From the centroid to the farthest corner.
    pub(crate) radius: f64,
    /// Gauss's rules; triangles are quads with a repeated corner.
    pub(crate) rules: [Vec<Sample>; RULES],
}

impl Element {
    pub(crate) fn new(patch: &Patch) -> Element {
        let corners: Corners = patch.polygon.corners().iter().copied().collect();
        let distance = |corner: &DVec3| corner.distance(patch.centroid);
        let center = Sample {
            point: patch.centroid,
            area: patch.area,
        };
        Element {
            radius: corners.iter().map(distance).fold(0.0, f64::max),
            corners,
            normal: patch.normal,
            centroid: patch.centroid,
            rules: [
                vec![center],
                tensor_rule(&patch.polygon, 2),
                tensor_rule(&patch.polygon, 3),
            ],
        }
    }

    /// The area, in square scene units.
    pub(crate) fn area(&self) -> f64 {
        self.rules[0][0].area
    }

    /// The height of a point over the element's plane.
    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.centroid)
    }

    /// The part of a polygon in front of this element, if there is any. What is within
    /// `tolerance` of the plane counts as on it.
    pub(crate) fn clip(&self, corners: &[DVec3], tolerance: f64) -> Option<Corners> {
        let heights: ArrayVec<f64, 4> = corners.iter().map(|&c| self.height(c)).collect();
        if heights.iter().all(|&h| h <= tolerance) {
            return None;
        }
        let mut kept = Corners::new();
        for (k, (&corner, &height)) in corners.iter().zip(&heights).enumerate() {
            let next = (k + 1) % corners.len();
            if height >= -tolerance {
                kept.push(corner);
            }
            let crosses =
                height.max(heights[next]) > tolerance && height.min(heights[next]) < -tolerance;
            if crosses {
                let t = height / (height - heights[next]);
                kept.push(corner + t * (corners[next] - corner));
            }
        }
        Some(kept)
    }
}

/// Gauss's rule in both bilinear parameters.
fn tensor_rule(polygon: &Polygon, points: usize) -> Vec<Sample> {
    let rule = gauss::rule(points);
    let pairs = rule.iter().flat_map(|u| rule.iter().map(move |v| (u, v)));
    let sample = |(&(u, weight_u), &(v, weight_v)): (&(f64, f64), &(f64, f64))| Sample {
        point: polygon.bilinear(u, v),
        area: weight_u * weight_v * polygon.bilinear_jacobian(u, v),
    };
    pairs.map(sample).collect()
}
