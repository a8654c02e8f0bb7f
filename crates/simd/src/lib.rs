//! Eight lanes of numbers, or sixteen, on the widest registers that the machine has.
//!
//! A [`Kernel`] is written once, generic over an instruction set ([`Simd`]); [`dispatch`] runs
//! it on the best one that the processor has, so a plain release build is the fast one:
//!
//! ```
//! use radiosity_simd::{Float, Kernel, Simd, dispatch};
//!
//! struct CountNegative<'a>(&'a [[f64; 8]]);
//!
//! impl Kernel for CountNegative<'_> {
//!     type Output = u32;
//!
//!     #[inline(always)] // what it is inlined into is compiled for the instruction set
//!     fn run<S: Simd>(self, simd: S) -> u32 {
//!         let zero = simd.splat_f64(0.0);
//!         self.0.iter().map(|lanes| simd.f64(lanes).less(zero).count_ones()).sum()
//!     }
//! }
//!
//! assert_eq!(dispatch(CountNegative(&[[-1.0; 8], [1.0; 8]])), 8);
//! ```
//!
//! Every operation rounds as IEEE 754 says, none is fused or approximate, and there are as many
//! lanes everywhere, eight or [`WIDE`]: all instruction sets give the same bits. The environment
//! variable `RADIOSITY_SIMD` (`portable`, `avx2`, `avx512`) picks one, to measure or to test.

mod angle;
#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod portable;
#[cfg(target_arch = "x86_64")]
mod registers;

pub use angle::angle;

use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::OnceLock;

const VARIABLE: &str = "RADIOSITY_SIMD";

/// How many numbers are computed at once.
pub const LANES: usize = 8;
/// How many where there is nothing to do but to multiply and to add.
pub const WIDE: usize = 16;

/// An instruction set that the processor has. Its value is the proof.
pub trait Simd: Copy {
    /// Eight numbers in single precision.
    type F32: Float<f32>;
    /// Eight numbers in double precision.
    type F64: Float<f64>;
    /// Sixteen numbers in single precision.
    type Wide: WideFloat;

    /// Loads lanes.
    fn f32(self, lanes: &[f32; LANES]) -> Self::F32;
    /// Loads lanes.
    fn f64(self, lanes: &[f64; LANES]) -> Self::F64;
    /// The same number in all lanes.
    fn splat_f32(self, number: f32) -> Self::F32;
    /// The same number in all lanes.
    fn splat_f64(self, number: f64) -> Self::F64;
    /// Loads lanes.
    fn wide(self, lanes: &[f32; WIDE]) -> Self::Wide;
    /// The same number in all lanes.
    fn splat_wide(self, number: f32) -> Self::Wide;
    /// Rounds to single precision.
    fn narrow(self, numbers: Self::F64) -> Self::F32;
    /// The same numbers in double precision.
    fn widen(self, numbers: Self::F32) -> Self::F64;
    /// Has the processor fetch the first line of memory of these: a hint, without any effect but on
    /// time.
    fn prefetch<T>(self, items: &[T]);
}

/// Eight numbers. Comparisons answer with one bit per lane, the first lane lowest; nothing
/// compares with NaN.
pub trait Float<T>:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// `if self < other { self } else { other }`, lane by lane: with NaN, `other`.
    fn min(self, other: Self) -> Self;
    /// `if self > other { self } else { other }`, lane by lane: with NaN, `other`.
    fn max(self, other: Self) -> Self;
    /// The square root; NaN of negative numbers.
    fn sqrt(self) -> Self;
    /// Where `self < other`.
    fn less(self, other: Self) -> u8;
    /// Where `self <= other`.
    fn less_or_equal(self, other: Self) -> u8;
    /// Where `mask` has a bit, `self`, elsewhere `other`.
    fn select(self, mask: u8, other: Self) -> Self;
    /// Where `self < other`, `then`, elsewhere `otherwise`: with [`Float::less`] and
    /// [`Float::select`] it would take longer where the processor has no bits per lane.
    fn if_less(self, other: Self, then: Self, otherwise: Self) -> Self;
    /// The lanes.
    fn lanes(self) -> [T; LANES];
}

/// Sixteen numbers, for products and sums alone: the widest registers have room for them, and do
/// twice as much at a time.
pub trait WideFloat: Copy + Add<Output = Self> + Mul<Output = Self> {
    /// The lanes.
    fn lanes(self) -> [f32; WIDE];
    /// The sums over the lanes of four: `(a + c) + (b + d)` of each four lanes, and then of those
    /// four sums.
    fn totals(four: [Self; 4]) -> [f32; 4];
}

/// A computation written for any instruction set.
pub trait Kernel {
    /// Its result.
    type Output;
    /// Computes. Mark this, and what it calls that is generic over [`Simd`], with
    /// `#[inline(always)]`, and call no closures with lanes: only what is inlined is compiled
    /// for the instruction set.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

/// Runs a kernel on the best instruction set of this machine.
#[inline]
pub fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    InstructionSet::current().run(kernel)
}

/// One of the instruction sets of this machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InstructionSet(Name);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Name {
    #[cfg(target_arch = "x86_64")]
    Avx512,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    Portable,
}

impl InstructionSet {
    /// All that this machine has, the best first.
    pub fn available() -> Vec<InstructionSet> {
        let mut sets = Vec::new();
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = is_x86_feature_detected!("avx2");
            // Every processor that has VL has DQ and BW too, which hold masks of eight lanes.
            let avx512 = is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw");
            if avx2 && avx512 {
                sets.push(InstructionSet(Name::Avx512));
            }
            if avx2 {
                sets.push(InstructionSet(Name::Avx2));
            }
        }
        sets.push(InstructionSet(Name::Portable));
        sets
    }

    /// The name that is not one of this machine's, if the environment variable has such a one.
    pub fn unknown_wish() -> Option<String> {
        let wanted = std::env::var(VARIABLE).ok()?;
        let mut sets = InstructionSet::available().into_iter();
        let is_known = wanted.is_empty() || sets.any(|set| set.name() == wanted);
        (!is_known).then_some(wanted)
    }

    /// The one that [`dispatch`] uses: the best, unless `RADIOSITY_SIMD` names another that the
    /// machine has.
    #[inline]
    pub fn current() -> InstructionSet {
        static CURRENT: OnceLock<InstructionSet> = OnceLock::new();
        *CURRENT.get_or_init(|| {
            let wanted = std::env::var(VARIABLE).unwrap_or_default();
            let sets = InstructionSet::available();
            let named = sets.iter().find(|set| set.name() == wanted);
            *named.unwrap_or(&sets[0])
        })
    }

    /// Its name, as `RADIOSITY_SIMD` takes it.
    pub fn name(self) -> &'static str {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Name::Avx512 => "avx512",
            #[cfg(target_arch = "x86_64")]
            Name::Avx2 => "avx2",
            Name::Portable => "portable",
        }
    }

    /// Runs a kernel on this instruction set.
    #[inline]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Name::Avx512 => avx512::run(self, kernel),
            #[cfg(target_arch = "x86_64")]
            Name::Avx2 => avx2::run(self, kernel),
            Name::Portable => kernel.run(portable::Portable),
        }
    }
}
