//! The visible share of a pair, by pairs of points: for anything that may block.

use crate::blocker::Blocker;
use crate::target::{Points, Target, height, kernel, points};
use crate::visible::{Sampler, Shifts, Sums, coordinate};
use radiosity_geometry::Sight;
use radiosity_simd::{Float, Kernel, LANES, Simd, dispatch};
use std::ops::Range;

/// What may block a segment.
pub(crate) enum Blocked<'a> {
    /// These faces.
    By(&'a [Blocker]),
    /// Any face of the scene.
    Somehow(&'a Sight<'a>),
}

/// Segments between two patches.
pub(crate) struct Segments<'a> {
    pub(crate) targets: [&'a Target; 2],
    pub(crate) blocked: Blocked<'a>,
}

/// Some of them.
pub(crate) struct Measure<'a> {
    pub(crate) segments: &'a Segments<'a>,
    pub(crate) shifts: &'a Shifts,
    pub(crate) samples: Range<usize>,
    pub(crate) sums: &'a mut Sums,
}

impl Sampler for Segments<'_> {
    fn add(&self, samples: Range<usize>, shifts: &Shifts, sums: &mut Sums) {
        dispatch(Measure {
            segments: self,
            shifts,
            samples,
            sums,
        });
    }
}

impl Kernel for Measure<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Segments {
            targets: [i, j],
            blocked,
        } = self.segments;
        let mut all = simd.f64(&self.sums.all);
        let mut visible = simd.f64(&self.sums.visible);
        let mut squares = simd.f64(&self.sums.squares);
        let zero = simd.splat_f64(0.0);
        for k in self.samples {
            let u = coordinate(simd, k, 0, self.shifts);
            let v = coordinate(simd, k, 1, self.shifts);
            let p = points(simd, i, u, v);
            let u = coordinate(simd, k, 2, self.shifts);
            let v = coordinate(simd, k, 3, self.shifts);
            let q = points(simd, j, u, v);
            let weight = p.area * q.area * kernel(simd, (i, &p), (j, &q));
            let blocked = match blocked {
                Blocked::By(blockers) => cut_by_any(simd, blockers, &p, &q),
                Blocked::Somehow(sight) => blocked_somehow(sight, &p, &q, weight.lanes()),
            };
            all = all + weight;
            squares = squares + weight * weight;
            visible = visible + zero.select(blocked, weight);
        }
        self.sums.all = all.lanes();
        self.sums.visible = visible.lanes();
        self.sums.squares = squares.lanes();
    }
}

/// Which segments any of the blockers cuts.
#[inline(always)]
fn cut_by_any<S: Simd>(
    simd: S,
    blockers: &[Blocker],
    p: &Points<S::F64>,
    q: &Points<S::F64>,
) -> u8 {
    let mut blocked = 0;
    for blocker in blockers {
        blocked |= cuts(simd, blocker, p, q);
    }
    blocked
}

/// Which segments of any weight are blocked, one after the other.
#[inline(always)]
fn blocked_somehow<F: Float<f64>>(
    sight: &Sight<'_>,
    p: &Points<F>,
    q: &Points<F>,
    weights: [f64; LANES],
) -> u8 {
    let [p, q] = [p, q].map(Points::lanes);
    let mut blocked = 0;
    for lane in 0..LANES {
        let hidden = weights[lane] > 0.0 && sight.blocked(p[lane], q[lane]);
        blocked |= u8::from(hidden) << lane;
    }
    blocked
}

/// Which segments the blocker cuts: the ends lie on either side of its plane, and where the
/// segment crosses that, no edge is to the outside.
#[inline(always)]
fn cuts<S: Simd>(simd: S, blocker: &Blocker, p: &Points<S::F64>, q: &Points<S::F64>) -> u8 {
    let [plane, edges @ ..] = &blocker.planes;
    let zero = simd.splat_f64(0.0);
    let (at_p, at_q) = (height(simd, plane, p), height(simd, plane, q));
    let opposite = (at_p * at_q).less(zero);
    if opposite == 0 {
        return 0;
    }
    // Both have the sign of the height at q.
    let (across_p, across_q) = (at_q * at_q, -(at_p * at_q));
    let mut inside = opposite;
    for edge in edges {
        let at = height(simd, edge, p) * across_p + height(simd, edge, q) * across_q;
        inside &= zero.less_or_equal(at);
    }
    inside
}
