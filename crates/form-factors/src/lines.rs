//! The visible share of a pair, line by line: seen from a point on one patch, the shadows of
//! convex blockers on a line across the other are intervals, and what light passes between them is
//! known in closed form. What is left to sample is continuous but where a line runs along the edge of
//! a shadow, and needs far fewer samples than points do.

use crate::blocker::{Blocker, PLANES, Plane};
use crate::target::{Fan, Points, Target, dot, height, points};
use crate::visible::{Sampler, Shifts, coordinate};
use arrayvec::ArrayVec;
use radiosity_geometry::DVec3;
use radiosity_simd::{Float, Simd, angle};

/// More blockers are not worth sorting.
pub(crate) const MOST_BLOCKERS: usize = 8;

/// Lines across a patch, seen from points of another.
pub(crate) struct Lines<'a> {
    from: &'a Target,
    across: &'a Target,
    screens: ArrayVec<Screen, MOST_BLOCKERS>,
}

/// A blocker as lines across a patch see it: its planes.
struct Screen([Side; PLANES]);

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

impl<'a> Lines<'a> {
    /// There are at most [`MOST_BLOCKERS`].
    pub(crate) fn new(from: &'a Target, across: &'a Target, blockers: &[Blocker]) -> Lines<'a> {
        let mut lines = Lines {
            from,
            across,
            screens: ArrayVec::new(),
        };
        for blocker in blockers {
            lines.screens.push(Screen::new(blocker, across));
        }
        lines
    }
}

impl Screen {
    fn new(blocker: &Blocker, across: &Target) -> Screen {
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
        Screen(sides)
    }
}

/// Part of a line, in parameters between 0 and 1.
#[derive(Clone, Copy)]
struct Interval<F> {
    from: F,
    to: F,
}

/// The kernel along a line, from a point: with `s` the parameter counted from the foot of the
/// perpendicular, `(constant + linear s) / (s^2 + distance^2)^2`.
struct Light<F> {
    /// The parameter of the foot.
    foot: F,
    /// Squared distance from the line, in units of its length.
    squared: F,
    constant: F,
    linear: F,
    /// The part of the line in front of the point's patch.
    bright: Interval<F>,
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
        // Of the longest line; one without length would have no foot.
        let length = coordinate(simd, k, 2, shifts).max(simd.splat_f64(SHORTEST));
        let (mut all, mut visible) = (zero, zero);
        for (number, fan) in self.across.fans.iter().enumerate() {
            let light = light(simd, (self.from, &p), (self.across.normal, fan), length);
            let mut shadows = [nothing; MOST_BLOCKERS];
            for (shadow, screen) in shadows.iter_mut().zip(&self.screens) {
                *shadow = shadow_of(simd, screen, &p, (number, length), light.bright);
            }
            let hidden = light_in_union(simd, &mut shadows[..self.screens.len()], &light);
            let total = light.over(simd, light.bright);
            all = all + total;
            visible = visible + (total - hidden);
        }
        [p.area * all, p.area * visible]
    }

    /// The shadow of a corner that no line has met is small among lines, and on each of them.
    fn unseen(&self, share: f64) -> f64 {
        let share = share / self.across.fans.len() as f64;
        share * libm::cbrt(share)
    }
}

/// Lines are at least so long, in units of the longest.
const SHORTEST: f64 = 1e-50;
/// Lines nearer to a point than this times their length are that near: the light stays finite.
const NEAREST: f64 = 1e-10;

/// The light from a point on the line of a fan that has this length, in units of the longest.
#[inline(always)]
fn light<S: Simd>(
    simd: S,
    (from, p): (&Target, &Points<S::F64>),
    (normal, fan): (DVec3, &Fan),
    length: S::F64,
) -> Light<S::F64> {
    let zero = simd.splat_f64(0.0);
    let [start, end] = [splat(simd, fan.sides[0]), splat(simd, fan.sides[1])];
    let apex = splat(simd, fan.apex);
    let to_start = [
        apex[0] - p.x + length * start[0],
        apex[1] - p.y + length * start[1],
        apex[2] - p.z + length * start[2],
    ];
    let along = [
        length * (end[0] - start[0]),
        length * (end[1] - start[1]),
        length * (end[2] - start[2]),
    ];
    let [x, y, z] = to_start;
    let from_plane = dot(simd, from.normal, x, y, z);
    let height_of_p = (-dot(simd, normal, x, y, z)).max(zero);
    let [x, y, z] = along;
    let slope = dot(simd, from.normal, x, y, z);
    let square = product(along, along);
    let foot = -(product(to_start, along) / square);
    let squared = product(to_start, to_start) / square - foot * foot;
    let mut bright = Interval {
        from: zero,
        to: simd.splat_f64(1.0),
    };
    clip(&mut bright, from_plane, from_plane + slope);
    bright.to = bright.to.max(bright.from);
    // The area that stands for a piece of the line goes with its length.
    let area = simd.splat_f64(fan.area) * length;
    let scale = height_of_p * area / (square * square);
    Light {
        foot,
        squared: squared.max(simd.splat_f64(NEAREST * NEAREST)),
        constant: scale * (from_plane + slope * foot),
        linear: scale * slope,
        bright,
    }
}

#[inline(always)]
fn splat<S: Simd>(simd: S, v: DVec3) -> [S::F64; 3] {
    [
        simd.splat_f64(v.x),
        simd.splat_f64(v.y),
        simd.splat_f64(v.z),
    ]
}

#[inline(always)]
fn product<F: Float<f64>>(a: [F; 3], b: [F; 3]) -> F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
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

impl<F: Float<f64>> Light<F> {
    /// The integral over an interval, by the antiderivatives of `s^n / (s^2 + d^2)^2`; their arcs
    /// combine to the angle that the interval subtends.
    #[inline(always)]
    fn over<S: Simd<F64 = F>>(&self, simd: S, interval: Interval<F>) -> F {
        let (half, one) = (simd.splat_f64(0.5), simd.splat_f64(1.0));
        let (from, to) = (interval.from - self.foot, interval.to - self.foot);
        let distance = self.squared.sqrt();
        let (at_from, at_to) = (
            one / (from * from + self.squared),
            one / (to * to + self.squared),
        );
        let angle = angle(simd, distance * (to - from), self.squared + from * to);
        let arc = angle / distance;
        let rational = to * at_to - from * at_from;
        half * (self.constant * (arc + rational) / self.squared + self.linear * (at_from - at_to))
    }
}

/// The part of a line, of a fan and of this length, that a screen hides from a point: where a few
/// functions that are linear along the line are all positive.
#[inline(always)]
fn shadow_of<S: Simd>(
    simd: S,
    Screen([front, edges @ ..]): &Screen,
    p: &Points<S::F64>,
    (fan, length): (usize, S::F64),
    bright: Interval<S::F64>,
) -> Interval<S::F64> {
    let at_p = height(simd, &front.plane, p);
    let [at_start, at_end] = front.fans[fan].of_line(simd, length);
    let across_start = -(at_p * at_start);
    let across_end = -(at_p * at_end);
    let mut shadow = bright;
    clip(&mut shadow, across_start, across_end);
    let squared = at_p * at_p;
    for edge in edges {
        let edge_at_p = height(simd, &edge.plane, p);
        let [at_start, at_end] = edge.fans[fan].of_line(simd, length);
        let start = edge_at_p * across_start + at_start * squared;
        let end = edge_at_p * across_end + at_end * squared;
        clip(&mut shadow, start, end);
    }
    // An interval that ends before it begins is none.
    let beyond = simd.splat_f64(BEYOND);
    let Interval { from, to } = shadow;
    Interval {
        from: from.if_less(to, from, beyond),
        to: from.if_less(to, to, beyond),
    }
}

/// Leaves of an interval where a linear function of these values at 0 and 1 is positive.
#[inline(always)]
fn clip<F: Float<f64>>(interval: &mut Interval<F>, at_start: F, at_end: F) {
    // Infinite where the function is constant, with its sign; no number where it is zero, and then
    // the least of that and anything is no number either: nothing is left.
    let root = at_start / (at_start - at_end);
    let Interval { from, to } = *interval;
    interval.from = at_start.if_less(at_end, from.max(root), from);
    interval.to = at_start.if_less(at_end, to, to.min(root));
}

/// Intervals that are none stand here, where sorting leaves them last.
const BEYOND: f64 = 2.0;
/// Intervals this near to each other are one: shadows of faces that share an edge.
const TOUCHING: f64 = 1e-12;

/// The integral over the union of intervals.
#[inline(always)]
fn light_in_union<S: Simd>(
    simd: S,
    intervals: &mut [Interval<S::F64>],
    light: &Light<S::F64>,
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

#[cfg(test)]
mod tests;
