//! How form factors are estimated, on the command line.

use super::choices::{MODES, choice};
use super::folders::Folders;
use super::parse::parse_number;
use super::scene_args::set;
use super::terminal::tell;
use clap::Args;
use radiosity::cache::Store;
use radiosity::form_factors::{Mode, Params};
use std::path::PathBuf;

/// How form factors are estimated, where artifacts are kept, and what is printed.
#[derive(Debug, Args)]
#[allow(
    missing_docs,
    reason = "comments on flattened fields would replace help texts"
)]
pub struct EstimateArgs {
    #[command(flatten)]
    pub factors: FactorArgs,
    #[command(flatten)]
    pub cache: CacheArgs,
    #[command(flatten)]
    pub threads: ThreadArgs,
    #[command(flatten)]
    pub output: OutputArgs,
}

/// How form factors are estimated.
#[derive(Debug, Args)]
#[command(next_help_heading = "Form factors")]
pub struct FactorArgs {
    /// Estimator of the form factors [default: the scene's, or accurate]
    #[arg(long, value_parser = choice::<Mode>(&MODES))]
    pub mode: Option<Mode>,
    /// Points (or random strata) along each edge of a patch, 1 to 64, of regular and monte-carlo
    /// [default: the scene's, or 3]
    #[arg(long, value_name = "N")]
    pub points: Option<u32>,
    /// Pairs of points per pair of patches, for monte-carlo [default: points^2]
    #[arg(long, value_name = "N")]
    pub pairs: Option<u32>,
    /// Aimed error of accurate form factors, 1e-6 to 0.1 [default: the scene's, or 0.01]
    ///
    /// It is the sum of the absolute errors of all form factors from a patch. Scenes of View3D have
    /// a default of 5e-4.
    #[arg(long, value_name = "X", value_parser = parse_number, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// Seed of the random points of monte-carlo [default: the scene's, or 0]
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Scale the form factors from patches that see only fronts to sum to 1; reciprocity is kept
    #[arg(long)]
    pub closure: bool,
}

/// How many threads work.
#[derive(Clone, Copy, Debug, Args)]
#[command(next_help_heading = "Run")]
pub struct ThreadArgs {
    /// Threads to use [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub threads: Option<u32>,
}

/// What is printed.
#[derive(Clone, Copy, Debug, Args)]
#[command(next_help_heading = "Run")]
pub struct OutputArgs {
    /// Print more: sums of form factors, convergence of the solver, names of cached files
    #[arg(long, short)]
    pub verbose: bool,
    /// Print one JSON object on standard output; all else goes to standard error
    #[arg(long)]
    pub json: bool,
}

impl FactorArgs {
    pub(super) fn apply(&self, params: &mut Params) {
        set(&mut params.mode, self.mode);
        set(&mut params.points, self.points);
        set(&mut params.seed, self.seed);
        set(&mut params.tolerance, self.tolerance);
        params.pairs = self.pairs.or(params.pairs);
        params.closure |= self.closure;
        if self.tolerance.is_some() && params.mode != Mode::Accurate {
            tell("warning: --tolerance is for --mode accurate, and changes nothing");
        }
        if self.points.is_some() && params.mode == Mode::Accurate {
            tell("warning: --points is not for --mode accurate, and changes nothing");
        }
        if params.mode != Mode::MonteCarlo && (self.pairs.is_some() || self.seed.is_some()) {
            tell("warning: --pairs and --seed are for --mode monte-carlo, and change nothing");
        }
    }
}

/// Where artifacts are kept.
#[derive(Debug, Args)]
#[command(next_help_heading = "Run")]
pub struct CacheArgs {
    /// Folder of cached form factors and solutions [default: cache in a checkout, else the
    /// platform's cache folder]
    #[arg(long = "cache", value_name = "DIR")]
    pub folder: Option<PathBuf>,
    /// Compute everything; read and write no cached file
    #[arg(long, conflicts_with = "folder")]
    pub no_cache: bool,
}

impl CacheArgs {
    /// The cache, unless nothing is to be read or written.
    pub(super) fn store(&self, folders: &Folders) -> Option<Store> {
        let folder = self.folder.as_ref().unwrap_or(&folders.cache);
        (!self.no_cache).then(|| Store::new(folder))
    }
}
