//! AVX2: eight floats are one register, eight doubles or sixteen floats two.
#![allow(
    unsafe_code,
    reason = "intrinsics; see `run` for why their use is sound"
)]

use crate::registers::{entrance, registers};
use crate::{Float, InstructionSet, Kernel, LANES, Name, Simd, WIDE, WideFloat};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

entrance!(Avx2, "avx2");

registers! {
    F32: f32, [__m256; 1],
    _mm256_loadu_ps, _mm256_storeu_ps, _mm256_set1_ps,
    _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps, _mm256_div_ps, _mm256_min_ps, _mm256_max_ps,
    _mm256_sqrt_ps, less_f32, less_or_equal_f32, select_f32, if_less_f32
}

registers! {
    F64: f64, [__m256d; 2],
    _mm256_loadu_pd, _mm256_storeu_pd, _mm256_set1_pd,
    _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd, _mm256_min_pd, _mm256_max_pd,
    _mm256_sqrt_pd, less_f64, less_or_equal_f64, select_f64, if_less_f64
}

registers! {
    @wide Wide: [__m256; 2],
    _mm256_loadu_ps, _mm256_storeu_ps, _mm256_set1_ps, _mm256_add_ps, _mm256_mul_ps
}

/// Only where the processor has the instructions.
#[inline(always)]
unsafe fn totals([a, b, c, d]: [Wide; 4]) -> [f32; 4] {
    // SAFETY: the caller's; the store writes the whole array.
    unsafe {
        let mut fours = [_mm256_setzero_ps(); 2];
        for (k, fours) in fours.iter_mut().enumerate() {
            let (a, b, c, d) = (a.0[k], b.0[k], c.0[k], d.0[k]);
            let ab = _mm256_add_ps(_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
            let cd = _mm256_add_ps(_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
            let (ab, cd) = (_mm256_castps_pd(ab), _mm256_castps_pd(cd));
            *fours = _mm256_add_ps(
                _mm256_castpd_ps(_mm256_unpacklo_pd(ab, cd)),
                _mm256_castpd_ps(_mm256_unpackhi_pd(ab, cd)),
            );
        }
        let pairs = _mm256_add_ps(fours[0], fours[1]);
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
    let [low, high] = numbers.0;
    // SAFETY: the caller's.
    F32([unsafe { _mm256_set_m128(_mm256_cvtpd_ps(high), _mm256_cvtpd_ps(low)) }])
}

/// Only where the processor has the instructions.
#[inline(always)]
unsafe fn widen(numbers: F32) -> F64 {
    let [numbers] = numbers.0;
    // SAFETY: the caller's.
    unsafe {
        let high = _mm256_extractf128_ps::<1>(numbers);
        F64([
            _mm256_cvtps_pd(_mm256_castps256_ps128(numbers)),
            _mm256_cvtps_pd(high),
        ])
    }
}

macro_rules! compare {
    ($name:ident, $register:ty, $compare:ident, $relation:ident, $bits:ident) => {
        /// Only where the processor has the instructions.
        #[inline(always)]
        unsafe fn $name(a: $register, b: $register) -> u8 {
            // SAFETY: the caller's.
            unsafe { $bits($compare::<$relation>(a, b)) as u8 }
        }
    };
}

compare!(
    less_f32,
    __m256,
    _mm256_cmp_ps,
    _CMP_LT_OQ,
    _mm256_movemask_ps
);
compare!(
    less_or_equal_f32,
    __m256,
    _mm256_cmp_ps,
    _CMP_LE_OQ,
    _mm256_movemask_ps
);
compare!(
    less_f64,
    __m256d,
    _mm256_cmp_pd,
    _CMP_LT_OQ,
    _mm256_movemask_pd
);
compare!(
    less_or_equal_f64,
    __m256d,
    _mm256_cmp_pd,
    _CMP_LE_OQ,
    _mm256_movemask_pd
);

/// Only where the processor has the instructions.
#[inline(always)]
unsafe fn select_f32(mask: u8, a: __m256, b: __m256) -> __m256 {
    // SAFETY: the caller's.
    unsafe {
        let bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
        let set = _mm256_and_si256(_mm256_set1_epi32(i32::from(mask)), bits);
        let chosen = _mm256_cmpeq_epi32(set, bits);
        _mm256_blendv_ps(b, a, _mm256_castsi256_ps(chosen))
    }
}

/// Only where the processor has the instructions; by the lowest four bits.
#[inline(always)]
unsafe fn select_f64(mask: u8, a: __m256d, b: __m256d) -> __m256d {
    // SAFETY: the caller's.
    unsafe {
        let bits = _mm256_setr_epi64x(1, 2, 4, 8);
        let set = _mm256_and_si256(_mm256_set1_epi64x(i64::from(mask)), bits);
        let chosen = _mm256_cmpeq_epi64(set, bits);
        _mm256_blendv_pd(b, a, _mm256_castsi256_pd(chosen))
    }
}

/// Only where the processor has the instructions.
#[inline(always)]
unsafe fn if_less_f32(a: __m256, b: __m256, then: __m256, otherwise: __m256) -> __m256 {
    // SAFETY: the caller's.
    unsafe { _mm256_blendv_ps(otherwise, then, _mm256_cmp_ps::<_CMP_LT_OQ>(a, b)) }
}

/// Only where the processor has the instructions.
#[inline(always)]
unsafe fn if_less_f64(a: __m256d, b: __m256d, then: __m256d, otherwise: __m256d) -> __m256d {
    // SAFETY: the caller's.
    unsafe { _mm256_blendv_pd(otherwise, then, _mm256_cmp_pd::<_CMP_LT_OQ>(a, b)) }
}
