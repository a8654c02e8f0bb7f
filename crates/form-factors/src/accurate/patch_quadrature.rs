//! What the accurate estimator asks of a patch.

use crate::accurate::gauss;
use crate::sampling::points::Sample;
use arrayvec::ArrayVec;
use radiosity_geometry::{DVec3, Mesh, Patch, Polygon};
use std::iter::once;

/// Up to four corners, and one more where a plane cuts one off. Quads may be twisted by the
/// rounding of their corners, and then a plane nearly their own crosses all four edges.
pub(crate) type Corners = ArrayVec<DVec3, 8>;

/// The rules of 1, 2 and 3 points along each edge.
pub(crate) const RULES: usize = 3;

/// What of a patch exchanges light, or a convex piece of that, ready to be integrated over.
#[derive(Clone, Debug)]
pub(crate) struct PatchQuadrature {
    pub(crate) polygon: Polygon,
    pub(crate) normal: DVec3,
    pub(crate) centroid: DVec3,
    /// From the centroid to the farthest corner.
    pub(crate) radius: f64,
    /// Gauss's rules; triangles are quads with a repeated corner.
    pub(crate) rules: [Vec<Sample>; RULES],
}

/// The elements of all patches: one of each, or the pieces of what no other face lies on.
pub(crate) struct Quadratures {
    all: Vec<PatchQuadrature>,
    /// Of each patch, how many come before its own; and how many all are.
    ends: Vec<usize>,
}

impl Quadratures {
    pub(crate) fn new(mesh: &Mesh) -> Quadratures {
        let mut elements = Quadratures {
            all: Vec::with_capacity(mesh.patches.len()),
            ends: vec![0],
        };
        for patch in &mesh.patches {
            let pieces = free_pieces(mesh, patch);
            elements.all.extend(pieces.iter().map(PatchQuadrature::new));
            elements.ends.push(elements.all.len());
        }
        elements
    }

    /// Those of a patch; none if other faces cover it.
    pub(crate) fn of(&self, patch: usize) -> &[PatchQuadrature] {
        &self.all[self.ends[patch]..self.ends[patch + 1]]
    }

    /// That of a patch, unless it is in pieces.
    pub(crate) fn single(&self, patch: usize) -> Option<&PatchQuadrature> {
        match self.of(patch) {
            [element] => Some(element),
            _ => None,
        }
    }

    /// The area of a patch that exchanges light.
    pub(crate) fn area(&self, patch: usize) -> f64 {
        self.of(patch).iter().map(PatchQuadrature::area).sum()
    }

    /// The same of all patches.
    pub(crate) fn areas(&self) -> Vec<f64> {
        let patches = 0..self.ends.len() - 1;
        patches.map(|patch| self.area(patch)).collect()
    }
}

/// The patch itself, or what of it no other face lies on, as patches of the same face.
pub(crate) fn free_pieces(mesh: &Mesh, patch: &Patch) -> Vec<Patch> {
    let piece = |polygon: Polygon| Patch {
        polygon,
        centroid: polygon.centroid(),
        area: polygon.area(),
        ..patch.clone()
    };
    match mesh.covers.free_part(&mesh.faces, patch) {
        Some(polygons) => polygons.into_iter().map(piece).collect(),
        None => once(patch.clone()).collect(),
    }
}

impl PatchQuadrature {
    pub(crate) fn new(patch: &Patch) -> PatchQuadrature {
        let distance = |corner: &DVec3| corner.distance(patch.centroid);
        let center = Sample {
            point: patch.centroid,
            area: patch.area,
        };
        PatchQuadrature {
            radius: patch
                .polygon
                .corners()
                .iter()
                .map(distance)
                .fold(0.0, f64::max),
            polygon: patch.polygon,
            normal: patch.normal,
            centroid: patch.centroid,
            rules: [
                vec![center],
                tensor_rule(&patch.polygon, 2),
                tensor_rule(&patch.polygon, 3),
            ],
        }
    }

    /// The corners, counter-clockwise seen from the front.
    pub(crate) fn corners(&self) -> &[DVec3] {
        self.polygon.corners()
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
pub(crate) fn tensor_rule(polygon: &Polygon, points: usize) -> Vec<Sample> {
    let rule = gauss::rule(points);
    let pairs = rule.iter().flat_map(|u| rule.iter().map(move |v| (u, v)));
    let sample = |(&(u, weight_u), &(v, weight_v)): (&(f64, f64), &(f64, f64))| Sample {
        point: polygon.bilinear(u, v),
        area: weight_u * weight_v * polygon.bilinear_jacobian(u, v),
    };
    pairs.map(sample).collect()
}
