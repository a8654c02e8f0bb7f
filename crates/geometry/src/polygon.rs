//! Convex planar polygons of three or four corners: the one shape that rays meet.

use crate::bounds::Aabb;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A convex planar polygon of three or four corners, counter-clockwise seen from its front.
///
/// A triangle stores its last corner twice. The repeated edge has length zero and its edge
/// function is exactly zero, so areas, normals and ray tests need no second case.
///
/// ```
/// use radiosity_geometry::{DVec3, Polygon};
///
/// let triangle = Polygon::triangle([DVec3::ZERO, 3.0 * DVec3::X, 2.0 * DVec3::Y]);
/// assert_eq!(triangle.corners().len(), 3);
/// assert_eq!(triangle.area(), 3.0);
/// assert_eq!(triangle.normal(), DVec3::Z);
/// assert!(triangle.centroid().abs_diff_eq(DVec3::new(1.0, 2.0 / 3.0, 0.0), 1e-15));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Polygon {
    corners: [DVec3; 4],
    triangle: bool,
}

impl Polygon {
    /// A triangle.
    pub fn triangle([a, b, c]: [DVec3; 3]) -> Polygon {
        Polygon {
            corners: [a, b, c, c],
            triangle: true,
        }
    }

    /// A convex planar quadrilateral.
    pub fn quad(corners: [DVec3; 4]) -> Polygon {
        Polygon {
            corners,
            triangle: false,
        }
    }

    /// The polygon with each corner moved.
    pub(crate) fn map(&self, moved: impl Fn(DVec3) -> DVec3) -> Polygon {
        Polygon {
            corners: self.corners.map(moved),
            triangle: self.triangle,
        }
    }

    /// The three or four corners.
    pub fn corners(&self) -> &[DVec3] {
        &self.corners[..if self.triangle { 3 } else { 4 }]
    }

    /// Four corners, the last of a triangle twice.
    pub fn padded_corners(&self) -> &[DVec3; 4] {
        &self.corners
    }

    /// Whether it has three corners.
    pub fn is_triangle(&self) -> bool {
        self.triangle
    }

    /// Whether it is a parallelogram, to the rounding of its coordinates.
    pub fn is_parallelogram(&self) -> bool {
        let [a, b, c, d] = self.corners;
        let largest = self.corners.map(|corner| corner.abs().max_element());
        let rounding = 8.0 * f64::EPSILON * largest.into_iter().fold(0.0, f64::max);
        !self.triangle && (a - b + c - d).abs().max_element() <= rounding
    }

    /// Area times unit normal: half the cross product of the diagonals.
    pub fn area_vector(&self) -> DVec3 {
        let [a, b, c, d] = self.corners;
        0.5 * (c - a).cross(d - b)
    }

    /// The area, in square scene units.
    pub fn area(&self) -> f64 {
        self.area_vector().length()
    }

    /// The unit normal of the front; NaN for a polygon without area.
    pub fn normal(&self) -> DVec3 {
        self.area_vector().normalize()
    }

    /// The centre of mass.
    pub fn centroid(&self) -> DVec3 {
        let [a, b, c, d] = self.corners;
        let weight_abc = (b - a).cross(c - a).length();
        let weight_acd = (c - a).cross(d - a).length();
        let third = 1.0 / (3.0 * (weight_abc + weight_acd));
        (weight_abc * third) * (a + b + c) + (weight_acd * third) * (a + c + d)
    }

    /// The bounding box.
    pub fn bounds(&self) -> Aabb {
        Aabb::around(self.corners)
    }

    /// The length of the longest edge.
    pub fn longest_edge(&self) -> f64 {
        let [a, b, c, d] = self.corners;
        let squared = [b - a, c - b, d - c, a - d].map(DVec3::length_squared);
        squared.into_iter().fold(0.0, f64::max).sqrt()
    }

    /// The bilinear image of `(u, v)` in the unit square: corners 0, 1, 2, 3 are the images of
    /// (0, 0), (1, 0), (1, 1), (0, 1).
    pub fn bilinear(&self, u: f64, v: f64) -> DVec3 {
        let [a, b, c, d] = self.corners;
        (1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * d + u * c)
    }

    /// Area per unit of `du dv` of [`Polygon::bilinear`] at `(u, v)`; constant for a
    /// parallelogram.
    pub fn bilinear_jacobian(&self, u: f64, v: f64) -> f64 {
        let [a, b, c, d] = self.corners;
        let along_u = (1.0 - v) * (b - a) + v * (c - d);
        let along_v = (1.0 - u) * (d - a) + u * (c - b);
        along_u.cross(along_v).length()
    }

    /// The barycentric image `corner 0 + s (corner 1 - corner 0) + t (corner 2 - corner 0)`.
    pub fn barycentric(&self, s: f64, t: f64) -> DVec3 {
        let [a, b, c, _] = self.corners;
        (1.0 - s - t) * a + s * b + t * c
    }
}
