//! Convex parts of the scene: patches, and groups of them that are judged together.

use crate::culling::blocker::Plane;
use arrayvec::ArrayVec;
use radiosity_geometry::{Aabb, DVec3, Face, FaceId};
use radiosity_simd::{LANES, Simd};

/// The convex hull of up to eight points, and the plane it lies in, if it does.
#[derive(Clone, Debug)]
pub(crate) struct ConvexBound {
    corners: ArrayVec<DVec3, LANES>,
    /// The corners by axis, over and over.
    lanes: [[f64; LANES]; 3],
    pub(crate) face: Option<(FaceId, Plane)>,
}

impl ConvexBound {
    /// A polygon on a face.
    pub(crate) fn on_face(id: FaceId, face: &Face, corners: &[DVec3; 4]) -> ConvexBound {
        let plane = Plane::through(face.polygon.corners()[0], face.normal);
        ConvexBound::new(corners, Some((id, plane)))
    }

    /// The smallest parallelogram, along two edges of a face, around points on it.
    pub(crate) fn around_on_face(
        id: FaceId,
        face: &Face,
        points: impl Iterator<Item = DVec3>,
    ) -> ConvexBound {
        let [origin, b, c, d] = *face.polygon.padded_corners();
        let (u, v) = (b - origin, d - origin);
        assert!(!face.polygon.is_triangle() || c == d);
        // Across `u`, so that slivers keep their digits.
        let slant = u.dot(v) / u.length_squared();
        let across = v - slant * u;
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            let t = (point - origin).dot(across) / across.length_squared();
            let s = (point - origin).dot(u) / u.length_squared() - t * slant;
            let parameters = [s, t];
            for k in 0..2 {
                low[k] = low[k].min(parameters[k]);
                high[k] = high[k].max(parameters[k]);
            }
        }
        let at = |s: f64, t: f64| origin + s * u + t * v;
        let [[u0, v0], [u1, v1]] = [low, high];
        let corners = [at(u0, v0), at(u1, v0), at(u1, v1), at(u0, v1)];
        ConvexBound::on_face(id, face, &corners)
    }

    /// The box around points.
    pub(crate) fn around(points: impl Iterator<Item = DVec3>) -> ConvexBound {
        let bounds = Aabb::around(points);
        let ends = [bounds.min, bounds.max];
        let corner = |k: usize| DVec3::new(ends[k & 1].x, ends[k >> 1 & 1].y, ends[k >> 2].z);
        let corners: [DVec3; LANES] = std::array::from_fn(corner);
        ConvexBound::new(&corners, None)
    }

    fn new(corners: &[DVec3], face: Option<(FaceId, Plane)>) -> ConvexBound {
        let lane = |axis: usize, k: usize| corners[k % corners.len()][axis];
        ConvexBound {
            corners: corners.iter().copied().collect(),
            lanes: std::array::from_fn(|axis| std::array::from_fn(|k| lane(axis, k))),
            face,
        }
    }

    /// How many of the lanes differ.
    pub(crate) fn distinct(&self) -> usize {
        self.corners.len()
    }

    /// Its corners, if it lies on a face.
    pub(crate) fn polygon(&self) -> Option<&[DVec3; 4]> {
        self.corners.as_slice().try_into().ok()
    }

    pub(crate) fn bounds(&self) -> Aabb {
        Aabb::around(self.corners.iter().copied())
    }

    /// Whether it lies on a face.
    pub(crate) fn is_on(&self, face: FaceId) -> bool {
        self.face.is_some_and(|(own, _)| own == face)
    }

    /// The heights of the corners over a plane.
    #[inline(always)]
    pub(crate) fn heights<S: Simd>(&self, simd: S, plane: &Plane) -> S::F64 {
        let [x, y, z] = &self.lanes;
        plane.heights(simd, [simd.f64(x), simd.f64(y), simd.f64(z)])
    }

    /// Whether a point of each may lie in front of the other, by more than `tolerance`.
    pub(crate) fn may_face(&self, other: &ConvexBound, tolerance: f64) -> bool {
        let reaches_over = |part: &ConvexBound, of: &ConvexBound| {
            let corners = part.corners.iter();
            of.face.is_none_or(|(_, plane)| {
                corners
                    .map(|&c| plane.height(c))
                    .any(|height| height > tolerance)
            })
        };
        reaches_over(other, self) && reaches_over(self, other)
    }
}
