//! What stands between two parts of the scene: whether it hides all, nothing, or some of one from
//! the other.

use crate::culling::convex_bound::ConvexBound;
use radiosity_geometry::{DVec3, Polygon};
use radiosity_simd::{Float, Simd};

/// A face as the half-spaces that make it: its plane first, then one through each edge, facing
/// inwards. A triangle has its last edge twice.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blocker {
    pub(crate) planes: [Plane; PLANES],
    pub(crate) corners: [DVec3; 4],
}

pub(crate) const PLANES: usize = 5;
pub(crate) const EDGES: usize = PLANES - 1;

#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Plane {
    pub(crate) normal: DVec3,
    pub(crate) offset: f64,
}

/// What a blocker does to a pair of parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Occlusion {
    None,
    Full,
    Partial,
}

/// Where points lie: all on or above a plane, all on or below it.
#[derive(Clone, Copy)]
struct Side {
    above: bool,
    below: bool,
}

impl Plane {
    pub(crate) fn through(point: DVec3, normal: DVec3) -> Plane {
        Plane {
            normal,
            offset: normal.dot(point),
        }
    }

    pub(crate) fn reversed(&self) -> Plane {
        Plane {
            normal: -self.normal,
            offset: -self.offset,
        }
    }

    pub(crate) fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }

    /// [`Plane::height`] of points in lanes.
    #[inline(always)]
    pub(crate) fn heights<S: Simd>(&self, simd: S, [x, y, z]: [S::F64; 3]) -> S::F64 {
        let n = self.normal;
        simd.splat_f64(n.x) * x + simd.splat_f64(n.y) * y + simd.splat_f64(n.z) * z
            - simd.splat_f64(self.offset)
    }
}

impl Blocker {
    pub(crate) fn new(polygon: &Polygon) -> Blocker {
        let (corners, normal) = (polygon.corners(), polygon.normal());
        let edge = |k: usize| {
            let k = k.min(corners.len() - 1);
            let (from, to) = (corners[k], corners[(k + 1) % corners.len()]);
            Plane::through(from, normal.cross(to - from).normalize())
        };
        let plane = Plane::through(corners[0], normal);
        Blocker {
            planes: [plane, edge(0), edge(1), edge(2), edge(3)],
            corners: *polygon.padded_corners(),
        }
    }

    /// What the blocker does to segments between two parts, by the segments between their
    /// corners: all others cross its plane within the hull of where these do. Heights up to
    /// `tolerance` count as zero.
    #[inline(always)]
    pub(crate) fn effect<S: Simd>(
        &self,
        simd: S,
        i: &ConvexBound,
        j: &ConvexBound,
        tolerance: f64,
    ) -> Occlusion {
        let [plane, edges @ ..] = &self.planes;
        if self.is_behind(i, tolerance) || self.is_behind(j, tolerance) {
            return Occlusion::None;
        }
        let tolerance = simd.splat_f64(tolerance);
        let (plane_i, plane_j) = (i.heights(simd, plane), j.heights(simd, plane));
        let (side_i, side_j) = (side(plane_i, tolerance), side(plane_j, tolerance));
        if side_i.above && side_j.above || side_i.below && side_j.below {
            return Occlusion::None;
        }
        let mut edges_i = [plane_i; EDGES];
        let mut edges_j = [plane_j; EDGES];
        for (e, edge) in edges.iter().enumerate() {
            edges_i[e] = i.heights(simd, edge);
            edges_j[e] = j.heights(simd, edge);
            if side(edges_i[e], tolerance).below && side(edges_j[e], tolerance).below {
                return Occlusion::None;
            }
        }
        let opposite = side_i.above && side_j.below || side_i.below && side_j.above;
        if !opposite {
            return Occlusion::Partial;
        }
        let to_plane_i = plane_i.max(-plane_i).lanes();
        let to_plane_j = plane_j.max(-plane_j);
        let mut hides = true;
        for (edge_i, edge_j) in edges_i.into_iter().zip(edges_j) {
            let edge_i = edge_i.lanes();
            let (mut inside, mut outside) = (0, 0);
            for corner in 0..i.distinct() {
                // The height over the edge where the segment crosses the plane, times `across`.
                let to_plane = simd.splat_f64(to_plane_i[corner]);
                let at = simd.splat_f64(edge_i[corner]) * to_plane_j + edge_j * to_plane;
                let margin = tolerance * (to_plane + to_plane_j);
                inside |= margin.less(at);
                outside |= at.less(-margin);
            }
            if inside == 0 {
                return Occlusion::None;
            }
            hides &= outside == 0;
        }
        if hides {
            Occlusion::Full
        } else {
            Occlusion::Partial
        }
    }

    /// Whether nothing of the blocker is in front of the part, if that has a front.
    fn is_behind(&self, part: &ConvexBound, tolerance: f64) -> bool {
        part.face.is_some_and(|(_, plane)| {
            let heights = self.corners.map(|corner| plane.height(corner));
            heights.into_iter().all(|height| height <= tolerance)
        })
    }
}

#[inline(always)]
fn side<F: Float<f64>>(heights: F, tolerance: F) -> Side {
    Side {
        above: heights.less(-tolerance) == 0,
        below: tolerance.less(heights) == 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use radiosity_geometry::{FaceId, Shape};
    use radiosity_simd::{InstructionSet, Kernel};
    use radiosity_test_kit::{self as kit, Facing};

    struct EffectOf<'a>(&'a Blocker, [&'a ConvexBound; 2]);

    impl Kernel for EffectOf<'_> {
        type Output = Occlusion;

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> Occlusion {
            let [i, j] = self.1;
            self.0.effect(simd, i, j, 1e-12)
        }
    }

    fn square(center: DVec3, edge: f64) -> Shape {
        kit::square([center.x, center.y], edge, center.z, Facing::Up)
    }

    fn effect(between: Shape) -> Occlusion {
        let shapes = [
            square(DVec3::ZERO, 1.0),
            between,
            kit::square([0.0; 2], 1.0, 2.0, Facing::Down),
        ];
        let mesh = kit::mesh_of(shapes);
        let blocker = Blocker::new(&mesh.faces[1].polygon);
        let [a, b] = [0, 2].map(|k: usize| {
            let face = &mesh.faces[k];
            ConvexBound::on_face(FaceId(k as u32), face, face.polygon.padded_corners())
        });
        let mut found = Vec::new();
        for set in InstructionSet::available() {
            found.push(set.run(EffectOf(&blocker, [&a, &b])));
            found.push(set.run(EffectOf(&blocker, [&b, &a])));
        }
        assert!(found.iter().all(|effect| *effect == found[0]));
        found[0]
    }

    #[test]
    fn effects_of_squares_between_squares() {
        assert_eq!(effect(square(DVec3::Z, 1.0)), Occlusion::Full);
        assert_eq!(effect(square(DVec3::Z, 0.9)), Occlusion::Partial);
        assert_eq!(
            effect(square(DVec3::new(0.99, 0.0, 1.0), 1.0)),
            Occlusion::Partial
        );
        assert_eq!(
            effect(square(DVec3::new(1.0, 0.0, 1.0), 1.0)),
            Occlusion::None
        );
        assert_eq!(
            effect(square(DVec3::new(0.0, 0.0, 2.5), 1.0)),
            Occlusion::None
        );
        // On the plane of one of them it hides nothing, whatever it covers.
        assert_eq!(
            effect(square(DVec3::new(0.0, 0.0, 2.0), 3.0)),
            Occlusion::None
        );
    }

    #[test]
    fn a_triangle_hides_what_its_edges_enclose() {
        let triangle = |size: f64| {
            let corner = |x: f64, y: f64| DVec3::new(size * x, size * y, 1.0);
            Shape::Triangle([corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 1.0)])
        };
        assert_eq!(effect(triangle(5.0)), Occlusion::Full);
        assert_eq!(effect(triangle(1.0)), Occlusion::Partial);
    }
}
