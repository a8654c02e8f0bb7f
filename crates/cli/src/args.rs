//! The command line, as clap reads it.

use super::cache_args::CacheCommand;
use super::choices::{ByArg, ModeArg};
use super::image_args::{DisplayArgs, ImageArgs, OF_PICTURES};
use super::light_args::LightArgs;
use super::parse::{
    parse_counts, parse_gamma, parse_positive, parse_row_tolerance, parse_threshold, path_ending_in,
};
use super::solver_args::SolveArgs;
use clap::{Args, Subcommand};
use radiosity::scene::{Gamma, MeshFiles};
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

/// Which scene.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// A scene file, or the name of one in `scenes/`
    #[arg(default_value = "cornell")]
    pub scene: PathBuf,
    #[command(flatten)]
    #[allow(missing_docs, reason = "a comment here would replace the help text")]
    pub outside: OutsideArgs,
    /// Patches along each edge of a surface, as N or AxB, instead of the scene's default;
    /// surfaces with divisions of their own keep them
    #[arg(long, value_name = "N", value_parser = parse_counts, conflicts_with = "max_patch_edge")]
    pub patches: Option<(u32, u32)>,
    /// Longest edge of a patch, in scene units, instead of the scene's default
    #[arg(long, value_name = "LENGTH", value_parser = parse_positive, allow_negative_numbers = true)]
    pub max_patch_edge: Option<f64>,
}

/// Which files a scene may name.
#[derive(Clone, Copy, Debug, Args)]
pub struct OutsideArgs {
    /// Read meshes outside of the scene's folder, too
    #[arg(long)]
    pub allow_outside: bool,
}

impl OutsideArgs {
    pub(super) fn mesh_files(self) -> MeshFiles {
        match self.allow_outside {
            true => MeshFiles::Anywhere,
            false => MeshFiles::InFolder,
        }
    }
}

/// How form factors are estimated, and where artifacts are kept.
#[derive(Debug, Args)]
#[command(next_help_heading = "Form factors")]
pub struct EstimateArgs {
    /// Estimator of the form factors
    #[arg(long, value_enum)]
    pub mode: Option<ModeArg>,
    /// Points (or random strata) along each edge of a patch
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub points: Option<u32>,
    /// Pairs of points per pair of patches, for monte-carlo [default: points^2]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub pairs: Option<u32>,
    /// Aimed error of accurate: the sum over a row of |error of F_ij|, 1e-6 to 0.1
    #[arg(long, value_name = "X", value_parser = parse_row_tolerance, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// Seed of the random points of monte-carlo
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Scale the factors so that rows sum to 1 where patches see fronts alone; reciprocity is kept
    #[arg(long)]
    pub closure: bool,
    #[command(flatten)]
    #[allow(missing_docs, reason = "a comment here would replace the help text")]
    pub cache: CacheArgs,
    /// Threads to use [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub threads: Option<u32>,
    /// Print one JSON object on standard output, and everything else on standard error
    #[arg(long)]
    pub json: bool,
}

/// Where artifacts are kept.
#[derive(Debug, Args)]
#[command(next_help_heading = "Run")]
pub struct CacheArgs {
    /// Folder of cached form factors and solutions [default: cache in a checkout, else the
    /// platform's cache folder]
    #[arg(long = "cache", value_name = "DIR")]
    pub folder: Option<PathBuf>,
    /// Compute everything, read and write no cached file
    #[arg(long, conflicts_with = "folder")]
    pub no_cache: bool,
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
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive, allow_negative_numbers = true, conflicts_with_all = ["spp", "patches", "cells"])]
    pub time: Option<f64>,
    /// Stop when the picture's estimated relative error is below so many percent, after 16 passes
    /// at least
    #[arg(long, value_name = "PERCENT", value_parser = parse_positive, allow_negative_numbers = true, conflicts_with_all = ["spp", "time", "patches", "cells"])]
    pub error: Option<f64>,
    /// Instead of a picture, the mean radiosity of each cell of an N x N (or AxB) grid over each
    /// surface, hidden parts included, as CSV; faces of meshes are cells as they are
    #[arg(long, value_name = "N", value_parser = parse_counts, conflicts_with_all = OF_PICTURES)]
    pub patches: Option<(u32, u32)>,
    /// Instead of a picture, the mean radiosity of each of the scene's own patches, as CSV: the
    /// rows of `solve --export`
    #[arg(long, conflicts_with = "patches", conflicts_with_all = OF_PICTURES)]
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
    #[arg(long, value_name = "N", value_parser = parse_counts)]
    pub patches: Option<(u32, u32)>,
    /// Average N x N cells of the first table: compare 24 x 24 patches with 4 x 4 by --patches 4
    /// --coarsen 6
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub coarsen: Option<u32>,
    /// Factor from radiance to brightness: pixels of the reference that exceed 1 are left out,
    /// and levels are divided by it [default: the scene's, or 1]
    #[arg(long, value_name = "X", value_parser = parse_positive, allow_negative_numbers = true)]
    pub exposure: Option<f64>,
    /// Exponent by which levels of .ppm and .png become brightness, or srgb [default: a PNG's own,
    /// the scene's, or 2.2]
    #[arg(long, value_name = "X|srgb", value_parser = parse_gamma, allow_negative_numbers = true)]
    pub gamma: Option<Gamma>,
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
