//! All instruction sets of the machine that runs the tests give the bits of plain arithmetic.

use proptest::prelude::*;
use radiosity_simd::{Float, InstructionSet, Kernel, LANES, Simd, WIDE, WideFloat};

/// Lanes that a selection takes from its first operand.
const SELECTED: u8 = 0b1011_0010;

/// All operations on two vectors: the bits of the numbers, and the masks.
struct Everything<T>([T; LANES], [T; LANES]);

macro_rules! everything {
    ($scalar:ty, $load:ident, $splat:ident) => {
        impl Kernel for Everything<$scalar> {
            type Output = (Vec<[$scalar; LANES]>, [u8; 2]);

            #[inline(always)]
            fn run<S: Simd>(self, simd: S) -> Self::Output {
                let (a, b) = (simd.$load(&self.0), simd.$load(&self.1));
                let numbers = [a + b, a - b, a * b, a / b, -a, a.min(b), a.max(b), a.sqrt()];
                let mut results: Vec<_> = numbers.into_iter().map(Float::lanes).collect();
                results.push(simd.$splat(self.0[3]).lanes());
                results.push(a.select(SELECTED, b).lanes());
                results.push(a.if_less(b, a + b, -a).lanes());
                (results, [a.less(b), a.less_or_equal(b)])
            }
        }

        impl Everything<$scalar> {
            fn expected(&self) -> (Vec<[$scalar; LANES]>, [u8; 2]) {
                let each = |f: fn($scalar, $scalar) -> $scalar| {
                    std::array::from_fn(|k| f(self.0[k], self.1[k]))
                };
                let mask = |f: fn($scalar, $scalar) -> bool| {
                    let bit = |k: usize| u8::from(f(self.0[k], self.1[k])) << k;
                    (0..LANES).map(bit).sum()
                };
                let numbers = vec![
                    each(|a, b| a + b),
                    each(|a, b| a - b),
                    each(|a, b| a * b),
                    each(|a, b| a / b),
                    each(|a, _| -a),
                    each(|a, b| if a < b { a } else { b }),
                    each(|a, b| if a > b { a } else { b }),
                    each(|a, _| a.sqrt()),
                    [self.0[3]; LANES],
                    std::array::from_fn(|k| {
                        if SELECTED >> k & 1 != 0 {
                            self.0[k]
                        } else {
                            self.1[k]
                        }
                    }),
                    each(|a, b| if a < b { a + b } else { -a }),
                ];
                (numbers, [mask(|a, b| a < b), mask(|a, b| a <= b)])
            }

            fn check(a: [$scalar; LANES], b: [$scalar; LANES]) {
                let expected = Everything(a, b).expected();
                for set in InstructionSet::available() {
                    let found = set.run(Everything(a, b));
                    assert_eq!(found.1, expected.1, "{}", set.name());
                    for (found, expected) in found.0.iter().zip(&expected.0) {
                        for (found, expected) in found.iter().zip(expected) {
                            // Only the payload and sign of NaN may differ.
                            let same = found.to_bits() == expected.to_bits();
                            let nan = found.is_nan() && expected.is_nan();
                            assert!(same || nan, "{}: {found} {expected}", set.name());
                        }
                    }
                }
            }
        }
    };
}

/// Doubles, to be rounded.
struct Narrow([f64; LANES]);

impl Kernel for Narrow {
    type Output = [u32; LANES];

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> [u32; LANES] {
        let lanes = simd.narrow(simd.f64(&self.0)).lanes();
        lanes.map(f32::to_bits)
    }
}

/// Floats, to be made doubles; they are asked for before, which changes nothing.
struct Widen([f32; LANES]);

impl Kernel for Widen {
    type Output = [u64; LANES];

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> [u64; LANES] {
        simd.prefetch(&self.0);
        simd.prefetch::<f32>(&[]);
        let lanes = simd.widen(simd.f32(&self.0)).lanes();
        lanes.map(f64::to_bits)
    }
}

/// Twice as many floats, four times: their products and sums, and totals.
struct Wide([[f32; WIDE]; 4]);

impl Kernel for Wide {
    type Output = (Vec<[f32; WIDE]>, [f32; 4]);

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Self::Output {
        let [a, b, c, d] = [&self.0[0], &self.0[1], &self.0[2], &self.0[3]];
        let [a, b, c, d] = [simd.wide(a), simd.wide(b), simd.wide(c), simd.wide(d)];
        let numbers = vec![
            (a + b).lanes(),
            (c * d).lanes(),
            simd.splat_wide(self.0[0][5]).lanes(),
        ];
        (numbers, S::Wide::totals([a, b, c, d]))
    }
}

impl Wide {
    fn expected(&self) -> (Vec<[f32; WIDE]>, [f32; 4]) {
        let [a, b, c, d] = &self.0;
        let numbers = vec![
            std::array::from_fn(|k| a[k] + b[k]),
            std::array::from_fn(|k| c[k] * d[k]),
            [a[5]; WIDE],
        ];
        let total = |of: &[f32; WIDE]| {
            let four = |k: usize| (of[k] + of[k + 2]) + (of[k + 1] + of[k + 3]);
            (four(0) + four(8)) + (four(4) + four(12))
        };
        (numbers, [total(a), total(b), total(c), total(d)])
    }
}

everything!(f32, f32, splat_f32);
everything!(f64, f64, splat_f64);

fn lanes<T: std::fmt::Debug + Copy>(
    number: impl Strategy<Value = T>,
) -> impl Strategy<Value = [T; LANES]> {
    proptest::collection::vec(number, LANES)
        .prop_map(|numbers| std::array::from_fn(|lane| numbers[lane]))
}

proptest! {
    #[test]
    fn wide(numbers in proptest::collection::vec(-1e6f32..1e6, 4 * WIDE)) {
        let numbers = || std::array::from_fn(|k| std::array::from_fn(|i| numbers[k * WIDE + i]));
        let expected = Wide(numbers()).expected();
        for set in InstructionSet::available() {
            let found = set.run(Wide(numbers()));
            let bits = |numbers: &[f32]| -> Vec<u32> {
                numbers.iter().copied().map(f32::to_bits).collect()
            };
            prop_assert_eq!(
                bits(found.0.as_flattened()),
                bits(expected.0.as_flattened()),
                "{}",
                set.name()
            );
            prop_assert_eq!(bits(&found.1), bits(&expected.1), "{}", set.name());
        }
    }

    #[test]
    fn floats(a in lanes(proptest::num::f32::ANY), b in lanes(proptest::num::f32::ANY)) {
        Everything::<f32>::check(a, b);
    }

    #[test]
    fn doubles(a in lanes(proptest::num::f64::ANY), b in lanes(proptest::num::f64::ANY)) {
        Everything::<f64>::check(a, b);
    }
}

proptest! {
    #[test]
    fn rounding(mantissas in lanes(-1.0f64..1.0), exponent in -160..160i32) {
        // From below the least single to beyond the largest.
        let numbers = mantissas.map(|mantissa| mantissa * 2.0f64.powi(exponent));
        let expected = numbers.map(|x| (x as f32).to_bits());
        for set in InstructionSet::available() {
            prop_assert_eq!(set.run(Narrow(numbers)), expected, "{}", set.name());
        }
    }
}

proptest! {
    #[test]
    fn widening(numbers in lanes(proptest::num::f32::NORMAL | proptest::num::f32::SUBNORMAL)) {
        let expected = numbers.map(|x| f64::from(x).to_bits());
        for set in InstructionSet::available() {
            prop_assert_eq!(set.run(Widen(numbers)), expected, "{}", set.name());
        }
    }
}

#[test]
fn zeros_infinities_and_nan() {
    let special = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        5e-324,
    ];
    for shift in 0..LANES {
        let other = std::array::from_fn(|k| special[(k + shift) % LANES]);
        Everything::<f64>::check(special, other);
        Everything::<f32>::check(special.map(|x| x as f32), other.map(|x| x as f32));
    }
}

#[test]
fn the_portable_set_is_always_there() {
    let sets = InstructionSet::available();
    assert_eq!(sets.last().unwrap().name(), "portable");
    assert!(sets.contains(&InstructionSet::current()));
}
