//! The visible share of a pair of patches: the mean of `V`, weighted by the kernel.
//!
//! Samples are those of an embedded lattice, shifted at random: eight shifts, one per lane, whose
//! scatter tells the error (Cranley & Patterson, "Randomization of Number Theoretic Methods for
//! Multiple Integration", 1976).

use crate::random::Stream;
use radiosity_simd::{Float, Kernel, LANES, Simd, dispatch};
use std::ops::Range;

/// Samples under each shift to begin with, and at most.
const FEWEST: usize = 4;
const MOST: usize = 8192;

/// A share with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Share {
    pub(crate) value: f64,
    pub(crate) error: f64,
}

/// By shift: the sums of the kernel, and of the kernel where there is a view.
#[derive(Default)]
struct Sums {
    all: [f64; LANES],
    visible: [f64; LANES],
    /// Of the squares of the kernel.
    squares: [f64; LANES],
}

/// A random shift of each coordinate, for each lane.
pub(crate) type Shifts = [[f64; LANES]; 4];

/// A way to sample a pair of patches.
pub(crate) trait Sampler {
    /// The kernel of the `k`-th sample under each shift, and how much of it is visible.
    fn sample<S: Simd>(&self, simd: S, k: usize, shifts: &Shifts) -> [S::F64; 2];
    /// What may have gone unseen between samples of which each has this share of all weights.
    fn unseen(&self, share: f64) -> f64;
}

/// Adds samples to sums.
struct Measure<'a, T> {
    sampler: &'a T,
    shifts: &'a Shifts,
    samples: Range<usize>,
    sums: &'a mut Sums,
}

impl<T: Sampler> Kernel for Measure<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let mut all = simd.f64(&self.sums.all);
        let mut visible = simd.f64(&self.sums.visible);
        let mut squares = simd.f64(&self.sums.squares);
        for k in self.samples {
            let [kernel, seen] = self.sampler.sample(simd, k, self.shifts);
            all = all + kernel;
            visible = visible + seen;
            squares = squares + kernel * kernel;
        }
        self.sums.all = all.lanes();
        self.sums.visible = visible.lanes();
        self.sums.squares = squares.lanes();
    }
}

/// The visible share of two patches, sampled until its standard error is at most `wanted`, or
/// 65,536 samples have been taken.
pub(crate) fn share(sampler: &impl Sampler, stream: Stream, wanted: f64) -> Share {
    let shifts = shifts(stream);
    let mut sums = Sums::default();
    let mut samples = 0..FEWEST;
    loop {
        dispatch(Measure {
            sampler,
            shifts: &shifts,
            samples: samples.clone(),
            sums: &mut sums,
        });
        let share = sums.share(sampler);
        if share.error <= wanted || samples.end == MOST {
            return share;
        }
        samples = samples.end..2 * samples.end;
    }
}

pub(crate) fn shifts(mut stream: Stream) -> Shifts {
    std::array::from_fn(|_| std::array::from_fn(|_| stream.uniform()))
}

impl Sums {
    fn share(&self, sampler: &impl Sampler) -> Share {
        let sum = |lanes: &[f64; LANES]| lanes.iter().sum::<f64>();
        let all = sum(&self.all);
        if all <= 0.0 {
            // No sample saw the fronts of both, though there is something to see: nothing is known.
            return Share {
                value: 1.0,
                error: 1.0,
            };
        }
        let (value, scatter) = ratio(&self.visible, &self.all);
        // Samples of little weight hardly count.
        let unseen = sampler.unseen(sum(&self.squares) / (all * all));
        Share {
            // But for rounding it is.
            value: value.clamp(0.0, 1.0),
            error: scatter.max(unseen),
        }
    }
}

/// The ratio of the sums of two numbers under each shift, and its standard error by their scatter.
pub(crate) fn ratio(part: &[f64; LANES], all: &[f64; LANES]) -> (f64, f64) {
    let total: f64 = all.iter().sum();
    let ratio = part.iter().sum::<f64>() / total;
    let residual = |(part, all): (&f64, &f64)| (part - ratio * all).powi(2);
    let squares: f64 = part.iter().zip(all).map(residual).sum();
    let lanes = LANES as f64;
    (ratio, (lanes * squares / (lanes - 1.0)).sqrt() / total)
}

/// Generates a lattice in the order of van der Corput, so that every power of two of its points
/// is a lattice too (Cools, Kuo & Nuyens, "Constructing Embedded Lattice Rules for Multivariate
/// Integration", 2006). Found bit by bit, with the 4000 best of each size kept, by the variance that
/// folded lattices leave in three coordinates and in four; sizes of 16 to 128 points count most. What is
/// published is made for thousands of points.
const GENERATOR: [u32; 4] = [1, 7597, 3013, 7805];

/// A coordinate of the `k`-th point of the lattice.
#[inline(always)]
fn on_lattice(k: usize, c: usize) -> f64 {
    // Integers multiply modulo 1.
    let turns = (k as u32).reverse_bits().wrapping_mul(GENERATOR[c]);
    f64::from(turns) / (1u64 << u32::BITS) as f64
}

/// A coordinate of the `k`-th point of the lattice under each shift, folded: the integrand is then
/// as good as periodic (Hickernell, "Obtaining O(N^-2+e) Convergence for Lattice Quadrature
/// Rules", 2002).
#[inline(always)]
pub(crate) fn coordinate<S: Simd>(simd: S, k: usize, c: usize, shifts: &Shifts) -> S::F64 {
    let one = simd.splat_f64(1.0);
    let x = simd.splat_f64(on_lattice(k, c)) + simd.f64(&shifts[c]);
    let x = x.if_less(one, x, x - one);
    let twice = x + x;
    twice.min(one + one - twice)
}

#[cfg(test)]
mod tests;
