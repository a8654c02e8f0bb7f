//! The visible share of a pair, by pairs of points: for anything that may block.

use crate::blocker::Blocker;
use crate::target::{Points, Target, height, kernel, points};
use crate::visible::{Sampler, Shifts, coordinate};
use radiosity_geometry::{Bundle, FaceId, Occluders};
use radiosity_simd::{Float, LANES, Simd};

/// What may block a segment.
pub(crate) enum Blocked<'a> {
    /// These faces.
    By(&'a [Blocker]),
    /// Any face of the scene but these, on which the segments end.
    Somehow(&'a Occluders, [FaceId; 2]),
}

/// Segments between two patches.
pub(crate) struct Segments<'a> {
    pub(crate) targets: [&'a Target; 2],
    pub(crate) blocked: Blocked<'a>,
}

impl Sampler for Segments<'_> {
    #[inline(always)]
    fn sample<S: Simd>(&self, simd: S, k: usize, shifts: &Shifts) -> [S::F64; 2] {
        let [i, j] = self.targets;
        let (u, v) = (
            coordinate(simd, k, 0, shifts),
            coordinate(simd, k, 1, shifts),
        );
        let p = points(simd, i, u, v);
        let (u, v) = (
            coordinate(simd, k, 2, shifts),
            coordinate(simd, k, 3, shifts),
        );
        let q = points(simd, j, u, v);
        let weight = p.area * q.area * kernel(simd, (i, &p), (j, &q));
        let blocked = match self.blocked {
            Blocked::By(blockers) => cut_by_any(simd, blockers, &p, &q),
            Blocked::Somehow(occluders, faces) => {
                let bundle = Bundle {
                    points: [p.lanes(), q.lanes()],
                    faces: faces.map(|face| [face; LANES]),
                };
                occluders.blocked_of(&bundle, simd.splat_f64(0.0).less(weight))
            }
        };
        [weight, simd.splat_f64(0.0).select(blocked, weight)]
    }

    /// Anything that is smaller than what one sample stands for.
    fn unseen(&self, share: f64) -> f64 {
        share
    }
}

/// All lanes.
const ALL: u8 = !0;

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
        if blocked == ALL {
            break;
        }
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
