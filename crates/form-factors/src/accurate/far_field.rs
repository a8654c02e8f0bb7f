//! The exchange of a patch with those of a tile, with nothing between them and far apart: by the
//! smallest of Gauss's rules that is good enough, one pair per lane.

use crate::accurate::PairEstimate;
use crate::accurate::patch_quadrature::{PatchQuadrature, RULES};
use crate::sampling::patch_sampler::dot;
use arrayvec::ArrayVec;
use radiosity_geometry::DVec3;
use radiosity_simd::{Float, Kernel, LANES, Simd, dispatch};
use std::f64::consts::PI;

/// The patches of a tile, one per lane. Lanes without one repeat the first, and so do those of
/// patches in pieces, which are never far.
pub(crate) struct FarTile {
    /// Which lanes have one.
    used: u8,
    centroid: Lanes,
    normal: Lanes,
    radius: [f64; LANES],
    area: [f64; LANES],
    /// Triangles repeat their last one.
    corners: [Lanes; 4],
    rules: [Vec<Nodes>; RULES],
}

/// Vectors, one per lane, by axis.
type Lanes = [[f64; LANES]; 3];

/// A point of a rule on each patch, and the area that it stands for.
struct Nodes {
    point: Lanes,
    area: [f64; LANES],
}

/// The error of each rule is at most this times `ratio^(2 points)`, relative to the exchange of
/// patches of these areas, at this distance, that face each other squarely; `ratio` is that of the
/// patches' radii to their distance.
const ERROR: [f64; RULES] = [1.0, 0.15, 0.02];

impl FarTile {
    /// `None` if all patches are in pieces.
    pub(crate) fn new(elements: &ArrayVec<Option<&PatchQuadrature>, LANES>) -> Option<FarTile> {
        let first = *elements.iter().flatten().next()?;
        let of_lane = |lane: usize| elements.get(lane).copied().flatten().unwrap_or(first);
        let lanes = |vector: &dyn Fn(&PatchQuadrature) -> DVec3| -> Lanes {
            let vectors: [DVec3; LANES] = std::array::from_fn(|lane| vector(of_lane(lane)));
            std::array::from_fn(|axis| vectors.map(|vector| vector[axis]))
        };
        let numbers = |number: &dyn Fn(&PatchQuadrature) -> f64| -> [f64; LANES] {
            std::array::from_fn(|lane| number(of_lane(lane)))
        };
        let corner = |k: usize| lanes(&|e: &PatchQuadrature| e.polygon.padded_corners()[k]);
        let nodes = |rule: usize| {
            let node = |k: usize| Nodes {
                point: lanes(&|e: &PatchQuadrature| e.rules[rule][k].point),
                area: numbers(&|e: &PatchQuadrature| e.rules[rule][k].area),
            };
            (0..first.rules[rule].len()).map(node).collect()
        };
        let used = elements.iter().enumerate();
        Some(FarTile {
            used: used.fold(0, |used, (lane, e)| used | u8::from(e.is_some()) << lane),
            centroid: lanes(&|e: &PatchQuadrature| e.centroid),
            normal: lanes(&|e: &PatchQuadrature| e.normal),
            radius: numbers(&|e: &PatchQuadrature| e.radius),
            area: numbers(&PatchQuadrature::area),
            corners: std::array::from_fn(corner),
            rules: std::array::from_fn(nodes),
        })
    }
}

/// The exchange of a patch with each of a tile, or `None` where they are too near for the rules or
/// cross each other's planes.
///
/// The error is about `error` times the exchange of patches that face each other squarely;
/// `tolerance` is the height up to which a corner counts as in a plane.
pub(crate) fn exchange(
    patch: &PatchQuadrature,
    tile: &FarTile,
    error: f64,
    tolerance: f64,
) -> [Option<PairEstimate>; LANES] {
    let found = dispatch(Far {
        patch,
        tile,
        error,
        tolerance,
    });
    std::array::from_fn(|lane| {
        let is_far = found.far & tile.used & 1 << lane != 0;
        is_far.then(|| PairEstimate::clear(found.values[lane], error * found.squarely[lane]))
    })
}

struct Far<'a> {
    patch: &'a PatchQuadrature,
    tile: &'a FarTile,
    error: f64,
    tolerance: f64,
}

struct Found {
    /// Where the others are good.
    far: u8,
    values: [f64; LANES],
    squarely: [f64; LANES],
}

impl Kernel for Far<'_> {
    type Output = Found;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Found {
        let Far { patch, tile, .. } = self;
        let [x, y, z] = from_patch(simd, &tile.centroid, patch.centroid);
        let squared = x * x + y * y + z * z;
        let radii = simd.f64(&tile.radius) + simd.splat_f64(patch.radius);
        let ratio = radii * radii / squared;
        let zero = simd.splat_f64(0.0);
        let (mut values, mut undone) = (zero, self.face_whole(simd));
        let mut power = simd.splat_f64(1.0);
        let whole = undone;
        for (rule, constant) in ERROR.into_iter().enumerate() {
            power = power * ratio;
            let good = (simd.splat_f64(constant) * power).less(simd.splat_f64(self.error)) & undone;
            if good != 0 {
                values = self.integral(simd, rule).select(good, values);
                undone &= !good;
            }
        }
        let areas = simd.f64(&tile.area) * simd.splat_f64(patch.area());
        Found {
            far: whole & !undone,
            values: values.lanes(),
            squarely: (areas / (simd.splat_f64(PI) * squared)).lanes(),
        }
    }
}

impl Far<'_> {
    /// Where both patches are wholly in front of each other.
    #[inline(always)]
    fn face_whole<S: Simd>(&self, simd: S) -> u8 {
        let Far { patch, tile, .. } = self;
        let lowest = simd.splat_f64(-self.tolerance);
        let mut whole = !0;
        for corner in &tile.corners {
            let [x, y, z] = from_patch(simd, corner, patch.centroid);
            whole &= lowest.less_or_equal(dot(simd, patch.normal, x, y, z));
        }
        for corner in patch.corners() {
            let [x, y, z] = from_patch(simd, &tile.centroid, *corner);
            whole &= lowest.less_or_equal(-along(simd, &tile.normal, [x, y, z]));
        }
        whole
    }

    /// `A_i F_ij` by all pairs of the points of a rule.
    #[inline(always)]
    fn integral<S: Simd>(&self, simd: S, rule: usize) -> S::F64 {
        let Far { patch, tile, .. } = self;
        let zero = simd.splat_f64(0.0);
        let mut sum = zero;
        for sample in &patch.rules[rule] {
            let mut from_point = zero;
            for node in &tile.rules[rule] {
                let [x, y, z] = from_patch(simd, &node.point, sample.point);
                let height_of_node = dot(simd, patch.normal, x, y, z).max(zero);
                let height_of_point = (-along(simd, &tile.normal, [x, y, z])).max(zero);
                let squared = x * x + y * y + z * z;
                let kernel = height_of_node * height_of_point / (squared * squared);
                from_point = from_point + simd.f64(&node.area) * kernel;
            }
            sum = sum + simd.splat_f64(sample.area) * from_point;
        }
        sum * simd.splat_f64(1.0 / PI)
    }
}

/// Vectors from a point.
#[inline(always)]
fn from_patch<S: Simd>(simd: S, to: &Lanes, from: DVec3) -> [S::F64; 3] {
    [
        simd.f64(&to[0]) - simd.splat_f64(from.x),
        simd.f64(&to[1]) - simd.splat_f64(from.y),
        simd.f64(&to[2]) - simd.splat_f64(from.z),
    ]
}

/// The lengths of vectors along others.
#[inline(always)]
fn along<S: Simd>(simd: S, normal: &Lanes, [x, y, z]: [S::F64; 3]) -> S::F64 {
    simd.f64(&normal[0]) * x + simd.f64(&normal[1]) * y + simd.f64(&normal[2]) * z
}

#[cfg(test)]
mod tests;
