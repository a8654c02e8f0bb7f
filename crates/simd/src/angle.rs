//! Arcs, eight at a time.

use crate::{Float, Simd};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// Above this the argument is turned by an eighth.
const STEEP: f64 = 0.66;
/// `atan(x) = x + x^3 P(x^2) / Q(x^2)` up to `STEEP`, to 2e-16 (Moshier, Cephes, 1995).
const P: [f64; 5] = [
    -8.750_608_600_031_904e-1,
    -1.615_753_718_733_365e1,
    -7.500_855_792_314_705e1,
    -1.228_866_684_490_136_2e2,
    -6.485_021_904_942_025e1,
];
const Q: [f64; 6] = [
    1.0,
    2.485_846_490_142_306_3e1,
    1.650_270_098_316_988_5e2,
    4.328_810_604_912_903e2,
    4.853_903_996_359_137e2,
    1.945_506_571_482_614e2,
];

/// The angle from the positive x axis to the point `(x, y)`, with `y` not negative: from 0 to pi.
#[inline(always)]
pub fn angle<S: Simd>(simd: S, y: S::F64, x: S::F64) -> S::F64 {
    let zero = simd.splat_f64(0.0);
    let wide = x.max(-x);
    let (low, high) = (y.min(wide), y.max(wide));
    let edge = high * simd.splat_f64(STEEP);
    let rise = edge.if_less(low, low - high, low);
    let run = edge.if_less(low, low + high, high);
    let small = arctangent(simd, rise / run);
    let acute = edge.if_less(low, small + simd.splat_f64(FRAC_PI_4), small);
    let acute = wide.if_less(y, simd.splat_f64(FRAC_PI_2) - acute, acute);
    x.if_less(zero, simd.splat_f64(PI) - acute, acute)
}

#[inline(always)]
fn arctangent<S: Simd>(simd: S, x: S::F64) -> S::F64 {
    let square = x * x;
    let (mut p, mut q) = (simd.splat_f64(P[0]), simd.splat_f64(Q[0]));
    for coefficient in &P[1..] {
        p = p * square + simd.splat_f64(*coefficient);
    }
    for coefficient in &Q[1..] {
        q = q * square + simd.splat_f64(*coefficient);
    }
    x + x * square * (p / q)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{InstructionSet, Kernel, LANES};
    use proptest::prelude::*;

    struct Angle([f64; 2]);

    impl Kernel for Angle {
        type Output = [f64; LANES];

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> [f64; LANES] {
            let [y, x] = self.0;
            angle(simd, simd.splat_f64(y), simd.splat_f64(x)).lanes()
        }
    }

    proptest! {
        #[test]
        fn angles_are_those_of_the_library(
            y in 0.0f64..2.0, x in -2.0f64..2.0, exponents in [-30..30i32, -30..30i32]
        ) {
            let [y, x] = [y * 2f64.powi(exponents[0]), x * 2f64.powi(exponents[1])];
            prop_assume!(y > 0.0);
            for set in InstructionSet::available() {
                for found in set.run(Angle([y, x])) {
                    prop_assert!((found - y.atan2(x)).abs() <= 4e-16 * y.atan2(x));
                }
            }
        }
    }
}
