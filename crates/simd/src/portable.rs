//! Arrays: for machines without the other instruction sets, and what those are tested against.

use crate::{Float, LANES, Simd, WIDE, WideFloat};
use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Clone, Copy)]
pub(crate) struct Portable;

#[derive(Clone, Copy)]
pub(crate) struct Array<T, const COUNT: usize = LANES>([T; COUNT]);

impl Simd for Portable {
    type F32 = Array<f32>;
    type F64 = Array<f64>;
    type Wide = Array<f32, WIDE>;

    #[inline(always)]
    fn f32(self, lanes: &[f32; LANES]) -> Array<f32> {
        Array(*lanes)
    }

    #[inline(always)]
    fn f64(self, lanes: &[f64; LANES]) -> Array<f64> {
        Array(*lanes)
    }

    #[inline(always)]
    fn splat_f32(self, number: f32) -> Array<f32> {
        Array([number; LANES])
    }

    #[inline(always)]
    fn splat_f64(self, number: f64) -> Array<f64> {
        Array([number; LANES])
    }

    #[inline(always)]
    fn wide(self, lanes: &[f32; WIDE]) -> Array<f32, WIDE> {
        Array(*lanes)
    }

    #[inline(always)]
    fn splat_wide(self, number: f32) -> Array<f32, WIDE> {
        Array([number; WIDE])
    }

    #[inline(always)]
    fn narrow(self, numbers: Array<f64>) -> Array<f32> {
        Array(numbers.0.map(|number| number as f32))
    }

    #[inline(always)]
    fn widen(self, numbers: Array<f32>) -> Array<f64> {
        Array(numbers.0.map(f64::from))
    }

    #[inline(always)]
    fn prefetch<T>(self, _: &[T]) {}
}

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl<T: Copy + $trait<Output = T>, const COUNT: usize> $trait for Array<T, COUNT> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Array(from_fn(|k| self.0[k].$method(other.0[k])))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<T: Copy + Neg<Output = T>> Neg for Array<T> {
    type Output = Array<T>;

    #[inline(always)]
    fn neg(self) -> Array<T> {
        Array(self.0.map(T::neg))
    }
}

impl<T: Copy + PartialOrd> Array<T> {
    #[inline(always)]
    fn choose(self, other: Array<T>, test: impl Fn(&T, &T) -> bool) -> Array<T> {
        Array(from_fn(|k| {
            let (a, b) = (self.0[k], other.0[k]);
            if test(&a, &b) { a } else { b }
        }))
    }

    #[inline(always)]
    fn mask(self, other: Array<T>, test: impl Fn(&T, &T) -> bool) -> u8 {
        (0..LANES).fold(0, |mask, k| {
            mask | (u8::from(test(&self.0[k], &other.0[k])) << k)
        })
    }
}

/// What both precisions have.
pub(crate) trait Scalar:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    fn root(self) -> Self;
}

impl Scalar for f32 {
    #[inline(always)]
    fn root(self) -> f32 {
        self.sqrt()
    }
}

impl Scalar for f64 {
    #[inline(always)]
    fn root(self) -> f64 {
        self.sqrt()
    }
}

impl<T: Scalar> Float<T> for Array<T> {
    #[inline(always)]
    fn min(self, other: Array<T>) -> Array<T> {
        self.choose(other, |a, b| a < b)
    }

    #[inline(always)]
    fn max(self, other: Array<T>) -> Array<T> {
        self.choose(other, |a, b| a > b)
    }

    #[inline(always)]
    fn sqrt(self) -> Array<T> {
        Array(self.0.map(T::root))
    }

    #[inline(always)]
    fn less(self, other: Array<T>) -> u8 {
        self.mask(other, |a, b| a < b)
    }

    #[inline(always)]
    fn less_or_equal(self, other: Array<T>) -> u8 {
        self.mask(other, |a, b| a <= b)
    }

    #[inline(always)]
    fn if_less(self, other: Array<T>, then: Array<T>, otherwise: Array<T>) -> Array<T> {
        Array(from_fn(|k| {
            if self.0[k] < other.0[k] {
                then.0[k]
            } else {
                otherwise.0[k]
            }
        }))
    }

    #[inline(always)]
    fn select(self, mask: u8, other: Array<T>) -> Array<T> {
        Array(from_fn(|k| {
            if mask >> k & 1 != 0 {
                self.0[k]
            } else {
                other.0[k]
            }
        }))
    }

    #[inline(always)]
    fn lanes(self) -> [T; LANES] {
        self.0
    }
}

impl WideFloat for Array<f32, WIDE> {
    #[inline(always)]
    fn lanes(self) -> [f32; WIDE] {
        self.0
    }

    #[inline(always)]
    fn totals(four: [Array<f32, WIDE>; 4]) -> [f32; 4] {
        let of_four = |[a, b, c, d]: [f32; 4]| (a + c) + (b + d);
        let total = |lanes: Array<f32, WIDE>| {
            let fours = lanes.0.as_chunks::<4>().0;
            of_four(from_fn(|k| of_four(fours[k])))
        };
        four.map(total)
    }
}
