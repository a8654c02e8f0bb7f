//! The light from a point on a line, in closed form.

use crate::sampling::fan::Fan;
use crate::sampling::patch_sampler::{PatchSampler, SamplePoints, dot};
use radiosity_geometry::DVec3;
use radiosity_simd::{Float, Simd, angle};

/// Part of a line, in parameters between 0 and 1.
#[derive(Clone, Copy)]
pub(super) struct Interval<F> {
    pub(super) from: F,
    pub(super) to: F,
}

/// The kernel along a line, from a point: with `s` the parameter counted from the foot of the
/// perpendicular, `(constant + linear s) / (s^2 + distance^2)^2`.
pub(super) struct LineLight<F> {
    /// The parameter of the foot.
    foot: F,
    /// Squared distance from the line, in units of its length.
    squared: F,
    constant: F,
    linear: F,
    /// The part of the line in front of the point's patch.
    pub(super) bright: Interval<F>,
}

/// Lines nearer to a point than this times their length are that near: the light stays finite.
const NEAREST: f64 = 1e-10;

/// The light from a point on the line of a fan that has this length, in units of the longest.
#[inline(always)]
pub(super) fn light<S: Simd>(
    simd: S,
    (from, p): (&PatchSampler, &SamplePoints<S::F64>),
    (normal, fan): (DVec3, &Fan),
    length: S::F64,
) -> LineLight<S::F64> {
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
    LineLight {
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

impl<F: Float<f64>> LineLight<F> {
    /// The integral over an interval, by the antiderivatives of `s^n / (s^2 + d^2)^2`; their arcs
    /// combine to the angle that the interval subtends.
    #[inline(always)]
    pub(super) fn over<S: Simd<F64 = F>>(&self, simd: S, interval: Interval<F>) -> F {
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

    /// A place on the bright part of the line, and the light there times the derivative of the
    /// place: drawn by the sine of the angle from the foot, `s / sqrt(s^2 + distance^2)`.
    #[inline(always)]
    pub(super) fn at<S: Simd<F64 = F>>(&self, simd: S, way: F) -> (F, F) {
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

/// Leaves of an interval where a linear function of these values at 0 and 1 is positive.
#[inline(always)]
pub(super) fn clip<F: Float<f64>>(interval: &mut Interval<F>, at_start: F, at_end: F) {
    // Infinite where the function is constant, with its sign; no number where it is zero, and then
    // the least of that and anything is no number either: nothing is left.
    let root = at_start / (at_start - at_end);
    let Interval { from, to } = *interval;
    interval.from = at_start.if_less(at_end, from.max(root), from);
    interval.to = at_start.if_less(at_end, to, to.min(root));
}

#[cfg(test)]
mod tests;
