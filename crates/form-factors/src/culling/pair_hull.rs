//! The space between two parts, the convex hull of both: what lies outside of it stands in nobody's
//! way.

use crate::culling::blocker::Blocker;
use crate::culling::convex_bound::ConvexBound;
use radiosity_geometry::DVec3;
use radiosity_simd::{Float, LANES, Simd};

/// Planes through an edge of one of two polygons and a corner of the other that have all of both on
/// one side: with the planes of both, they are what the convex hull of both is bounded by.
pub(crate) struct PairHull<F>([Planes<F>; 4]);

/// Planes, one per lane.
struct Planes<F> {
    /// Of any length.
    normal: [F; 3],
    offset: F,
    /// The height up to which a corner counts as in the plane, times the length of the normal.
    tolerance: F,
    /// Which have all of the hull above them.
    bounds: u8,
}

type Corners = [DVec3; 4];

impl<F: Float<f64>> PairHull<F> {
    /// Of two parts that lie on faces.
    #[inline(always)]
    pub(crate) fn of<S: Simd<F64 = F>>(
        simd: S,
        parts: [&ConvexBound; 2],
        tolerance: f64,
    ) -> Option<PairHull<F>> {
        let [i, j] = [parts[0].polygon()?, parts[1].polygon()?];
        Some(PairHull([
            Planes::through(simd, (i, j), [j[0], j[1]], tolerance),
            Planes::through(simd, (i, j), [j[2], j[3]], tolerance),
            Planes::through(simd, (j, i), [i[0], i[1]], tolerance),
            Planes::through(simd, (j, i), [i[2], i[3]], tolerance),
        ]))
    }

    /// Whether a plane parts it from a blocker.
    #[inline(always)]
    pub(crate) fn is_clear_of<S: Simd<F64 = F>>(&self, simd: S, blocker: &Blocker) -> bool {
        let mut apart = 0;
        for planes in &self.0 {
            let mut below = planes.bounds;
            for corner in &blocker.corners {
                if below == 0 {
                    break;
                }
                below &= planes
                    .heights(simd, *corner)
                    .less_or_equal(planes.tolerance);
            }
            apart |= below;
        }
        apart != 0
    }
}

impl<F: Float<f64>> Planes<F> {
    /// Through each edge of the first polygon and each of two corners of the other.
    #[inline(always)]
    fn through<S: Simd<F64 = F>>(
        simd: S,
        (edges_of, other): (&Corners, &Corners),
        [first, second]: [DVec3; 2],
        tolerance: f64,
    ) -> Planes<F> {
        let (mut starts, mut edges, mut to_corners) =
            ([[0.0; LANES]; 3], [[0.0; LANES]; 3], [[0.0; LANES]; 3]);
        for axis in 0..3 {
            for lane in 0..LANES {
                let (start, end) = (edges_of[lane % 4], edges_of[(lane + 1) % 4]);
                let corner = if lane < 4 { first } else { second };
                starts[axis][lane] = start[axis];
                edges[axis][lane] = end[axis] - start[axis];
                to_corners[axis][lane] = corner[axis] - start[axis];
            }
        }
        let [ax, ay, az] = [
            simd.f64(&edges[0]),
            simd.f64(&edges[1]),
            simd.f64(&edges[2]),
        ];
        let [bx, by, bz] = [
            simd.f64(&to_corners[0]),
            simd.f64(&to_corners[1]),
            simd.f64(&to_corners[2]),
        ];
        let normal = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
        let [x, y, z] = normal;
        let offset = x * simd.f64(&starts[0]) + y * simd.f64(&starts[1]) + z * simd.f64(&starts[2]);
        let length = (x * x + y * y + z * z).sqrt();
        let mut planes = Planes {
            normal,
            offset,
            tolerance: simd.splat_f64(tolerance) * length,
            bounds: 0,
        };
        let mut lowest = simd.splat_f64(0.0);
        let mut highest = lowest;
        for corner in edges_of.iter().chain(other) {
            let height = planes.heights(simd, *corner);
            lowest = lowest.min(height);
            highest = highest.max(height);
        }
        // Where edges have no length, nothing is to either side.
        let above = (-planes.tolerance).less_or_equal(lowest) & planes.tolerance.less(highest);
        let below = highest.less_or_equal(planes.tolerance) & lowest.less(-planes.tolerance);
        planes.normal = [
            (-x).select(below, x),
            (-y).select(below, y),
            (-z).select(below, z),
        ];
        planes.offset = (-offset).select(below, offset);
        planes.bounds = above | below;
        planes
    }

    #[inline(always)]
    fn heights<S: Simd<F64 = F>>(&self, simd: S, point: DVec3) -> F {
        let [x, y, z] = self.normal;
        x * simd.splat_f64(point.x) + y * simd.splat_f64(point.y) + z * simd.splat_f64(point.z)
            - self.offset
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use radiosity_geometry::{FaceId, Mesh, Occluders, Shape};
    use radiosity_simd::{InstructionSet, Kernel};
    use radiosity_test_kit::random::vector;
    use radiosity_test_kit::{self as kit, Facing, mesh_of, parallelogram};
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    struct IsClear<'a>(&'a Blocker, [&'a ConvexBound; 2]);

    impl Kernel for IsClear<'_> {
        type Output = bool;

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> bool {
            let hull = PairHull::of(simd, self.1, 1e-12);
            hull.is_some_and(|hull| hull.is_clear_of(simd, self.0))
        }
    }

    /// Whether the last of three faces is outside of the hull of the first two, on all instruction
    /// sets and whichever of the two comes first.
    fn is_clear(mesh: &Mesh) -> bool {
        let part = |k: usize| {
            let face = &mesh.faces[k];
            ConvexBound::on_face(FaceId(k as u32), face, face.polygon.padded_corners())
        };
        let (i, j) = (part(0), part(1));
        let blocker = Blocker::new(&mesh.faces[2].polygon);
        let mut found = Vec::new();
        for set in InstructionSet::available() {
            found.push(set.run(IsClear(&blocker, [&i, &j])));
            found.push(set.run(IsClear(&blocker, [&j, &i])));
        }
        assert!(found.iter().all(|clear| *clear == found[0]));
        found[0]
    }

    fn square([x, y, z]: [f64; 3], edge: f64) -> Shape {
        kit::square([x, y], edge, z, Facing::Up)
    }

    /// A square across the two others, whose planes both pass through its plane.
    fn upright(x: f64, y: f64) -> Shape {
        parallelogram([x, y, 0.2], DVec3::X, 0.6 * DVec3::Z)
    }

    #[test]
    fn what_stands_beside_is_outside() {
        let ends = || [square([0.0; 3], 1.0), square([0.0, 0.0, 1.0], 1.0)];
        let found = |blocker: Shape| {
            let [i, j] = ends();
            is_clear(&mesh_of([i, j, blocker]))
        };
        assert!(!found(square([0.9, 0.0, 0.5], 1.0)));
        assert!(found(square([1.1, 0.0, 0.5], 1.0)));
        // It touches the hull.
        assert!(found(square([1.0, 0.0, 0.5], 1.0)));
        assert!(!found(upright(0.0, 0.0)));
        assert!(!found(upright(0.4, 0.4)));
        assert!(found(upright(0.6, 0.4)));
        assert!(found(upright(-2.0, 0.4)));
    }

    /// No segment from one to the other meets what is said to be outside; and much is.
    #[test]
    fn nothing_outside_is_met() {
        let mut rng = Pcg64Mcg::seed_from_u64(7);
        let (mut clear, mut met) = (0, 0);
        for case in 0..3000 {
            let mut shape = |corner: f64, size: f64| {
                let [corner, a, b] = [corner, size, size].map(|size| vector(&mut rng, size));
                if case % 2 == 0 {
                    Shape::Triangle([corner, corner + a, corner + b])
                } else {
                    Shape::Quad([corner, corner + a, corner + a + 0.3 * b, corner + b])
                }
            };
            let shapes = [shape(2.0, 1.0), shape(2.0, 1.0), shape(2.0, 2.0)];
            let mesh = mesh_of(shapes);
            let occluders = Occluders::new(&mesh);
            let mut on = |k: usize| {
                let polygon = &mesh.faces[k].polygon;
                polygon.bilinear(rng.random(), rng.random())
            };
            let cut = (0..200).any(|_| occluders.cuts(FaceId(2), on(0), on(1)));
            let is_clear = is_clear(&mesh);
            assert!(!(is_clear && cut));
            clear += usize::from(is_clear);
            met += usize::from(cut);
        }
        // Some are neither: what reaches in by little, or is only parted by its own plane.
        assert!(clear > 2000 && met > 250, "{clear} {met}");
    }
}
