//! Points on patches, eight at a time.

use crate::blocker::Plane;
use arrayvec::ArrayVec;
use radiosity_geometry::{DVec3, Patch, Polygon};
use radiosity_simd::{Float, LANES, Simd};

/// A patch as points are drawn from it.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    corner: DVec3,
    edges: [DVec3; 2],
    /// What makes a quad no parallelogram.
    twist: DVec3,
    /// The Jacobian: at the corner, and what it grows along either edge.
    jacobian: [f64; 3],
    is_triangle: bool,
    pub(crate) normal: DVec3,
    /// The patch in one or two triangles.
    pub(crate) fans: ArrayVec<Fan, 2>,
}

/// A triangle as the lines across it that are parallel to one of its edges: from that they shrink to
/// a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fan {
    pub(crate) apex: DVec3,
    /// From the apex to where the longest line starts, and to where it ends.
    pub(crate) sides: [DVec3; 2],
    /// Twice that of the triangle.
    pub(crate) area: f64,
}

/// Points, one per lane, and the area that each stands for.
pub(crate) struct Points<F> {
    pub(crate) x: F,
    pub(crate) y: F,
    pub(crate) z: F,
    pub(crate) area: F,
}

impl<F: Float<f64>> Points<F> {
    /// The coordinates, by axis.
    #[inline(always)]
    pub(crate) fn lanes(&self) -> [[f64; LANES]; 3] {
        [self.x.lanes(), self.y.lanes(), self.z.lanes()]
    }
}

impl Target {
    pub(crate) fn new(patch: &Patch) -> Target {
        let [a, b, c, d] = *patch.polygon.padded_corners();
        let is_triangle = patch.polygon.is_triangle();
        let (second, twist) = if is_triangle {
            (c - a, DVec3::ZERO)
        } else {
            (d - a, a - b + c - d)
        };
        let at = |u: f64, v: f64| jacobian(&patch.polygon, u, v);
        Target {
            corner: a,
            edges: [b - a, second],
            twist,
            jacobian: [
                at(0.0, 0.0),
                at(1.0, 0.0) - at(0.0, 0.0),
                at(0.0, 1.0) - at(0.0, 0.0),
            ],
            is_triangle,
            normal: patch.normal,
            fans: fans(patch.polygon.corners()),
        }
    }
}

impl Fan {
    /// Of the triangle of these corners, with lines parallel to its second edge.
    pub(crate) fn new([apex, start, end]: [DVec3; 3]) -> Fan {
        let sides = [start - apex, end - apex];
        Fan {
            apex,
            sides,
            area: sides[0].cross(sides[1]).length(),
        }
    }
}

/// The lines of a triangle are parallel to its longest edge, those of a quad to its longer diagonal:
/// to neither edge of a rectangle, since shadows of other rectangles often are, and a line that runs
/// along the edge of a shadow is all light or all dark.
fn fans(corners: &[DVec3]) -> ArrayVec<Fan, 2> {
    match *corners {
        [a, b, c] => {
            let ways = [[a, b, c], [b, c, a], [c, a, b]];
            let longest = |way: &[DVec3; 3]| way[1].distance(way[2]);
            let by_length = |x: &[DVec3; 3], y: &[DVec3; 3]| longest(x).total_cmp(&longest(y));
            ways.into_iter()
                .max_by(by_length)
                .map(Fan::new)
                .into_iter()
                .collect()
        }
        [a, b, c, d] if a.distance(c) >= b.distance(d) => {
            [[b, a, c], [d, a, c]].map(Fan::new).into()
        }
        [a, b, c, d] => [[a, b, d], [c, b, d]].map(Fan::new).into(),
        _ => unreachable!("polygons have three or four corners"),
    }
}

/// Area per parameter, constant on triangles, linear on planar quads.
fn jacobian(polygon: &Polygon, u: f64, v: f64) -> f64 {
    if polygon.is_triangle() {
        1.0
    } else {
        polygon.bilinear_jacobian(u, v)
    }
}

/// The points of a patch with these parameters, uniform in the unit square: on triangles those
/// beyond the diagonal are folded back.
#[inline(always)]
pub(crate) fn points<S: Simd>(simd: S, target: &Target, u: S::F64, v: S::F64) -> Points<S::F64> {
    if !target.is_triangle {
        return at(simd, target, u, v);
    }
    let one = simd.splat_f64(1.0);
    let sum = u + v;
    let (u, v) = (one.if_less(sum, one - u, u), one.if_less(sum, one - v, v));
    at(simd, target, u, v)
}

/// The points of a patch with these parameters.
#[inline(always)]
pub(crate) fn at<S: Simd>(simd: S, target: &Target, u: S::F64, v: S::F64) -> Points<S::F64> {
    let uv = u * v;
    let [a, b] = target.edges;
    let [at_corner, along_u, along_v] = target.jacobian;
    let axis = |k: usize| [target.corner[k], a[k], b[k], target.twist[k]];
    Points {
        x: bilinear(simd, axis(0), u, v, uv),
        y: bilinear(simd, axis(1), u, v, uv),
        z: bilinear(simd, axis(2), u, v, uv),
        area: bilinear(simd, [at_corner, along_u, along_v, 0.0], u, v, uv),
    }
}

#[inline(always)]
fn bilinear<S: Simd>(simd: S, [c, a, b, d]: [f64; 4], u: S::F64, v: S::F64, uv: S::F64) -> S::F64 {
    simd.splat_f64(c) + u * simd.splat_f64(a) + v * simd.splat_f64(b) + uv * simd.splat_f64(d)
}

/// The kernel of the form factor but for a constant.
#[inline(always)]
pub(crate) fn kernel<S: Simd>(
    simd: S,
    (i, p): (&Target, &Points<S::F64>),
    (j, q): (&Target, &Points<S::F64>),
) -> S::F64 {
    let (x, y, z) = (q.x - p.x, q.y - p.y, q.z - p.z);
    let zero = simd.splat_f64(0.0);
    let height_of_q = dot(simd, i.normal, x, y, z).max(zero);
    let height_of_p = (-dot(simd, j.normal, x, y, z)).max(zero);
    let squared = x * x + y * y + z * z;
    let product = height_of_q * height_of_p;
    // Where points coincide nothing is divided by nothing.
    zero.if_less(product, product / (squared * squared), zero)
}

#[inline(always)]
pub(crate) fn dot<S: Simd>(simd: S, n: DVec3, x: S::F64, y: S::F64, z: S::F64) -> S::F64 {
    simd.splat_f64(n.x) * x + simd.splat_f64(n.y) * y + simd.splat_f64(n.z) * z
}

#[inline(always)]
pub(crate) fn height<S: Simd>(simd: S, plane: &Plane, p: &Points<S::F64>) -> S::F64 {
    dot(simd, plane.normal, p.x, p.y, p.z) - simd.splat_f64(plane.offset)
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let fans = fans(corners);
            assert_eq!(fans.len(), corners.len() - 2);
            let area: f64 = fans.iter().map(|fan| 0.5 * fan.area).sum();
            assert!((area / polygon.area() - 1.0).abs() < 1e-15);
        }
        for fan in fans(&rectangle) {
            let along = fan.sides[1] - fan.sides[0];
            assert!(along.y.abs() > 0.5 && along.z.abs() > 0.5);
        }
    }
}
