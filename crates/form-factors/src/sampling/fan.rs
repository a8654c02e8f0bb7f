//! Triangles as lines across them, and how densely these are drawn.

use crate::culling::blocker::Plane;
use crate::sampling::patch_sampler::{SamplePoints, height};
use arrayvec::ArrayVec;
use radiosity_geometry::DVec3;
use radiosity_simd::{Float, Simd};

/// A triangle as the lines across it that are parallel to one of its edges: from that they shrink
/// to a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fan {
    pub(crate) apex: DVec3,
    /// From the apex to where the longest line starts, and to where it ends.
    pub(crate) sides: [DVec3; 2],
    /// Twice that of the triangle.
    pub(crate) area: f64,
    /// Heights over it are those over the triangle, in units of `width`: the distance of the
    /// longest line from the apex.
    over: Plane,
    /// Heights over it are distances from the line through the apex, in the same units.
    beyond: Plane,
}

/// Points are at least so far in front of a triangle, in units of its width: nothing is divided by
/// zero.
const NEAREST: f64 = 1e-12;

impl Fan {
    /// Of the triangle of these corners, with lines parallel to its second edge.
    pub(crate) fn new([apex, start, end]: [DVec3; 3], normal: DVec3) -> Fan {
        let sides = [start - apex, end - apex];
        let area = sides[0].cross(sides[1]).length();
        let along = (end - start).normalize();
        let width = sides[0] - sides[0].dot(along) * along;
        Fan {
            apex,
            sides,
            area,
            over: Plane::through(apex, normal / width.length()),
            beyond: Plane::through(apex, width / width.length_squared()),
        }
    }

    /// The place on the line of this length that is so far along it, from 0 to 1.
    #[inline(always)]
    pub(crate) fn place<S: Simd>(&self, simd: S, length: S::F64, at: S::F64) -> [S::F64; 3] {
        let [start, end] = self.sides;
        let mut place = [length; 3];
        for (axis, place) in place.iter_mut().enumerate() {
            let start = simd.splat_f64(start[axis]);
            let along = at * (simd.splat_f64(end[axis]) - start);
            *place = simd.splat_f64(self.apex[axis]) + length * (start + along);
        }
        place
    }

    /// The length of a line, in units of the longest, at an angle that is `turn` of the way from
    /// the apex to the longest line, seen from a point; and its derivative by `turn`.
    ///
    /// Lines that are drawn evenly by length hardly ever pass near a point that nearly touches the
    /// triangle, where most of the light is. Across the lines, the triangle is a segment that
    /// subtends an angle `Omega`:
    ///
    /// ```text
    ///    apex *---- length ----*---------* longest line
    ///          \              /         /
    ///         L \  phi       /        / H       phi = 0 at the apex, Omega at the longest line
    ///             \        /       /
    ///               \     /     /
    ///                   point
    /// ```
    ///
    /// By the law of sines `length = L sin phi / (L sin phi + H sin(Omega - phi))`. With
    /// `v = 2 turn - 1`, `tan((phi - Omega / 2) / 2) = tan(Omega / 4) v` makes `phi` go with
    /// `turn`, almost evenly, and with `q = tan^2(Omega / 4)` the sines are `turn (1 - q v)` and
    /// `(1 - turn) (1 + q v)`, but for a common factor. All terms are positive: nothing is lost
    /// where the triangle is far away, and single precision is enough to draw lines.
    #[inline(always)]
    pub(crate) fn line<S: Simd>(
        &self,
        simd: S,
        p: &SamplePoints<S::F64>,
        turn: S::F64,
    ) -> [S::F64; 2] {
        let one = simd.splat_f32(1.0);
        let over = simd.narrow(height(simd, &self.over, p).max(simd.splat_f64(NEAREST)));
        let beyond = height(simd, &self.beyond, p);
        let past = simd.narrow(simd.splat_f64(1.0) - beyond);
        let beyond = simd.narrow(beyond);
        let low = (over * over + beyond * beyond).sqrt();
        let high = (over * over + past * past).sqrt();
        let (sine, cosine) = (
            over / (low * high),
            (over * over - beyond * past) / (low * high),
        );
        let half = half_cosine(simd, sine, cosine);
        let q = (one - half) / (one + half);
        let u = simd.narrow(turn);
        let v = u + u - one;
        let near = u * (one - q * v) * (low / high);
        let sum = near + (one - u) * (one + q * v);
        let derivative = (low / high) * (one - q) * (one + q * v * v) / (sum * sum);
        [simd.widen(near / sum), simd.widen(derivative)]
    }
}

/// The cosine of half of an angle between 0 and pi.
#[inline(always)]
fn half_cosine<S: Simd>(simd: S, sine: S::F32, cosine: S::F32) -> S::F32 {
    let (zero, half, one) = (
        simd.splat_f32(0.0),
        simd.splat_f32(0.5),
        simd.splat_f32(1.0),
    );
    // Of a sum and a difference the one that loses no digits.
    let acute = (half * (one + cosine)).max(zero).sqrt();
    let obtuse = half * sine / (half * (one - cosine)).max(zero).sqrt();
    cosine.if_less(zero, obtuse, acute)
}

/// The lines of a triangle are parallel to its longest edge, those of a quad to its longer
/// diagonal: to neither edge of a rectangle, since shadows of other rectangles often are, and a
/// line that runs along the edge of a shadow is all light or all dark.
pub(crate) fn fans(corners: &[DVec3], normal: DVec3) -> ArrayVec<Fan, 2> {
    let triangles: ArrayVec<[DVec3; 3], 2> = match *corners {
        [a, b, c] => {
            let ways = [[a, b, c], [b, c, a], [c, a, b]];
            let longest = |way: &[DVec3; 3]| way[1].distance(way[2]);
            let by_length = |x: &[DVec3; 3], y: &[DVec3; 3]| longest(x).total_cmp(&longest(y));
            ways.into_iter().max_by(by_length).into_iter().collect()
        }
        [a, b, c, d] if a.distance(c) >= b.distance(d) => [[b, a, c], [d, a, c]].into(),
        [a, b, c, d] => [[a, b, d], [c, b, d]].into(),
        _ => unreachable!("polygons have three or four corners"),
    };
    let fans = triangles
        .into_iter()
        .map(|corners| Fan::new(corners, normal));
    // A corner may lie on the diagonal.
    fans.filter(|fan| fan.area > 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::patch_sampler::{PatchSampler, points};
    use radiosity_geometry::Polygon;
    use radiosity_simd::{InstructionSet, Kernel};

    #[test]
    fn fans_are_the_polygon_and_run_along_no_edge_of_a_rectangle() {
        let p = DVec3::new;
        let quad = [
            p(0.0, 0.0, 0.0),
            p(3.0, 0.0, 0.0),
            p(2.0, 2.0, 0.0),
            p(0.5, 2.0, 0.0),
        ];
        let rectangle = [
            p(0.0, 0.0, 0.0),
            p(0.0, 3.0, 0.0),
            p(0.0, 3.0, 1.0),
            p(0.0, 0.0, 1.0),
        ];
        for corners in [&quad[..], &quad[1..], &quad[..3], &rectangle] {
            let polygon = match *corners {
                [a, b, c] => Polygon::triangle([a, b, c]),
                [a, b, c, d] => Polygon::quad([a, b, c, d]),
                _ => unreachable!(),
            };
            let fans = fans(corners, polygon.normal());
            assert_eq!(fans.len(), corners.len() - 2);
            let area: f64 = fans.iter().map(|fan| 0.5 * fan.area).sum();
            assert!((area / polygon.area() - 1.0).abs() < 1e-15);
        }
        for fan in fans(&rectangle, DVec3::X) {
            let along = fan.sides[1] - fan.sides[0];
            assert!(along.y.abs() > 0.5 && along.z.abs() > 0.5);
        }
    }

    /// The lines at some turns, from a point.
    struct LinesAt<'a>(&'a Fan, DVec3, [f64; 3]);

    impl Kernel for LinesAt<'_> {
        type Output = [[f64; 2]; 3];

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> [[f64; 2]; 3] {
            let LinesAt(fan, point, turns) = self;
            // All points of a triangle without size.
            let target = PatchSampler::new(&Polygon::triangle([point; 3]), DVec3::Z);
            let zero = simd.splat_f64(0.0);
            let p = points(simd, &target, zero, zero);
            let mut lines = [[0.0; 2]; 3];
            for (line, turn) in lines.iter_mut().zip(turns) {
                let found = fan.line(simd, &p, simd.splat_f64(turn));
                *line = [found[0].lanes()[0], found[1].lanes()[0]];
            }
            lines
        }
    }

    /// From anywhere in front of a triangle, near and far: lines go all the way from the apex to
    /// the longest, and the derivative is that.
    #[test]
    fn lines_sweep_the_triangle() {
        let triangle = [
            DVec3::ZERO,
            DVec3::new(2.0, -1.0, 0.0),
            DVec3::new(2.0, 3.0, 0.0),
        ];
        let fan = Fan::new(triangle, DVec3::Z);
        for (x, height) in [
            (1.0, 1.0),
            (1.0, 0.05),
            (-3.0, 0.3),
            (7.0, 1e-2),
            (-1e6, 1.0),
            (30.0, 1e7),
        ] {
            let at = |turns| {
                let point = DVec3::new(x, 1.0, height);
                let run = |set: InstructionSet| set.run(LinesAt(&fan, point, turns));
                let found: Vec<_> = InstructionSet::available().into_iter().map(run).collect();
                assert!(found.iter().all(|lines| *lines == found[0]));
                found[0]
            };
            let [[first, _], _, [last, _]] = at([0.0, 0.5, 1.0]);
            assert_eq!([first, last], [0.0, 1.0], "{x} {height}");
            for k in 1..20 {
                let (turn, step) = (f64::from(k) / 20.0, 1e-2);
                let [[before, _], [_, slope], [after, _]] = at([turn - step, turn, turn + step]);
                let expected = (after - before) / (2.0 * step);
                // Half of the second derivative of the slope, at most of order 1 / height^2, times
                // the square of the step; and single precision over the step.
                let near = (height / 2.0).min(1.0);
                let bound = step * step / (near * near) + 1e-4;
                assert!(
                    (slope / expected - 1.0).abs() < bound,
                    "{x} {height} {turn}"
                );
            }
        }
    }
}
