//! The command line, as clap reads it.

use super::cache_args::CacheCommand;
use super::choices::ByArg;
use super::estimate_args::EstimateArgs;
use super::image_args::{DisplayArgs, ImageArgs, OF_PICTURES};
use super::light_args::LightArgs;
use super::parse::{number_or_word, parse_counts, parse_positive, parse_threshold, path_ending_in};
use super::scene_args::{OutsideArgs, SceneArgs};
use super::solver_args::SolveArgs;
use clap::{Args, Subcommand};
use radiosity::image::Transfer;
use std::path::PathBuf;

/// The stages, and what helps with them.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render a scene: form factors, solution and both pictures, each computed only if needed
    Render(DisplayCommand),
    /// Compute the form factors (view factors) of a scene, cache them, and write them on request
    FormFactors(FormFactorsCommand),
    /// Solve anew for the radiosities, with cached form factors where possible
    Solve(SolveCommand),
    /// Dim and tint lights without solving: the radiosities of a cached solution, recombined
    Relight(SolveCommand),
    /// Make the pictures anew, with a cached solution where possible
    Display(DisplayCommand),
    /// Trace a scene by random walks: the unbiased picture or patch radiosities that others are
    /// judged by, with standard errors
    Reference(ReferenceCommand),
    /// Compare two pictures or two tables of radiosities: the error of one against the other
    Compare(CompareCommand),
    /// Check a scene, and say what memory and disk it would take, without computing anything
    Check(CheckArgs),
    /// See or empty the cache
    Cache(CacheCommand),
    /// Show what a cached file holds, how it was made, and how good it is
    Inspect(InspectCommand),
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
    /// Write the matrix F[i, j], from row i to column j: a path that ends in .npy (float32) or .csv.
    /// What the rows are, with areas, sums and errors, is written beside it as NAME.rows.csv
    #[arg(help_heading = "Results", long, value_name = "FILE", value_parser = path_ending_in(&["npy", "csv"]))]
    pub export: Option<PathBuf>,
    /// What the rows of the exported matrix are; by surface or group, .csv has lines of
    /// from,to,F,error
    #[arg(
        help_heading = "Results",
        long,
        value_enum,
        default_value = "patch",
        requires = "export"
    )]
    pub by: ByArg,
    /// Write only entries of at least X, as lines of row,column,F or from,to,F,error; the sum of the
    /// others is a column of NAME.rows.csv
    #[arg(help_heading = "Results", long, value_name = "X", value_parser = parse_threshold, allow_negative_numbers = true, requires = "export")]
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
    /// Write the radiosities of all patches: surface,ia,ib,B_r,B_g,B_b in W/m^2; the path ends
    /// in .csv
    #[arg(help_heading = "Results", long, value_name = "FILE.csv", value_parser = path_ending_in(&["csv"]))]
    pub export: Option<PathBuf>,
    /// Solve by every method, and draw how the residual falls with each pass; the path ends in .svg
    #[arg(help_heading = "Results", long, value_name = "FILE.svg", value_parser = path_ending_in(&["svg"]), conflicts_with = "no_cache")]
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

/// `reference`.
#[derive(Debug, Args)]
#[allow(
    missing_docs,
    reason = "comments on flattened fields would replace help texts"
)]
pub struct ReferenceCommand {
    /// A scene file, or the name of one in `scenes/`
    #[arg(default_value = "cornell")]
    pub scene: PathBuf,
    #[command(flatten)]
    #[allow(missing_docs, reason = "a comment here would replace the help text")]
    pub outside: OutsideArgs,
    /// Random walks per pixel (rounded up to whole passes of one per sub-pixel) or per patch, at
    /// least 2
    #[arg(long, value_name = "N", default_value = "64", value_parser = clap::value_parser!(u32).range(2..))]
    pub spp: u32,
    /// Stop the picture after so many seconds; the result then depends on the machine's speed
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive, allow_negative_numbers = true, conflicts_with_all = ["spp", "divisions", "cells"])]
    pub time: Option<f64>,
    /// Stop when the picture's estimated relative error is below so many percent, after 16 passes
    /// at least
    #[arg(long, value_name = "PERCENT", value_parser = parse_positive, allow_negative_numbers = true, conflicts_with_all = ["spp", "time", "divisions", "cells"])]
    pub error: Option<f64>,
    /// Instead of a picture, the mean radiosity of each cell of an N x N (or AxB) grid over each
    /// surface, hidden parts included, as CSV; faces of meshes are cells as they are
    #[arg(long, alias = "patches", value_name = "N", value_parser = parse_counts, conflicts_with_all = OF_PICTURES)]
    pub divisions: Option<(u32, u32)>,
    /// Instead of a picture, the mean radiosity of each of the scene's own patches, as CSV: the
    /// rows of `solve --export`
    #[arg(long, conflicts_with = "divisions", conflicts_with_all = OF_PICTURES)]
    pub cells: bool,
    /// Seed of the random walks
    #[arg(long, value_name = "N", default_value = "0")]
    pub seed: u64,
    #[command(flatten)]
    pub image: ImageArgs,
    /// Folder for the results [default: out]
    #[arg(help_heading = "Results", long, short, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Threads to use [default: all]
    #[arg(help_heading = "Run", long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub threads: Option<u32>,
    /// Print one JSON object on standard output, and everything else on standard error
    #[arg(help_heading = "Run", long)]
    pub json: bool,
}

/// `compare`.
#[derive(Debug, Args)]
pub struct CompareCommand {
    /// A picture (.exr, .hdr, .pfm, .ppm, .png) or a table of radiosities (.csv)
    pub found: PathBuf,
    /// What it should be
    pub reference: PathBuf,
    /// Map of the regions of a picture: an 8-bit grey PNG whose levels are their numbers
    #[arg(long, value_name = "MAP.png")]
    pub regions: Option<PathBuf>,
    /// The scene: its exposure and gamma for pictures; its areas and emitters for tables, which
    /// need it
    #[arg(long)]
    pub scene: Option<String>,
    #[command(flatten)]
    #[allow(missing_docs, reason = "a comment here would replace the help text")]
    pub outside: OutsideArgs,
    /// Cells along each edge of every surface in the tables, as N or AxB [default: the scene's
    /// own patches]
    #[arg(long, alias = "patches", value_name = "N", value_parser = parse_counts)]
    pub divisions: Option<(u32, u32)>,
    /// Average N x N cells of the first table: compare 24 x 24 patches with 4 x 4 by
    /// --divisions 4 --coarsen 6
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub coarsen: Option<u32>,
    /// Factor from radiance to brightness: pixels of the reference that exceed 1 are left out,
    /// and levels are divided by it [default: the scene's, or 1]
    #[arg(long, value_name = "X", value_parser = parse_positive, allow_negative_numbers = true)]
    pub exposure: Option<f64>,
    /// Exponent by which levels of .ppm and .png become brightness, or srgb [default: a PNG's own,
    /// the scene's, or 2.2]
    #[arg(long, value_name = "X|srgb", value_parser = number_or_word::<Transfer>, allow_negative_numbers = true)]
    pub gamma: Option<Transfer>,
    /// Write the differences: .png in colours (red: brighter, blue: darker), .pfm as linear
    /// numbers
    #[arg(long, value_name = "FILE", value_parser = path_ending_in(&["png", "pfm"]))]
    pub difference: Option<PathBuf>,
    /// Print one JSON object on standard output
    #[arg(long)]
    pub json: bool,
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
}

/// `inspect`.
#[derive(Debug, Args)]
pub struct InspectCommand {
    /// A cached file; `cache list` names them
    pub file: PathBuf,
    /// The scene, for the names of its surfaces [default: the one that used the file
    /// last]
    #[arg(long)]
    pub scene: Option<PathBuf>,
    #[command(flatten)]
    #[allow(missing_docs, reason = "a comment here would replace the help text")]
    pub outside: OutsideArgs,
    /// Print one JSON object on standard output
    #[arg(long)]
    pub json: bool,
}
