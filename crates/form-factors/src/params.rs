//! The parameters of the stage.

use crate::Estimator;
use radiosity_params::OutOfRange;
use serde::{Deserialize, Serialize};

/// How form factors are estimated: `[form_factors]` of a scene file. Fields that the mode
/// does not use are ignored ([`Params::estimator`]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Params {
    /// The estimator. Default: accurate.
    pub mode: Mode,
    /// Of regular and monte-carlo: points (or strata) along each edge of a patch, 1 to 64.
    /// Default: 3.
    pub points: u32,
    /// Of monte-carlo: pairs of points for each pair of patches, at least 1. Default: `points^2`.
    pub pairs: Option<u32>,
    /// Of monte-carlo: the seed of the random points. Default: 0.
    pub seed: u64,
    /// Of accurate: the aimed sum over a row of the absolute errors of its factors, 1e-6 to 0.1.
    /// Default: 0.01, well below the error of patches of constant radiosity.
    pub tolerance: f64,
    /// Whether factors are scaled so that rows sum to 1 where patches see nothing but fronts.
    /// Default: false.
    pub closure: bool,
}

/// The estimators by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// [`Estimator::Accurate`].
    #[default]
    Accurate,
    /// [`Estimator::Regular`].
    Regular,
    /// [`Estimator::MonteCarlo`].
    MonteCarlo,
}

impl Default for Params {
    fn default() -> Params {
        Params {
            mode: Mode::default(),
            points: 3,
            pairs: None,
            seed: 0,
            tolerance: 0.01,
            closure: false,
        }
    }
}

impl radiosity_params::Parameters for Params {
    fn check(&self) -> Result<(), OutOfRange> {
        let points = (1..=64).contains(&self.points);
        OutOfRange::unless(points, "points", "between 1 and 64")?;
        let pairs = self.pairs.is_none_or(|pairs| pairs >= 1);
        OutOfRange::unless(pairs, "pairs", "at least 1")?;
        let tolerance = (1e-6..=0.1).contains(&self.tolerance);
        OutOfRange::unless(tolerance, "tolerance", "between 1e-6 and 0.1")
    }
}

impl Params {
    /// The estimator with what it depends on, and nothing else.
    pub fn estimator(&self) -> Estimator {
        let points = self.points;
        match self.mode {
            Mode::Regular => Estimator::Regular { points },
            Mode::MonteCarlo => Estimator::MonteCarlo {
                points,
                pairs: self.pairs.unwrap_or(points * points),
                seed: self.seed,
            },
            Mode::Accurate => Estimator::Accurate {
                tolerance: self.tolerance,
            },
        }
    }
}
