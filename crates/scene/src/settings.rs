//! `[discretization]`, `[form_factors]`, `[solver]`: defaults that flags override.

use crate::source::{SceneError, Source};
use crate::values::{Counts, divisions, require};
use radiosity_geometry::Divisions;
use serde::Deserialize;
use toml::Spanned;

/// The form factor stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormFactorSettings {
    /// The estimator.
    pub mode: Mode,
    /// Points (or strata) along each edge of a patch.
    pub points: u32,
    /// Pairs of points per pair of patches, where the mode has a choice; by default
    /// `points^2`.
    pub pairs: Option<u32>,
    /// Seed of random points.
    pub seed: u64,
    /// Where the mode knows its errors: the aimed sum over a row of the absolute errors of its
    /// factors.
    pub tolerance: f64,
    /// Whether rows whose patches see fronts alone are scaled to sum to 1.
    pub closure: bool,
}

/// The estimators by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// Fixed points, all pairs.
    Regular,
    /// Random points.
    MonteCarlo,
    /// Exact where nothing stands between, times the visible share where something does.
    Accurate,
}

/// The solver stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolverSettings {
    /// How to solve.
    pub method: SolverMethod,
    /// How much Gauss-Seidel overdoes each change.
    pub relaxation: Relaxation,
    /// Relative residual to reach.
    pub tolerance: f64,
    /// Most passes over the matrix to take.
    pub max_sweeps: u32,
}

/// The solvers by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SolverMethod {
    /// Row after row, with the newest values.
    GaussSeidel,
    /// The fewest passes where light is reflected often.
    #[serde(alias = "cg")]
    ConjugateGradients,
}

/// How much each change is overdone.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(
    rename_all = "kebab-case",
    untagged,
    expecting = "a number between 0 and 2, or \"auto\""
)]
pub enum Relaxation {
    /// By a factor between 0 and 2; 1 is plain Gauss-Seidel.
    Factor(f64),
    /// By what the first sweeps suggest.
    Named(Automatic),
}

/// The name of a choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Automatic {
    /// The solver chooses.
    Auto,
}

/// Well below what patches of constant radiosity cost, and for engineers who want factors.
const DEFAULT_TOLERANCE: f64 = 5e-4;

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DiscretizationTable {
    divisions: Option<Spanned<Counts>>,
    max_patch_edge: Option<Spanned<f64>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FormFactorTable {
    mode: Option<Mode>,
    points: Option<Spanned<u32>>,
    pairs: Option<Spanned<u32>>,
    seed: Option<u64>,
    tolerance: Option<Spanned<f64>>,
    #[serde(default)]
    closure: bool,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SolverTable {
    method: Option<SolverMethod>,
    relaxation: Option<Spanned<Relaxation>>,
    tolerance: Option<Spanned<f64>>,
    max_sweeps: Option<Spanned<u32>>,
}

/// The value of an optional entry within a range, or its default.
pub(crate) fn value_or<T: Copy>(
    source: &Source<'_>,
    entry: Option<&Spanned<T>>,
    default: T,
    holds: impl Fn(T) -> bool,
    (what, range): (&str, &str),
) -> Result<T, SceneError> {
    let Some(entry) = entry else {
        return Ok(default);
    };
    require(source, entry, |&value| holds(value), what, range)?;
    Ok(*entry.get_ref())
}

impl DiscretizationTable {
    pub(crate) fn check(&self, source: &Source<'_>) -> Result<Divisions, SceneError> {
        let given = divisions(
            source,
            self.divisions.as_ref(),
            self.max_patch_edge.as_ref(),
        )?;
        Ok(given.unwrap_or(Divisions::uniform(12)))
    }
}

impl FormFactorTable {
    pub(crate) fn check(&self, source: &Source<'_>) -> Result<FormFactorSettings, SceneError> {
        let points = ("`points`", "between 1 and 64");
        let tolerance = ("`tolerance`", "between 1e-6 and 0.1");
        let pairs = self.pairs.as_ref();
        if let Some(pairs) = pairs {
            require(source, pairs, |&n| n >= 1, "`pairs`", "at least 1")?;
        }
        Ok(FormFactorSettings {
            mode: self.mode.unwrap_or(Mode::Accurate),
            points: value_or(
                source,
                self.points.as_ref(),
                3,
                |n| (1..=64).contains(&n),
                points,
            )?,
            pairs: pairs.map(|pairs| *pairs.get_ref()),
            seed: self.seed.unwrap_or(0),
            tolerance: value_or(
                source,
                self.tolerance.as_ref(),
                DEFAULT_TOLERANCE,
                |x| (1e-6..=0.1).contains(&x),
                tolerance,
            )?,
            closure: self.closure,
        })
    }
}

impl SolverTable {
    pub(crate) fn check(&self, source: &Source<'_>) -> Result<SolverSettings, SceneError> {
        let tolerance = ("`tolerance`", "between 0 and 1, neither included");
        let sweeps = ("`max_sweeps`", "at least 1");
        let inside = |x: f64| x > 0.0 && x < 1.0;
        let relaxation = (
            "`relaxation`",
            "between 0 and 2, neither included, or \"auto\"",
        );
        let converges = |relaxation| match relaxation {
            Relaxation::Factor(factor) => factor > 0.0 && factor < 2.0,
            Relaxation::Named(Automatic::Auto) => true,
        };
        let auto = Relaxation::Named(Automatic::Auto);
        Ok(SolverSettings {
            method: self.method.unwrap_or(SolverMethod::GaussSeidel),
            relaxation: value_or(
                source,
                self.relaxation.as_ref(),
                auto,
                converges,
                relaxation,
            )?,
            tolerance: value_or(source, self.tolerance.as_ref(), 1e-6, inside, tolerance)?,
            max_sweeps: value_or(source, self.max_sweeps.as_ref(), 200, |n| n >= 1, sweeps)?,
        })
    }
}
