//! Parts of all samples of a pair, and what they tell together.

use crate::accurate::visible_fraction::{Sampler, Share};
use crate::sampling::lattice::{Block, Lattice};
use crate::sampling::random::Stream;
use radiosity_simd::{Float, Kernel, LANES, Simd, dispatch};
use std::ops::Range;

/// Samples of the lattice of a stratum, under each shift.
pub(crate) const IN_STRATUM: usize = 16;
/// A jump that passes through both halves of a stratum leaves each a quarter of its variance, since
/// each has half of the volume. What bends is half as high if the stratum is halved across the
/// bend, and then a sixteenth is left. A half that seems to have less may well have missed what it
/// is about.
const LEAST_LEFT: f64 = 1.0 / 16.0;

/// By shift: the sums of the kernel, and of the kernel where there is a view.
#[derive(Clone, Copy, Default)]
pub(crate) struct Sums {
    pub(crate) all: [f64; LANES],
    pub(crate) visible: [f64; LANES],
}

/// Adds samples to sums.
pub(crate) struct Measure<'a, T> {
    pub(crate) sampler: &'a T,
    pub(crate) piece: usize,
    pub(crate) lattice: &'a Lattice,
    pub(crate) samples: Range<usize>,
    pub(crate) sums: &'a mut Sums,
}

impl<T: Sampler> Kernel for Measure<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let mut all = simd.f64(&self.sums.all);
        let mut visible = simd.f64(&self.sums.visible);
        for k in self.samples {
            let [kernel, seen] = self.sampler.sample(simd, k, self.piece, self.lattice);
            all = all + kernel;
            visible = visible + seen;
        }
        self.sums.all = all.lanes();
        self.sums.visible = visible.lanes();
    }
}

/// A part of the samples of a piece.
#[derive(Clone, Copy)]
pub(crate) struct Region {
    piece: usize,
    block: Block,
    /// How often it has been halved.
    depth: usize,
}

impl Region {
    /// All of a piece.
    pub(crate) fn whole(piece: usize) -> Region {
        Region {
            piece,
            block: Block::WHOLE,
            depth: 0,
        }
    }

    /// Its halves along the next of so many axes.
    pub(crate) fn halves(self, axes: usize) -> [Region; 2] {
        self.block.halves(self.depth % axes).map(|block| Region {
            block,
            depth: self.depth + 1,
            ..self
        })
    }

    /// Samples it, by the next shifts of a stream. Before, it was part of a region with this
    /// variance, or an even share of one.
    pub(crate) fn sampled(
        self,
        sampler: &impl Sampler,
        stream: &mut Stream,
        variance: f64,
    ) -> Stratum {
        let mut sums = Sums::default();
        dispatch(Measure {
            sampler,
            piece: self.piece,
            lattice: &Lattice::new(self.block, stream),
            samples: 0..IN_STRATUM,
            sums: &mut sums,
        });
        Stratum {
            least_variance: LEAST_LEFT * variance,
            ..Stratum::new(self, IN_STRATUM, &sums)
        }
    }
}

/// A region with what its samples tell.
#[derive(Clone, Copy)]
pub(crate) struct Stratum {
    pub(crate) region: Region,
    /// Under all shifts.
    samples: usize,
    /// The integrals of the kernel, and of the visible kernel.
    all: f64,
    visible: f64,
    /// Of these two: the variance of the first, the covariance, the variance of the second.
    moments: [f64; 3],
    least_variance: f64,
}

impl Stratum {
    /// By so many samples under each shift.
    pub(crate) fn new(region: Region, samples: usize, sums: &Sums) -> Stratum {
        let lanes = LANES as f64;
        let volume: f64 = region.block.size.iter().product();
        let scale = volume / (samples as f64 * lanes);
        let total = |of: &[f64; LANES]| of.iter().sum::<f64>();
        let (all, visible) = (total(&sums.all), total(&sums.visible));
        let mut moments = [0.0; 3];
        for (of_all, of_visible) in sums.all.iter().zip(&sums.visible) {
            let (a, b) = (of_all - all / lanes, of_visible - visible / lanes);
            moments[0] += a * a;
            moments[1] += a * b;
            moments[2] += b * b;
        }
        let of_mean = scale * scale * lanes / (lanes - 1.0);
        Stratum {
            region,
            samples: samples * LANES,
            all: scale * all,
            visible: scale * visible,
            moments: moments.map(|moment| of_mean * moment),
            least_variance: 0.0,
        }
    }

    /// The variance of `visible - share * all`.
    pub(crate) fn variance(&self, share: f64) -> f64 {
        let [of_all, of_both, of_visible] = self.moments;
        let variance = of_visible - 2.0 * share * of_both + share * share * of_all;
        variance.max(self.least_variance)
    }

    /// Its halves, sampled anew.
    pub(crate) fn halves(
        &self,
        sampler: &impl Sampler,
        stream: &mut Stream,
        share: f64,
    ) -> [Stratum; 2] {
        let halves = self.region.halves(sampler.coordinates());
        halves.map(|half| half.sampled(sampler, stream, self.variance(share)))
    }
}

/// The standard error of the sum over strata of `visible - share * all`, so large that 19 of 20
/// errors are less than twice as large.
///
/// The scatter of eight lanes has seven degrees of freedom, and is itself in error. That of several
/// strata has as many as Welch and Satterthwaite tell ("An Approximate Distribution of Estimates of
/// Variance Components", 1946); Student's 95 % quantile is larger than that of normal errors by
/// `1 + 1.45 / degrees`, to a percent from seven degrees on.
fn scatter(strata: &[Stratum], share: f64) -> f64 {
    let (mut sum, mut squares) = (0.0, 0.0);
    for stratum in strata {
        let variance = stratum.variance(share);
        sum += variance;
        squares += variance * variance;
    }
    if sum == 0.0 {
        return 0.0;
    }
    let degrees = (LANES - 1) as f64 * (sum / squares) * sum;
    sum.sqrt() * (1.0 + 1.45 / degrees)
}

/// What some strata tell together.
pub(crate) struct Total {
    all: f64,
    pub(crate) value: f64,
    /// The standard error of the share, by the scatter of samples.
    pub(crate) scatter: f64,
    /// The largest part of the share that one stratum may have missed.
    unseen: f64,
}

impl Total {
    /// `None` if no sample saw the fronts of both.
    pub(crate) fn of(strata: &[Stratum], sampler: &impl Sampler) -> Option<Total> {
        let all: f64 = strata.iter().map(|stratum| stratum.all).sum();
        if all <= 0.0 {
            return None;
        }
        let visible: f64 = strata.iter().map(|stratum| stratum.visible).sum();
        let value = visible / all;
        let mut total = Total {
            all,
            value,
            scatter: scatter(strata, value) / all,
            unseen: 0.0,
        };
        let unseen = strata
            .iter()
            .map(|stratum| total.unseen_in(stratum, sampler));
        total.unseen = unseen.fold(0.0, f64::max);
        Some(total)
    }

    /// The share, of which this error was wanted.
    pub(crate) fn share(&self, wanted: f64) -> Share {
        Share {
            // But for rounding it is.
            value: self.value.clamp(0.0, 1.0),
            error: self.error(),
            missed: (self.error() - wanted).max(0.0),
        }
    }

    /// The standard error of the share.
    pub(crate) fn error(&self) -> f64 {
        self.scatter.max(self.unseen)
    }

    /// The part of the error that is a stratum's own.
    pub(crate) fn scatter_in(&self, stratum: &Stratum) -> f64 {
        stratum.variance(self.value).sqrt() / self.all
    }

    /// What may have gone unseen in a stratum.
    pub(crate) fn unseen_in(&self, stratum: &Stratum, sampler: &impl Sampler) -> f64 {
        sampler.unseen(stratum.all / (self.all * stratum.samples as f64))
    }
}
