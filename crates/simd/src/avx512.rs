//! AVX-512: eight doubles are one register, eight floats half of one.
#![allow(
    unsafe_code,
    reason = "intrinsics; see `run` for why their use is sound"
)]

use crate::avx2::F32;
use crate::registers::{entrance, registers};
use crate::{Float, InstructionSet, Kernel, LANES, Name, Simd};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

entrance!(Avx512, "avx512f,avx512vl,avx2");

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
