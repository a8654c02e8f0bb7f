//! The kernel of the form factor, summed over the points of a patch and of eight others.

use crate::samples::{Lanes, Local, LocalPoint};
use radiosity_simd::{Float, Kernel, Simd};

/// The sum over all pairs of points of a patch and each of eight others: their exchange, in units
/// of the total area.
///
/// With `d` the vector between two points and `h` the height of either over the other's plane, the
/// kernel is `h_i h_j / (pi d^4)`. Heights over planes are linear, so each is found once a point.
pub(crate) struct Transfer<'a> {
    /// A tile, and which of its patches is meant.
    pub(crate) from: (&'a Local, usize),
    pub(crate) to: &'a Local,
    /// By point of `to` and point of `from`: one bit per lane. Nothing if nothing is blocked.
    pub(crate) blocked: Option<&'a [u8]>,
    pub(crate) sources: &'a mut Vec<Source>,
}

/// A point of the patch as the others see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source {
    position: [f32; 3],
    /// Over the others' planes, times the area that the point stands for.
    heights: Lanes<f32>,
}

/// Points nearer than this, in units of the scene's extent, exchange nothing: where patches cross and
/// points coincide, heights are rounding.
const NEAREST: f32 = 1e-6;
/// Squared: as good as infinitely far, but two such squares still have a product.
const FAR: f32 = 1e18;

impl Kernel for Transfer<'_> {
    type Output = Lanes<f32>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Lanes<f32> {
        let (from, lane) = self.from;
        self.sources.clear();
        for point in &from.points {
            self.sources.push(source(simd, (point, lane), self.to));
        }
        let plane = plane(from, lane);
        let sum = match self.blocked {
            None => sum::<S, false>(simd, plane, self.sources, &self.to.points, &[]),
            Some(blocked) => sum::<S, true>(simd, plane, self.sources, &self.to.points, blocked),
        };
        sum.lanes()
    }
}

#[inline(always)]
fn source<S: Simd>(simd: S, (point, lane): (&LocalPoint, usize), to: &Local) -> Source {
    let position = point.position.map(|axis| axis[lane]);
    let [nx, ny, nz] = to.normal;
    let [x, y, z] = position;
    let height = simd.f32(&nx) * simd.splat_f32(x)
        + simd.f32(&ny) * simd.splat_f32(y)
        + simd.f32(&nz) * simd.splat_f32(z)
        - simd.f32(&to.offset);
    let height = height.max(simd.splat_f32(0.0)) * simd.splat_f32(point.area[lane]);
    Source {
        position,
        heights: height.lanes(),
    }
}

/// The normal of a patch, and its plane's offset.
fn plane(of: &Local, lane: usize) -> [f32; 4] {
    let [x, y, z] = of.normal.map(|axis| axis[lane]);
    [x, y, z, of.offset[lane]]
}

#[inline(always)]
fn sum<S: Simd, const MARKED: bool>(
    simd: S,
    plane: [f32; 4],
    sources: &[Source],
    targets: &[LocalPoint],
    blocked: &[u8],
) -> S::F32 {
    let [nx, ny, nz] = [plane[0], plane[1], plane[2]];
    let (nx, ny, nz) = (simd.splat_f32(nx), simd.splat_f32(ny), simd.splat_f32(nz));
    let offset = simd.splat_f32(plane[3]);
    let (zero, one) = (simd.splat_f32(0.0), simd.splat_f32(1.0));
    let (pairs, rest) = sources.as_chunks::<2>();
    let mut total = zero;
    for (t, target) in targets.iter().enumerate() {
        let [x, y, z] = &target.position;
        let (x, y, z) = (simd.f32(x), simd.f32(y), simd.f32(z));
        let height = (nx * x + ny * y + nz * z - offset).max(zero) * simd.f32(&target.area);
        let blocked = if MARKED {
            &blocked[t * sources.len()..(t + 1) * sources.len()]
        } else {
            &[]
        };
        let mut from_all = zero;
        for (k, [a, b]) in pairs.iter().enumerate() {
            let square_a = squared_distance(simd, a, [x, y, z]);
            let square_b = squared_distance(simd, b, [x, y, z]);
            // One division for two.
            let inverse = one / (square_a * square_b);
            let (per_a, per_b) = (inverse * square_b, inverse * square_a);
            let mut kernel_a = simd.f32(&a.heights) * (per_a * per_a);
            let mut kernel_b = simd.f32(&b.heights) * (per_b * per_b);
            if MARKED {
                kernel_a = zero.select(blocked[2 * k], kernel_a);
                kernel_b = zero.select(blocked[2 * k + 1], kernel_b);
            }
            from_all = from_all + (kernel_a + kernel_b);
        }
        if let [last] = rest {
            let per = one / squared_distance(simd, last, [x, y, z]);
            let mut kernel = simd.f32(&last.heights) * (per * per);
            if MARKED {
                kernel = zero.select(blocked[sources.len() - 1], kernel);
            }
            from_all = from_all + kernel;
        }
        total = total + height * from_all;
    }
    total
}

#[inline(always)]
fn squared_distance<S: Simd>(simd: S, source: &Source, [x, y, z]: [S::F32; 3]) -> S::F32 {
    let [from_x, from_y, from_z] = source.position;
    let x = x - simd.splat_f32(from_x);
    let y = y - simd.splat_f32(from_y);
    let z = z - simd.splat_f32(from_z);
    let squared = x * x + y * y + z * z;
    let apart = simd.splat_f32(NEAREST * NEAREST).less(squared);
    squared.select(apart, simd.splat_f32(FAR))
}
