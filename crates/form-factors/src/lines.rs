//! The visible share of a pair, line by line: seen from a point on one patch, the shadows of
//! convex blockers on a line across the other are intervals, and what light passes between them is
//! known in closed form. What is left to sample is continuous but where a line runs along the edge of
//! a shadow, and needs far fewer samples than points do.
//!
//! Lines are drawn by the angle at which the point sees them (`fan.rs`), and so the integrand is
//! bounded, even where the patches touch: with `rho` the distance of the line, `beta` the angle from its foot
//! and `phi` that around an axis through the point parallel to it, the solid angle is
//! `cos beta d beta d phi`.

use crate::blocker::{Blocker, PLANES, Plane};
use crate::fan::Fan;
use crate::lattice::Lattice;
use crate::target::{Points, Target, dot, height, points};
use crate::visible::Sampler;
use arrayvec::ArrayVec;
use radiosity_geometry::{Bundle, DVec3, FaceId, Occluders, Polygon};
use radiosity_simd::{Float, LANES, Simd, angle};

/// At most so many blockers are listed.
pub(crate) const MOST_BLOCKERS: usize = 64;

/// What may stand in the way.
pub(crate) enum Blocked<'a> {
    /// These faces.
    By(&'a [Blocker]),
    /// Any face of the scene but these, on which the patches lie.
    Somehow(&'a Occluders, [FaceId; 2]),
}

/// Lines across a patch, seen from points of another.
pub(crate) struct Lines<'a> {
    /// The points' patch, in quads and triangles.
    from: ArrayVec<Target, MOST_PIECES>,
    across: Target,
    screens: Vec<Screen>,
    tree: Option<(&'a Occluders, [FaceId; 2])>,
}

/// A polygon of eight corners is as many quads.
const MOST_PIECES: usize = 3;

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
    /// From the points of a convex polygon with a normal across a patch.
    pub(crate) fn new(from: (&[DVec3], DVec3), across: Target, blocked: &Blocked<'a>) -> Lines<'a> {
        let (screens, tree) = match *blocked {
            Blocked::By(blockers) => {
                let blockers = blockers.iter();
                (blockers.map(|b| Screen::new(b, &across)).collect(), None)
            }
            Blocked::Somehow(occluders, faces) => (Vec::new(), Some((occluders, faces))),
        };
        Lines {
            from: pieces(from.0, from.1),
            across,
            screens,
            tree,
        }
    }
}

/// A convex polygon cut into quads and a triangle, all of which have its first corner.
fn pieces(corners: &[DVec3], normal: DVec3) -> ArrayVec<Target, MOST_PIECES> {
    let piece = |k: usize| match corners[k..] {
        [b, c, d, ..] => Polygon::quad([corners[0], b, c, d]),
        _ => Polygon::triangle([corners[0], corners[k], corners[k + 1]]),
    };
    let firsts = (1..corners.len() - 1).step_by(2);
    firsts.map(|k| Target::new(&piece(k), normal)).collect()
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
    fn pieces(&self) -> usize {
        self.from.len()
    }

    fn coordinates(&self) -> usize {
        match self.tree {
            None => 3,
            Some(_) => 4,
        }
    }

    #[inline(always)]
    fn sample<S: Simd>(&self, simd: S, k: usize, piece: usize, lattice: &Lattice) -> [S::F64; 2] {
        let zero = simd.splat_f64(0.0);
        let (u, v) = (
            lattice.coordinate(simd, k, 0),
            lattice.coordinate(simd, k, 1),
        );
        let from = &self.from[piece];
        let p = points(simd, from, u, v);
        let turn = lattice.coordinate(simd, k, 2);
        let (mut all, mut visible) = (zero, zero);
        for (number, fan) in self.across.fans.iter().enumerate() {
            let [length, density] = fan.line(simd, &p, turn);
            let length = length.max(simd.splat_f64(SHORTEST));
            let density = density * p.area;
            let light = light(simd, (from, &p), (self.across.normal, fan), length);
            let [total, seen] = match self.tree {
                None => {
                    let hidden = self.hidden(simd, &p, (number, length), &light);
                    let total = light.over(simd, light.bright);
                    [total, total - hidden]
                }
                Some(tree) => {
                    let along = lattice.coordinate(simd, k, 3);
                    let (at, light) = light.at(simd, along);
                    let q = fan.place(simd, length, at);
                    let blocked = blocked(simd, tree, &p, &q, zero.less(light));
                    [light, zero.select(blocked, light)]
                }
            };
            all = all + density * total;
            visible = visible + density * seen;
        }
        [all, visible]
    }

    fn unseen(&self, share: f64) -> f64 {
        match self.tree {
            // The shadow of a corner that no line has met is small among lines, and on each of them.
            None => {
                let share = share / self.across.fans.len() as f64;
                share * libm::cbrt(share)
            }
            // Anything that is smaller than what one sample stands for.
            Some(_) => share,
        }
    }
}

impl Lines<'_> {
    /// The light that blockers take away, of that on the line of a fan that has this length.
    #[inline(always)]
    fn hidden<S: Simd>(
        &self,
        simd: S,
        p: &Points<S::F64>,
        line: (usize, S::F64),
        light: &Light<S::F64>,
    ) -> S::F64 {
        let mut shadows: ArrayVec<Interval<S::F64>, MOST_BLOCKERS> = ArrayVec::new();
        for screen in &self.screens {
            if let Some(shadow) = shadow_of(simd, screen, p, line, light.bright) {
                shadows.push(shadow);
            }
        }
        light_in_union(simd, &mut shadows, light)
    }
}

/// Which segments the tree of all faces says are blocked, of those that matter.
#[inline(always)]
fn blocked<S: Simd>(
    _: S,
    (occluders, faces): (&Occluders, [FaceId; 2]),
    p: &Points<S::F64>,
    q: &[S::F64; 3],
    which: u8,
) -> u8 {
    let [x, y, z] = *q;
    let bundle = Bundle {
        points: [p.lanes(), [x.lanes(), y.lanes(), z.lanes()]],
        faces: faces.map(|face| [face; LANES]),
    };
    occluders.blocked_of(&bundle, which)
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

    /// Of the angle from the foot to a place, seen from the point.
    #[inline(always)]
    fn sine(&self, place: F) -> F {
        let s = place - self.foot;
        s / (s * s + self.squared).sqrt()
    }

    /// A place on the bright part of the line, and the light there times the derivative of the place: drawn by
    /// the sine of the angle from the foot, `s / sqrt(s^2 + distance^2)`.
    #[inline(always)]
    fn at<S: Simd<F64 = F>>(&self, simd: S, way: F) -> (F, F) {
        let one = simd.splat_f64(1.0);
        let distance = self.squared.sqrt();
        let [from, to] = [self.sine(self.bright.from), self.sine(self.bright.to)];
        let extent = to - from;
        let sine = from + way * extent;
        let cosine = ((one - sine) * (one + sine)).sqrt();
        let light = self.constant * cosine + self.linear * (distance * sine);
        (
            self.foot + distance * (sine / cosine),
            light * extent / (self.squared * distance),
        )
    }
}

/// The part of a line, of a fan and of this length, that a screen hides from a point: where a few
/// functions that are linear along the line are all positive. `None` if that is nothing in any lane.
#[inline(always)]
fn shadow_of<S: Simd>(
    simd: S,
    Screen([front, edges @ ..]): &Screen,
    p: &Points<S::F64>,
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
