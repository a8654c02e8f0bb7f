//! The estimators, each with what it depends on.

use serde::{Deserialize, Serialize};

/// How the double integral of a pair is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Estimator {
    /// The regular rule: `points x points` fixed points on each patch, all pairs of them.
    ///
    /// Points are the bilinear images of the centres of a regular grid, weighted by the
    /// Jacobian, and the centroids of `points^2` sub-triangles on triangles. Patches that touch
    /// are overestimated, since the integrand is singular there (two squares at a right angle
    /// by 21.8 % with 3 x 3 points).
    ///
    /// Where parallelograms and triangles far apart see all of each other, four points with the
    /// same moments up to the third order stand for all of a patch: factors differ by less than
    /// 1e-6.
    Regular {
        /// Points along each edge of a patch.
        points: u32,
    },
    /// The plain Monte Carlo estimator: the mean of `V cos cos / (pi r^2)` over pairs of points
    /// drawn from either patch, one jittered point from each of `points x points` strata at a
    /// time, in an order shuffled anew for either patch. Points are uniform on parallelograms and
    /// triangles; on other quads they are uniform in the bilinear parameters, and weighted by the
    /// Jacobian.
    ///
    /// Unbiased, but where patches touch the integrand grows as `1 / r^2` and the variance is
    /// unbounded: single factors, and with them row sums, can be off by any amount, and the
    /// solution may then not exist.
    MonteCarlo {
        /// Strata along each edge of a patch.
        points: u32,
        /// Pairs of points drawn for each pair of patches.
        pairs: u32,
        /// Seed of all random numbers.
        seed: u64,
    },
    /// The unoccluded exchange, by the contour integral or, far away, by Gauss's rule, times the
    /// visible share of the pair, measured where something stands between in part.
    Accurate {
        /// The aimed sum over a row of the absolute errors of its factors.
        tolerance: f64,
    },
}

/// What a pair of patches costs the accurate estimator, in pairs of points.
const TYPICAL_POINT_PAIRS: u64 = 100;

impl Estimator {
    /// About how many pairs of points are drawn for each pair of patches.
    pub fn point_pairs(&self) -> u64 {
        match *self {
            Estimator::Regular { points } => u64::from(points).pow(4),
            Estimator::MonteCarlo { pairs, .. } => u64::from(pairs),
            Estimator::Accurate { .. } => TYPICAL_POINT_PAIRS,
        }
    }
}
