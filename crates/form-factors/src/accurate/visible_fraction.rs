//! The visible share of a pair of patches: the mean of `V`, weighted by the kernel.
//!
//! All samples are of one lattice at first. Where that is not enough, the cube of their coordinates
//! is halved again and again, into strata with a small lattice each. Shadows end at surfaces in the
//! cube, and only strata that these pass through are halved further.
//!
//! Of strata of size `h`, some `h^-2` are at such a surface, and they take `n ~ h^-2` samples. If
//! the integrand jumps there, each has an error of its volume, `h^3`; errors are independent, and
//! add up to `h^-1 h^3 = h^2 ~ 1 / n`.

use crate::accurate::strata::{IN_STRATUM, Measure, Region, Stratum, Sums, Total};
use crate::sampling::lattice::{Block, Lattice};
use crate::sampling::random::Stream;
use radiosity_simd::{Simd, dispatch};

/// Samples under each shift to begin with.
const FEWEST: usize = 4;
/// So many of one lattice at most.
const IN_ONE: usize = 512;
/// So many of all strata.
const MOST: usize = 1 << 19;
/// One round of halving aims at this part of the error: what is worth to be halved further shows
/// best in the halves.
const LESS_ERROR: f64 = 1.0 / 8.0;

/// A share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Share {
    pub(crate) value: f64,
    /// Its standard error.
    pub(crate) error: f64,
    /// By how much the error is larger than was wanted, since there is a limit to the samples.
    pub(crate) missed: f64,
}

impl Share {
    /// Of what is too little to be sampled.
    pub(crate) const UNKNOWN: Share = Share {
        value: 1.0,
        error: 1.0,
        missed: 0.0,
    };
}

/// A way to sample a pair of patches.
pub(crate) trait Sampler {
    /// The pieces of the pair, which are sampled one by one.
    fn pieces(&self) -> usize;
    /// How many coordinates a sample has.
    fn coordinates(&self) -> usize;
    /// The kernel of the `k`-th sample of a piece under each shift, and how much of it is visible.
    fn sample<S: Simd>(&self, simd: S, k: usize, piece: usize, lattice: &Lattice) -> [S::F64; 2];
    /// What may have gone unseen between samples of which each has this share of all weights.
    fn unseen(&self, share: f64) -> f64;
}

/// The visible share of two patches, sampled until its standard error is at most `wanted`, or
/// the most samples have been taken.
pub(crate) fn share(sampler: &impl Sampler, mut stream: Stream, wanted: f64) -> Share {
    let pieces = 0..sampler.pieces();
    let lattice = |_| (Lattice::new(Block::WHOLE, &mut stream), Sums::default());
    let mut lattices: Vec<(Lattice, Sums)> = pieces.map(lattice).collect();
    let (mut first, mut last) = (0, FEWEST);
    loop {
        let mut strata = Vec::with_capacity(lattices.len());
        for (piece, (lattice, sums)) in lattices.iter_mut().enumerate() {
            dispatch(Measure {
                sampler,
                piece,
                lattice,
                samples: first..last,
                sums,
            });
            strata.push(Stratum::new(Region::whole(piece), last, sums));
        }
        match Total::of(&strata, sampler) {
            None if last == IN_ONE => return Share::UNKNOWN,
            Some(total) if total.error() <= wanted => return total.share(wanted),
            Some(total) if last == IN_ONE => {
                let strata = even_strata(sampler, &mut stream, (&strata, total.value));
                return share_of_strata(sampler, strata, stream, wanted);
            }
            _ => (first, last) = (last, 2 * last),
        }
    }
}

/// Cells of equal size, which have as many samples together as those of whole pieces.
fn even_strata(
    sampler: &impl Sampler,
    stream: &mut Stream,
    (wholes, share): (&[Stratum], f64),
) -> Vec<Stratum> {
    let halvings = (IN_ONE / IN_STRATUM).ilog2();
    let mut strata = Vec::with_capacity(wholes.len() << halvings);
    for whole in wholes {
        let mut regions = vec![whole.region];
        for _ in 0..halvings {
            let halves = regions.iter().flat_map(|r| r.halves(sampler.coordinates()));
            regions = halves.collect();
        }
        let part = whole.variance(share) / regions.len() as f64;
        let sampled = |region: Region| region.sampled(sampler, stream, part);
        strata.extend(regions.into_iter().map(sampled));
    }
    strata
}

/// The visible share by strata, where that of one lattice is not enough.
fn share_of_strata(
    sampler: &impl Sampler,
    mut strata: Vec<Stratum>,
    mut stream: Stream,
    wanted: f64,
) -> Share {
    let mut taken = strata.len() * IN_STRATUM;
    loop {
        let Some(total) = Total::of(&strata, sampler) else {
            return Share::UNKNOWN;
        };
        if total.error() <= wanted || taken >= MOST {
            return total.share(wanted);
        }
        // Cells add to the error by their variance, and equal parts take the fewest samples.
        // Where that is too much one of them at least has more than an equal part.
        let squares = strata
            .iter()
            .map(|stratum| total.scatter_in(stratum).powi(2));
        let aim = match squares.sum::<f64>().sqrt() {
            0.0 => wanted,
            scatter => (wanted / total.scatter).max(LESS_ERROR) * scatter,
        };
        let most = aim / (strata.len() as f64).sqrt();
        let mut next = Vec::with_capacity(2 * strata.len());
        for stratum in &strata {
            let is_enough =
                total.scatter_in(stratum) <= most && total.unseen_in(stratum, sampler) <= wanted;
            if is_enough {
                next.push(*stratum);
            } else {
                next.extend(stratum.halves(sampler, &mut stream, total.value));
                taken += 2 * IN_STRATUM;
            }
        }
        strata = next;
    }
}

#[cfg(test)]
mod tests;
