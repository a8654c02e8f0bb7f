//! AVX-512: eight doubles are one register, eight floats half of one.
#![allow(
    unsafe_code,
    reason = "intrinsics; see `run` for why their use is sound"
)]

use crate::avx2::F32;
use crate::registers::registers;
use crate::{Float, InstructionSet, Kernel, LANES, Name, Simd};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Made by [`run`] alone.
#[derive(Clone, Copy)]
pub(crate) struct Avx512(());

#[inline]
pub(crate) fn run<K: Kernel>(set: InstructionSet, kernel: K) -> K::Output {
    assert_eq!(set.0, Name::Avx512);
    // SAFETY: `InstructionSet::available` makes this value only where the processor has what
    // the function asks for. `Avx512` and lanes exist only inside it, so all intrinsics of this
    // module run there.
    unsafe { enter(kernel) }
}

#[target_feature(enable = "avx512f,avx512vl,avx2")]
fn enter<K: Kernel>(kernel: K) -> K::Output {
    kernel.run(Avx512(()))
}

impl Simd for Avx512 {
    type F32 = F32;
    type F64 = F64;

    #[inline(always)]
    fn f32(self, lanes: &[f32; LANES]) -> F32 {
        // SAFETY: see `run`.
        unsafe { F32::load(lanes) }
    }

    #[inline(always)]
    fn f64(self, lanes: &[f64; LANES]) -> F64 {
        // SAFETY: see `run`.
        unsafe { F64::load(lanes) }
    }

    #[inline(always)]
    fn splat_f32(self, number: f32) -> F32 {
        // SAFETY: see `run`.
        unsafe { F32::splat(number) }
    }

    #[inline(always)]
    fn splat_f64(self, number: f64) -> F64 {
        // SAFETY: see `run`.
        unsafe { F64::splat(number) }
    }
}

registers! {
    F64: f64, [__m512d; 1],
    _mm512_loadu_pd, _mm512_storeu_pd, _mm512_set1_pd,
    _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd, _mm512_div_pd, _mm512_min_pd, _mm512_max_pd,
    less_f64, less_or_equal_f64, select_f64
}

/// Only where the processor has the instructions.
#[inline(always)]
unsafe fn less_f64(a: __m512d, b: __m512d) -> u8 {
    // SAFETY: the caller's.
    unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b) }
}

/// Only where the processor has the instructions.
#[inline(always)]
unsafe fn less_or_equal_f64(a: __m512d, b: __m512d) -> u8 {
    // SAFETY: the caller's.
    unsafe { _mm512_cmp_pd_mask::<_CMP_LE_OQ>(a, b) }
}

/// Only where the processor has the instructions.
#[inline(always)]
unsafe fn select_f64(mask: u8, a: __m512d, b: __m512d) -> __m512d {
    // SAFETY: the caller's.
    unsafe { _mm512_mask_blend_pd(mask, b, a) }
}
