//! Points on patches, eight at a time.

use crate::culling::blocker::Plane;
use crate::sampling::fan::{Fan, fans};
use arrayvec::ArrayVec;
use radiosity_geometry::{DVec3, Polygon};
use radiosity_simd::{Float, LANES, Simd};

/// A patch as points are drawn from it.
#[derive(Clone, Debug)]
pub(crate) struct PatchSampler {
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

/// Points, one per lane, and the area that each stands for.
pub(crate) struct SamplePoints<F> {
    pub(crate) x: F,
    pub(crate) y: F,
    pub(crate) z: F,
    pub(crate) area: F,
}

impl<F: Float<f64>> SamplePoints<F> {
    /// The coordinates, by axis.
    #[inline(always)]
    pub(crate) fn lanes(&self) -> [[f64; LANES]; 3] {
        [self.x.lanes(), self.y.lanes(), self.z.lanes()]
    }
}

impl PatchSampler {
    /// Of a polygon with this normal.
    pub(crate) fn new(polygon: &Polygon, normal: DVec3) -> PatchSampler {
        let [a, b, c, d] = *polygon.padded_corners();
        let is_triangle = polygon.is_triangle();
        let (second, twist) = if is_triangle {
            (c - a, DVec3::ZERO)
        } else {
            (d - a, a - b + c - d)
        };
        let at = |u: f64, v: f64| jacobian(polygon, u, v);
        PatchSampler {
            corner: a,
            edges: [b - a, second],
            twist,
            jacobian: [
                at(0.0, 0.0),
                at(1.0, 0.0) - at(0.0, 0.0),
                at(0.0, 1.0) - at(0.0, 0.0),
            ],
            is_triangle,
            normal,
            fans: fans(polygon.corners(), normal),
        }
    }
}

/// Area per parameter, constant on triangles, linear on planar quads.
fn jacobian(polygon: &Polygon, u: f64, v: f64) -> f64 {
    if polygon.is_triangle() {
        polygon.area()
    } else {
        polygon.bilinear_jacobian(u, v)
    }
}

/// The points of a patch with these parameters, uniform in the unit square: on triangles those
/// beyond the diagonal are folded back.
#[inline(always)]
pub(crate) fn points<S: Simd>(
    simd: S,
    target: &PatchSampler,
    u: S::F64,
    v: S::F64,
) -> SamplePoints<S::F64> {
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
pub(crate) fn at<S: Simd>(
    simd: S,
    target: &PatchSampler,
    u: S::F64,
    v: S::F64,
) -> SamplePoints<S::F64> {
    let uv = u * v;
    let [a, b] = target.edges;
    let [at_corner, along_u, along_v] = target.jacobian;
    let axis = |k: usize| [target.corner[k], a[k], b[k], target.twist[k]];
    SamplePoints {
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

#[inline(always)]
pub(crate) fn dot<S: Simd>(simd: S, n: DVec3, x: S::F64, y: S::F64, z: S::F64) -> S::F64 {
    simd.splat_f64(n.x) * x + simd.splat_f64(n.y) * y + simd.splat_f64(n.z) * z
}

#[inline(always)]
pub(crate) fn height<S: Simd>(simd: S, plane: &Plane, p: &SamplePoints<S::F64>) -> S::F64 {
    dot(simd, plane.normal, p.x, p.y, p.z) - simd.splat_f64(plane.offset)
}
