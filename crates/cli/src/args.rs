//! The command line, as clap reads it.

use super::cache_args::CacheCommand;
use super::choices::ByArg;
use super::compare_args::CompareCommand;
use super::estimate_args::{CacheArgs, EstimateArgs, FactorArgs, ThreadArgs};
use super::image_args::DisplayArgs;
use super::light_args::LightArgs;
use super::parse::{parse_threshold, path_ending_in};
use super::reference_args::ReferenceCommand;
use super::scene_args::{OutsideArgs, SceneArgs};
use super::solver_args::SolveArgs;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// The stages, and what helps with them.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Make pictures of a scene, and all that they need
    ///
    /// Form factors and solution are computed only if they are not cached; pictures are always made
    /// anew. A change of camera, exposure, or brightness of lamps needs pictures alone; of colours
    /// or lamps, the solution too; of shapes or patches, everything.
    Render(DisplayCommand),
    /// Compute the form factors (view factors) of a scene, and write them on request
    ///
    /// They are computed only if they are not cached (--recompute: even then). Nothing is solved.
    FormFactors(FormFactorsCommand),
    /// Solve for the radiosities, and write them on request
    ///
    /// The solution is always computed anew, form factors only if they are not cached. No picture
    /// is made.
    Solve(SolveCommand),
    /// Dim and tint lights without solving
    ///
    /// The solution keeps what each light makes by itself, so that it is only recombined. It is
    /// computed only if it is not cached, and form factors too. No picture is made.
    Relight(SolveCommand),
    /// Make pictures of a solution; the same as `render`
    ///
    /// Pictures are always made anew, form factors and solution only if they are not cached.
    Display(DisplayCommand),
    /// Trace a scene by random walks: the unbiased picture or patch radiosities that others are
    /// judged by, with standard errors
    Reference(ReferenceCommand),
    /// Compare two pictures or two tables of radiosities: the error of one against the other
    Compare(CompareCommand),
    /// Check a scene, and forecast time, memory and disk of a run, without computing anything
    ///
    /// It also says whether the form factors are cached.
    Check(CheckArgs),
    /// See or empty the cache
    Cache(CacheCommand),
    /// Show what a cached file holds, how it was made, and how good it is
    Inspect(InspectCommand),
}

/// The rows of an export.
#[derive(Clone, Copy, Debug, Args)]
pub struct RowsArgs {
    /// What the rows of the export are
    #[arg(
        help_heading = "Results",
        long,
        value_enum,
        default_value = "patch",
        requires = "export"
    )]
    pub by: ByArg,
}

/// `form-factors`.
#[derive(Debug, Args)]
#[allow(
    missing_docs,
    reason = "comments on flattened fields would replace help texts"
)]
pub struct FormFactorsCommand {
    #[command(flatten)]
    pub scene: SceneArgs,
    #[command(flatten)]
    pub estimate: EstimateArgs,
    /// Compute them even if they are cached
    #[arg(help_heading = "Results", long)]
    pub recompute: bool,
    /// Write the matrix F[i, j], from row i to column j: a path that ends in .npy (float32) or
    /// .csv (by surface or group, lines of from,to,F,error). What the rows are, with areas, sums
    /// and errors, is written beside it as NAME.rows.csv
    #[arg(
        help_heading = "Results",
        long,
        value_name = "FILE",
        value_parser = path_ending_in(&["npy", "csv"]),
    )]
    pub export: Option<PathBuf>,
    #[command(flatten)]
    pub rows: RowsArgs,
    /// Write only entries of at least X, as lines of row,column,F or from,to,F,error; the sum of
    /// the others is a column of NAME.rows.csv
    #[arg(
        help_heading = "Results",
        long,
        value_name = "X",
        value_parser = parse_threshold,
        allow_negative_numbers = true,
        requires = "export",
    )]
    pub sparse: Option<f64>,
}

/// `solve` and `relight`.
#[derive(Debug, Args)]
#[allow(
    missing_docs,
    reason = "comments on flattened fields would replace help texts"
)]
pub struct SolveCommand {
    #[command(flatten)]
    pub scene: SceneArgs,
    #[command(flatten)]
    pub estimate: EstimateArgs,
    #[command(flatten)]
    pub solve: SolveArgs,
    #[command(flatten)]
    pub lights: LightArgs,
    /// Write radiosities B and irradiances H of all patches in W/m^2, with their areas, centroids,
    /// visible shares and groups; the path ends in .csv
    #[arg(
        help_heading = "Results",
        long,
        value_name = "FILE.csv",
        value_parser = path_ending_in(&["csv"]),
    )]
    pub export: Option<PathBuf>,
    #[command(flatten)]
    pub rows: RowsArgs,
    /// Solve by every method, and draw how the residual falls with each pass; the path ends in .svg
    #[arg(
        help_heading = "Results",
        long,
        value_name = "FILE.svg",
        value_parser = path_ending_in(&["svg"]),
        conflicts_with = "no_cache",
    )]
    pub plot: Option<PathBuf>,
}

/// `render` and `display`.
#[derive(Debug, Args)]
#[allow(
    missing_docs,
    reason = "comments on flattened fields would replace help texts"
)]
pub struct DisplayCommand {
    #[command(flatten)]
    pub scene: SceneArgs,
    #[command(flatten)]
    pub estimate: EstimateArgs,
    #[command(flatten)]
    pub solve: SolveArgs,
    #[command(flatten)]
    pub lights: LightArgs,
    #[command(flatten)]
    pub display: DisplayArgs,
}

/// `check`.
#[derive(Debug, Args)]
#[allow(
    missing_docs,
    reason = "comments on flattened fields would replace help texts"
)]
pub struct CheckArgs {
    #[command(flatten)]
    pub scene: SceneArgs,
    #[command(flatten)]
    pub factors: FactorArgs,
    #[command(flatten)]
    pub cache: CacheArgs,
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Print one JSON object on standard output, and everything else on standard error
    #[arg(help_heading = "Run", long)]
    pub json: bool,
}

/// `inspect`.
#[derive(Debug, Args)]
pub struct InspectCommand {
    /// A cached file: its path, or in the default cache the name that `cache list` gives
    pub file: PathBuf,
    /// The scene, for the names of its surfaces; without them surfaces are counted from 1 [default:
    /// the one that used the file last, if its name is enough to find it]
    #[arg(long)]
    pub scene: Option<PathBuf>,
    #[command(flatten)]
    #[allow(missing_docs, reason = "a comment here would replace the help text")]
    pub outside: OutsideArgs,
    /// Print one JSON object on standard output
    #[arg(long)]
    pub json: bool,
}
