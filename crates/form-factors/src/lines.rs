//! The visible share of a pair, line by line: seen from a point on one patch, the shadows of
//! convex blockers on a line across the other are intervals, found exactly. What is left to sample
//! is continuous, and needs far fewer samples than points do.
//!
//! Along a line the kernel is replaced by the parabola through three of its values, so this is
//! for patches that are not too near, and wholly in front of each other: see [`bias`].

use crate::blocker::Blocker;
use crate::target::{Points, Target, at, height, kernel, points};
use crate::visible::{Sampler, Shifts, coordinate};
use radiosity_simd::{Float, Simd};

/// More blockers are not worth sorting.
pub(crate) const MOST_BLOCKERS: usize = 8;

/// By how much parabolas at most change a share, by the ratio of the radius of the patch that lines
/// cross to its least distance from a point of the other. Of third order, as a parabola leaves it;
/// the constant is for lines that lead away from the point (the worst of random pairs takes three
/// quarters of it), opposed patches have much less.
pub(crate) fn bias(ratio: f64) -> f64 {
    2.0 * ratio * ratio * ratio
}

/// Lines across a patch, seen from points of another.
pub(crate) struct Lines<'a> {
    pub(crate) from: &'a Target,
    pub(crate) across: &'a Target,
    /// At most [`MOST_BLOCKERS`].
    pub(crate) blockers: &'a [Blocker],
}

/// Where the kernel is evaluated: Gauss's three points.
const NODES: [f64; 3] = [0.112_701_665_379_258_3, 0.5, 0.887_298_334_620_741_7];

/// Part of a line, in parameters between 0 and 1.
#[derive(Clone, Copy)]
struct Interval<F> {
    from: F,
    to: F,
}

/// A line across a patch.
struct Line<F> {
    start: Points<F>,
    end: Points<F>,
}

/// The antiderivative of a parabola, without its constant.
struct Antiderivative<F> {
    linear: F,
    square: F,
    cube: F,
}

impl Sampler for Lines<'_> {
    #[inline(always)]
    fn sample<S: Simd>(&self, simd: S, k: usize, shifts: &Shifts) -> [S::F64; 2] {
        let zero = simd.splat_f64(0.0);
        let nothing = Interval {
            from: zero,
            to: zero,
        };
        let (u, v) = (
            coordinate(simd, k, 0, shifts),
            coordinate(simd, k, 1, shifts),
        );
        let p = points(simd, self.from, u, v);
        let line = line(simd, self.across, coordinate(simd, k, 2, shifts));
        let light = light(simd, (self.from, &p), (self.across, &line));
        let mut shadows = [nothing; MOST_BLOCKERS];
        for (shadow, blocker) in shadows.iter_mut().zip(self.blockers) {
            *shadow = shadow_of(simd, blocker, &p, &line);
        }
        let hidden = light_in_union(simd, &mut shadows[..self.blockers.len()], &light);
        let total = light.at(simd.splat_f64(1.0));
        [p.area * total, p.area * (total - hidden)]
    }
}

/// The line on which the first parameter is `u`; on triangles it is the shorter the larger `u`.
#[inline(always)]
fn line<S: Simd>(simd: S, target: &Target, u: S::F64) -> Line<S::F64> {
    let one = simd.splat_f64(1.0);
    let last = if target.is_triangle { one - u } else { one };
    let mut line = Line {
        start: at(simd, target, u, simd.splat_f64(0.0)),
        end: at(simd, target, u, last),
    };
    // The area that stands for a piece of the line goes with its length.
    line.start.area = line.start.area * last;
    line.end.area = line.end.area * last;
    line
}

/// The kernel along a line, from a point, as a parabola.
#[inline(always)]
fn light<S: Simd>(
    simd: S,
    (from, p): (&Target, &Points<S::F64>),
    (across, line): (&Target, &Line<S::F64>),
) -> Antiderivative<S::F64> {
    let mut values = [simd.splat_f64(0.0); 3];
    for (value, node) in values.iter_mut().zip(NODES) {
        let q = between(simd, line, node);
        *value = q.area * kernel(simd, (from, p), (across, &q));
    }
    let [a, b, c] = values;
    // Newton's form about the middle node, expanded.
    let half = NODES[1] - NODES[0];
    let slope = (c - a) * simd.splat_f64(0.5 / half);
    let curve = (a - b - b + c) * simd.splat_f64(0.5 / (half * half));
    let middle = simd.splat_f64(NODES[1]);
    Antiderivative {
        linear: b - slope * middle + curve * middle * middle,
        square: (slope - curve * (middle + middle)) * simd.splat_f64(0.5),
        cube: curve * simd.splat_f64(1.0 / 3.0),
    }
}

impl<F: Float<f64>> Antiderivative<F> {
    #[inline(always)]
    fn at(&self, t: F) -> F {
        t * (self.linear + t * (self.square + t * self.cube))
    }
}

/// The point of a line at a parameter.
#[inline(always)]
fn between<S: Simd>(simd: S, line: &Line<S::F64>, parameter: f64) -> Points<S::F64> {
    let (a, b) = (simd.splat_f64(1.0 - parameter), simd.splat_f64(parameter));
    let (start, end) = (&line.start, &line.end);
    Points {
        x: a * start.x + b * end.x,
        y: a * start.y + b * end.y,
        z: a * start.z + b * end.z,
        area: a * start.area + b * end.area,
    }
}

/// The part of a line that a blocker hides from a point: where a few functions that are linear
/// along the line are all positive.
#[inline(always)]
fn shadow_of<S: Simd>(
    simd: S,
    blocker: &Blocker,
    p: &Points<S::F64>,
    line: &Line<S::F64>,
) -> Interval<S::F64> {
    let [plane, edges @ ..] = &blocker.planes;
    let at_p = height(simd, plane, p);
    let across_start = -(at_p * height(simd, plane, &line.start));
    let across_end = -(at_p * height(simd, plane, &line.end));
    let mut shadow = Interval {
        from: simd.splat_f64(0.0),
        to: simd.splat_f64(1.0),
    };
    clip(simd, &mut shadow, across_start, across_end);
    let squared = at_p * at_p;
    for edge in edges {
        let edge_at_p = height(simd, edge, p);
        let start = edge_at_p * across_start + height(simd, edge, &line.start) * squared;
        let end = edge_at_p * across_end + height(simd, edge, &line.end) * squared;
        clip(simd, &mut shadow, start, end);
    }
    // An interval that ends before it begins is none.
    shadow.to = shadow.to.max(shadow.from);
    shadow
}

/// Leaves of an interval where a linear function of these values at 0 and 1 is positive.
#[inline(always)]
fn clip<S: Simd>(simd: S, interval: &mut Interval<S::F64>, at_start: S::F64, at_end: S::F64) {
    let zero = simd.splat_f64(0.0);
    let (not_start, not_end) = (at_start.less_or_equal(zero), at_end.less_or_equal(zero));
    let root = at_start / (at_start - at_end);
    let nowhere = simd.splat_f64(2.0);
    let from = nowhere.select(not_start & not_end, root.select(not_start & !not_end, zero));
    let to = root.select(not_end & !not_start, simd.splat_f64(1.0));
    interval.from = interval.from.max(from);
    interval.to = interval.to.min(to);
}

/// The integral over the union of intervals.
#[inline(always)]
fn light_in_union<S: Simd>(
    simd: S,
    intervals: &mut [Interval<S::F64>],
    light: &Antiderivative<S::F64>,
) -> S::F64 {
    sort(intervals);
    let mut covered = simd.splat_f64(0.0);
    let mut reached = simd.splat_f64(0.0);
    let one = simd.splat_f64(1.0);
    for interval in intervals.iter() {
        // Intervals that are none begin and end beyond the line.
        let from = interval.from.max(reached).min(one);
        let to = interval.to.min(one).max(from);
        covered = covered + (light.at(to) - light.at(from));
        reached = to;
    }
    covered
}

/// Sorts intervals by where they begin, lane by lane.
#[inline(always)]
fn sort<F: Float<f64>>(intervals: &mut [Interval<F>]) {
    for last in (1..intervals.len()).rev() {
        for k in 0..last {
            let (a, b) = (intervals[k], intervals[k + 1]);
            let swap = b.from.less(a.from);
            intervals[k] = Interval {
                from: b.from.select(swap, a.from),
                to: b.to.select(swap, a.to),
            };
            intervals[k + 1] = Interval {
                from: a.from.select(swap, b.from),
                to: a.to.select(swap, b.to),
            };
        }
    }
}

#[cfg(test)]
mod tests;
