//! The kernel of the form factor, summed over the points of a patch and of eight others.
//!
//! Long because: the near and the far form of one kernel, side by side.

use crate::regular::tile_points::{Lanes, LocalPoints, Point};
use radiosity_simd::{Float, Kernel, LANES, Simd};

/// The sum over all pairs of points of a patch and each of eight others: their exchange, in units
/// of the total area.
///
/// With `d` the vector between two points and `h` the height of either over the other's plane, the
/// kernel is `h_i h_j / (pi d^4)`. Heights over planes are linear, so each is found once a point.
pub(crate) struct PointSum<'a> {
    /// A tile, and which of its patches is meant.
    pub(crate) from: (&'a LocalPoints, usize),
    pub(crate) to: &'a LocalPoints,
    /// By point of `to` and point of `from`: one bit per lane. Nothing if nothing is blocked.
    pub(crate) blocked: &'a [u8],
    pub(crate) sources: &'a mut Vec<Source>,
}

/// The same of the first so many patches of a tile, with nothing in the way, if all are far from
/// the others.
pub(crate) struct FarPointSum<'a> {
    pub(crate) from: (&'a LocalPoints, usize),
    pub(crate) to: &'a LocalPoints,
    pub(crate) sources: &'a mut Vec<Source>,
    pub(crate) values: &'a mut [Lanes<f32>; LANES],
}

/// A point of the patch as the others see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source {
    position: [f32; 3],
    /// Over the others' planes, times the area that the point stands for.
    heights: Lanes<f32>,
}

/// Points nearer than this, in radii of the smaller patch, exchange nothing: where patches cross
/// and points coincide, heights are rounding.
const NEAREST: f32 = 1e-5;
/// Points are farther apart than that if centroids are by more than so many radii of the larger
/// patch.
const TOUCHING: f32 = 2.1;
/// Squared: as good as infinitely far, but two such squares still have a product.
const INFINITE: f32 = 1e18;

impl Kernel for PointSum<'_> {
    type Output = Lanes<f32>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Lanes<f32> {
        let (from, lane) = self.from;
        let distance = Distance::of(simd, (from, lane), self.to);
        let blocked = self.blocked;
        // Whether few points do is a matter of each pair, whichever other pairs are summed with it.
        let few_do = distance.far & !blocked.iter().fold(0, |some, &lanes| some | lanes);
        let few = match few_do {
            0 => simd.splat_f32(0.0),
            _ => by_few(simd, (from, lane), self.to, self.sources),
        };
        if few_do == !0 {
            return few.lanes();
        }
        find_sources(simd, (&from.points, lane), self.to, self.sources);
        let pairs = Pairs {
            plane: Plane::of(from, lane),
            sources: self.sources,
            targets: &self.to.points,
            nearest: distance.nearest,
            blocked,
        };
        let all = match (blocked.is_empty(), distance.never_touch) {
            (true, true) => pairs.sum::<S, false, true>(simd),
            (true, false) => pairs.sum::<S, false, false>(simd),
            (false, true) => pairs.sum::<S, true, true>(simd),
            (false, false) => pairs.sum::<S, true, false>(simd),
        };
        few.select(few_do, all).lanes()
    }
}

impl Kernel for FarPointSum<'_> {
    /// Whether all are.
    type Output = bool;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> bool {
        let (from, patches) = self.from;
        for lane in 0..patches {
            if Distance::of(simd, (from, lane), self.to).far != !0 {
                return false;
            }
        }
        for (lane, values) in self.values.iter_mut().enumerate().take(patches) {
            *values = by_few(simd, (from, lane), self.to, self.sources).lanes();
        }
        true
    }
}

/// The sums over the few points that stand for all of a patch and of each of the others.
#[inline(always)]
fn by_few<S: Simd>(
    simd: S,
    (from, lane): (&LocalPoints, usize),
    to: &LocalPoints,
    sources: &mut Vec<Source>,
) -> S::F32 {
    find_sources(simd, (&from.reduced_points, lane), to, sources);
    let pairs = Pairs {
        plane: Plane::of(from, lane),
        sources,
        targets: &to.reduced_points,
        nearest: [0.0; LANES],
        blocked: &[],
    };
    pairs.sum::<S, false, true>(simd)
}

/// The plane of a patch: where `normal * x = offset`.
#[derive(Clone, Copy)]
struct Plane {
    normal: [f32; 3],
    offset: f32,
}

impl Plane {
    #[inline(always)]
    fn of(local: &LocalPoints, lane: usize) -> Plane {
        Plane {
            normal: at(&local.normal, lane),
            offset: local.offset[lane],
        }
    }
}

/// The vector in a lane.
#[inline(always)]
fn at([x, y, z]: &[Lanes<f32>; 3], lane: usize) -> [f32; 3] {
    [x[lane], y[lane], z[lane]]
}

/// The product of eight vectors with one.
#[inline(always)]
fn times<S: Simd>(simd: S, [x, y, z]: [S::F32; 3], one: [f32; 3]) -> S::F32 {
    x * simd.splat_f32(one[0]) + y * simd.splat_f32(one[1]) + z * simd.splat_f32(one[2])
}

#[inline(always)]
fn load<S: Simd>(simd: S, [x, y, z]: &[Lanes<f32>; 3]) -> [S::F32; 3] {
    [simd.f32(x), simd.f32(y), simd.f32(z)]
}

/// How far a patch is from each of eight others.
struct Distance {
    /// No point of one coincides with one of another.
    never_touch: bool,
    /// Which are so far that few points can stand for all, and all of them lie on one side of the
    /// plane of the other patch.
    far: u8,
    /// What counts as no distance.
    nearest: Lanes<f32>,
}

impl Distance {
    #[inline(always)]
    fn of<S: Simd>(simd: S, (from, lane): (&LocalPoints, usize), to: &LocalPoints) -> Distance {
        let [from_x, from_y, from_z] = at(&from.centroid, lane);
        let [x, y, z] = load(simd, &to.centroid);
        let (x, y, z) = (
            x - simd.splat_f32(from_x),
            y - simd.splat_f32(from_y),
            z - simd.splat_f32(from_z),
        );
        let squared = x * x + y * y + z * z;
        let (radius_to, radius_from) = (simd.f32(&to.radius), simd.splat_f32(from.radius[lane]));
        let larger = radius_to.max(radius_from);
        let touching = simd.splat_f32(TOUCHING) * larger;
        let near = simd.f32(&to.near).max(simd.splat_f32(from.near[lane]));
        let height_to = times(simd, [x, y, z], at(&from.normal, lane));
        let [nx, ny, nz] = load(simd, &to.normal);
        let height_from = nx * x + ny * y + nz * z;
        let mut far = (near * near).less(squared);
        far &= radius_to.less(height_to.max(-height_to));
        far &= radius_from.less(height_from.max(-height_from));
        Distance {
            never_touch: (touching * touching).less(squared) == !0,
            far,
            nearest: (simd.splat_f32(NEAREST) * radius_to.min(radius_from)).lanes(),
        }
    }
}

#[inline(always)]
fn find_sources<S: Simd>(
    simd: S,
    (points, lane): (&[Point<f32>], usize),
    to: &LocalPoints,
    sources: &mut Vec<Source>,
) {
    sources.clear();
    for point in points {
        sources.push(source(simd, (point, lane), to));
    }
}

#[inline(always)]
fn source<S: Simd>(simd: S, (point, lane): (&Point<f32>, usize), to: &LocalPoints) -> Source {
    let position = at(&point.position, lane);
    let height = times(simd, load(simd, &to.normal), position) - simd.f32(&to.offset);
    let height = height.max(simd.splat_f32(0.0)) * simd.splat_f32(point.area[lane]);
    Source {
        position,
        heights: height.lanes(),
    }
}

/// All pairs of a source and a target.
struct Pairs<'a> {
    plane: Plane,
    sources: &'a [Source],
    targets: &'a [Point<f32>],
    /// Of each lane, as in [`Distance`].
    nearest: Lanes<f32>,
    /// As in [`PointSum`].
    blocked: &'a [u8],
}

impl Pairs<'_> {
    /// Some may be `BLOCKED`; they may touch unless they are `APART`.
    #[inline(always)]
    fn sum<S: Simd, const BLOCKED: bool, const APART: bool>(self, simd: S) -> S::F32 {
        let offset = simd.splat_f32(self.plane.offset);
        let (zero, one) = (simd.splat_f32(0.0), simd.splat_f32(1.0));
        let nearest = simd.f32(&self.nearest);
        let nearest = nearest * nearest;
        let count = self.sources.len();
        let (pairs, rest) = self.sources.as_chunks::<2>();
        let mut total = zero;
        for (t, target) in self.targets.iter().enumerate() {
            let position = load(simd, &target.position);
            let height = (times(simd, position, self.plane.normal) - offset).max(zero);
            let height = height * simd.f32(&target.area);
            let blocked = match BLOCKED {
                true => &self.blocked[t * count..(t + 1) * count],
                false => &[],
            };
            let mut from_all = zero;
            for (k, [a, b]) in pairs.iter().enumerate() {
                let square_a = squared_distance::<S, APART>(simd, a, position, nearest);
                let square_b = squared_distance::<S, APART>(simd, b, position, nearest);
                // One division for two.
                let inverse = one / (square_a * square_b);
                let (per_a, per_b) = (inverse * square_b, inverse * square_a);
                let mut kernel_a = simd.f32(&a.heights) * (per_a * per_a);
                let mut kernel_b = simd.f32(&b.heights) * (per_b * per_b);
                if BLOCKED {
                    kernel_a = zero.select(blocked[2 * k], kernel_a);
                    kernel_b = zero.select(blocked[2 * k + 1], kernel_b);
                }
                from_all = from_all + (kernel_a + kernel_b);
            }
            if let [last] = rest {
                let per = one / squared_distance::<S, APART>(simd, last, position, nearest);
                let mut kernel = simd.f32(&last.heights) * (per * per);
                if BLOCKED {
                    kernel = zero.select(blocked[count - 1], kernel);
                }
                from_all = from_all + kernel;
            }
            total = total + height * from_all;
        }
        total
    }
}

/// Points that coincide count as infinitely far apart, as good as; those that are `APART` never do.
#[inline(always)]
fn squared_distance<S: Simd, const APART: bool>(
    simd: S,
    source: &Source,
    [x, y, z]: [S::F32; 3],
    nearest: S::F32,
) -> S::F32 {
    let [from_x, from_y, from_z] = source.position;
    let x = x - simd.splat_f32(from_x);
    let y = y - simd.splat_f32(from_y);
    let z = z - simd.splat_f32(from_z);
    let squared = x * x + y * y + z * z;
    if APART {
        return squared;
    }
    nearest.if_less(squared, squared, simd.splat_f32(INFINITE))
}
