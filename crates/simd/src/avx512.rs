//! AVX-512: eight doubles or sixteen floats are one register, eight floats half of one; comparisons
//! give masks.
#![allow(
    unsafe_code,
    reason = "intrinsics; see `run` for why their use is sound"
)]

use crate::registers::{entrance, registers};
use crate::{Float, InstructionSet, Kernel, LANES, Name, Simd, WIDE, WideFloat};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

entrance!(Avx512, "avx512f,avx512vl,avx512dq,avx512bw,avx2");

registers! {
    F32: f32, [__m256; 1],
    _mm256_loadu_ps, _mm256_storeu_ps, _mm256_set1_ps,
    _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps, _mm256_div_ps, _mm256_min_ps, _mm256_max_ps,
    _mm256_sqrt_ps, less_f32, less_or_equal_f32, select_f32, if_less_f32
}

registers! {
    F64: f64, [__m512d; 1],
    _mm512_loadu_pd, _mm512_storeu_pd, _mm512_set1_pd,
    _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd, _mm512_div_pd, _mm512_min_pd, _mm512_max_pd,
    _mm512_sqrt_pd, less_f64, less_or_equal_f64, select_f64, if_less_f64
}

registers! {
    @wide Wide: [__m512; 1],
    _mm512_loadu_ps, _mm512_storeu_ps, _mm512_set1_ps, _mm512_add_ps, _mm512_mul_ps
}

/// Only where the processor has the instructions.
#[inline(always)]
unsafe fn totals([a, b, c, d]: [Wide; 4]) -> [f32; 4] {
    let ([a], [b], [c], [d]) = (a.0, b.0, c.0, d.0);
    // SAFETY: the caller's; the store writes the whole array.
    unsafe {
        let ab = _mm512_add_ps(_mm512_unpacklo_ps(a, b), _mm512_unpackhi_ps(a, b));
        let cd = _mm512_add_ps(_mm512_unpacklo_ps(c, d), _mm512_unpackhi_ps(c, d));
        let (ab, cd) = (_mm512_castps_pd(ab), _mm512_castps_pd(cd));
        let fours = _mm512_add_ps(
            _mm512_castpd_ps(_mm512_unpacklo_pd(ab, cd)),
            _mm512_castpd_ps(_mm512_unpackhi_pd(ab, cd)),
        );
        let pairs = _mm256_add_ps(
            _mm512_castps512_ps256(fours),
            _mm256_castpd_ps(_mm512_extractf64x4_pd::<1>(_mm512_castps_pd(fours))),
        );
        let sums = _mm_add_ps(
            _mm256_castps256_ps128(pairs),
            _mm256_extractf128_ps::<1>(pairs),
        );
        let mut totals = [0.0; 4];
        _mm_storeu_ps(totals.as_mut_ptr(), sums);
        totals
    }
}

/// Only where the processor has the instructions.
#[inline(always)]
unsafe fn narrow(numbers: F64) -> F32 {
    // SAFETY: the caller's.
    F32(numbers
        .0
        .map(|register| unsafe { _mm512_cvtpd_ps(register) }))
}

/// Only where the processor has the instructions.
#[inline(always)]
unsafe fn widen(numbers: F32) -> F64 {
    // SAFETY: the caller's.
    F64(numbers
        .0
        .map(|register| unsafe { _mm512_cvtps_pd(register) }))
}

macro_rules! masked {
    (
        $register:ty, $less:ident, $less_or_equal:ident, $compare:ident, $select:ident,
        $if_less:ident, $blend:ident
    ) => {
        /// Only where the processor has the instructions.
        #[inline(always)]
        unsafe fn $less(a: $register, b: $register) -> u8 {
            // SAFETY: the caller's.
            unsafe { $compare::<_CMP_LT_OQ>(a, b) }
        }

        /// Only where the processor has the instructions.
        #[inline(always)]
        unsafe fn $less_or_equal(a: $register, b: $register) -> u8 {
            // SAFETY: the caller's.
            unsafe { $compare::<_CMP_LE_OQ>(a, b) }
        }

        /// Only where the processor has the instructions.
        #[inline(always)]
        unsafe fn $select(mask: u8, a: $register, b: $register) -> $register {
            // SAFETY: the caller's.
            unsafe { $blend(mask, b, a) }
        }

        /// Only where the processor has the instructions.
        #[inline(always)]
        unsafe fn $if_less(
            a: $register,
            b: $register,
            then: $register,
            otherwise: $register,
        ) -> $register {
            // SAFETY: the caller's.
            unsafe { $blend($compare::<_CMP_LT_OQ>(a, b), otherwise, then) }
        }
    };
}

masked!(
    __m256,
    less_f32,
    less_or_equal_f32,
    _mm256_cmp_ps_mask,
    select_f32,
    if_less_f32,
    _mm256_mask_blend_ps
);
masked!(
    __m512d,
    less_f64,
    less_or_equal_f64,
    _mm512_cmp_pd_mask,
    select_f64,
    if_less_f64,
    _mm512_mask_blend_pd
);
