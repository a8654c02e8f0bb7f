//! The shadows of blockers on a line, seen from a point: intervals, of which what is in any counts
//! once.

use super::light::{Interval, LineLight, clip};
use crate::culling::blocker::{Blocker, PLANES, Plane};
use crate::sampling::patch_sampler::{PatchSampler, SamplePoints, height};
use radiosity_simd::{Float, Simd};

/// A blocker as lines across a patch see it: its planes.
pub(super) struct BlockerSides([Side; PLANES]);

/// A plane, and the heights of each fan over it.
#[derive(Clone, Copy, Default)]
struct Side {
    plane: Plane,
    fans: [Heights; 2],
}

/// The heights over a plane of a fan's apex, and how those of the starts and the ends of lines
/// differ from it where lines are longest.
#[derive(Clone, Copy, Default)]
struct Heights {
    apex: f64,
    sides: [f64; 2],
}

impl BlockerSides {
    pub(super) fn new(blocker: &Blocker, across: &PatchSampler) -> BlockerSides {
        let mut sides = [Side::default(); PLANES];
        for (side, plane) in sides.iter_mut().zip(&blocker.planes) {
            side.plane = *plane;
            for (heights, fan) in side.fans.iter_mut().zip(&across.fans) {
                let [start, end] = fan.sides;
                *heights = Heights {
                    apex: plane.height(fan.apex),
                    sides: [plane.normal.dot(start), plane.normal.dot(end)],
                };
            }
        }
        BlockerSides(sides)
    }
}

impl Heights {
    /// Of the start and the end of a line of this length.
    #[inline(always)]
    fn of_line<S: Simd>(&self, simd: S, length: S::F64) -> [S::F64; 2] {
        let apex = simd.splat_f64(self.apex);
        let [start, end] = self.sides;
        [
            apex + length * simd.splat_f64(start),
            apex + length * simd.splat_f64(end),
        ]
    }
}

/// The part of a line, of a fan and of this length, that a screen hides from a point: where a few
/// functions that are linear along the line are all positive. `None` if that is nothing in any
/// lane.
#[inline(always)]
pub(super) fn shadow_of<S: Simd>(
    simd: S,
    BlockerSides([front, edges @ ..]): &BlockerSides,
    p: &SamplePoints<S::F64>,
    (fan, length): (usize, S::F64),
    bright: Interval<S::F64>,
) -> Option<Interval<S::F64>> {
    let at_p = height(simd, &front.plane, p);
    let [at_start, at_end] = front.fans[fan].of_line(simd, length);
    let across_start = -(at_p * at_start);
    let across_end = -(at_p * at_end);
    let mut shadow = bright;
    clip(&mut shadow, across_start, across_end);
    let squared = at_p * at_p;
    for edge in edges {
        if shadow.from.less(shadow.to) == 0 {
            return None;
        }
        let edge_at_p = height(simd, &edge.plane, p);
        let [at_start, at_end] = edge.fans[fan].of_line(simd, length);
        let start = edge_at_p * across_start + at_start * squared;
        let end = edge_at_p * across_end + at_end * squared;
        clip(&mut shadow, start, end);
    }
    // An interval that ends before it begins is none.
    let beyond = simd.splat_f64(BEYOND);
    let Interval { from, to } = shadow;
    (from.less(to) != 0).then_some(Interval {
        from: from.if_less(to, from, beyond),
        to: from.if_less(to, to, beyond),
    })
}

/// Intervals that are none stand here, where sorting leaves them last.
const BEYOND: f64 = 2.0;
/// Intervals this near to each other are one: shadows of faces that share an edge.
const TOUCHING: f64 = 1e-12;

/// The integral over the union of intervals.
#[inline(always)]
pub(super) fn light_in_union<S: Simd>(
    simd: S,
    intervals: &mut [Interval<S::F64>],
    light: &LineLight<S::F64>,
) -> S::F64 {
    sort(intervals);
    let (zero, touching) = (simd.splat_f64(0.0), simd.splat_f64(TOUCHING));
    let mut covered = zero;
    let Some((&first, others)) = intervals.split_first() else {
        return covered;
    };
    let mut union = first;
    for next in others {
        let is_some = next.from.less(next.to);
        if is_some == 0 {
            break;
        }
        let apart = (union.to + touching).less(next.from) & is_some;
        if apart != 0 {
            covered = covered + light.over(simd, union).select(apart, zero);
            union.from = next.from.select(apart, union.from);
            union.to = next.to.select(apart, union.to);
        }
        union.to = next.from.if_less(next.to, union.to.max(next.to), union.to);
    }
    covered + light.over(simd, union)
}

/// Sorts intervals by where they begin, lane by lane.
#[inline(always)]
fn sort<F: Float<f64>>(intervals: &mut [Interval<F>]) {
    for last in (1..intervals.len()).rev() {
        for k in 0..last {
            let (a, b) = (intervals[k], intervals[k + 1]);
            intervals[k] = Interval {
                from: b.from.if_less(a.from, b.from, a.from),
                to: b.from.if_less(a.from, b.to, a.to),
            };
            intervals[k + 1] = Interval {
                from: b.from.if_less(a.from, a.from, b.from),
                to: b.from.if_less(a.from, a.to, b.to),
            };
        }
    }
}
