//! `reference`, as clap reads it.

use super::estimate_args::ThreadArgs;
use super::image_args::{ImageArgs, OF_PICTURES};
use super::parse::{parse_counts, parse_positive};
use super::scene_args::OutsideArgs;
use clap::Args;
use std::path::PathBuf;

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
    #[arg(
        long,
        value_name = "N",
        default_value = "64",
        value_parser = clap::value_parser!(u32).range(2..),
    )]
    pub spp: u32,
    /// Stop the picture after so many seconds; the result then depends on the machine's speed
    #[arg(
        long,
        value_name = "SECONDS",
        value_parser = parse_positive,
        allow_negative_numbers = true,
        conflicts_with_all = ["spp", "divisions", "cells"],
    )]
    pub time: Option<f64>,
    /// Stop when the picture's estimated relative error is below so many percent, after 16 passes
    /// at least
    #[arg(
        long,
        value_name = "PERCENT",
        value_parser = parse_positive,
        allow_negative_numbers = true,
        conflicts_with_all = ["spp", "time", "divisions", "cells"],
    )]
    pub error: Option<f64>,
    /// Instead of a picture, the mean radiosity of each cell of an N x N (or AxB) grid over each
    /// surface, hidden parts included, as CSV; faces of meshes are cells as they are
    #[arg(
        long,
        alias = "patches",
        value_name = "N",
        value_parser = parse_counts,
        conflicts_with_all = OF_PICTURES,
    )]
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
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Print one JSON object on standard output, and everything else on standard error
    #[arg(help_heading = "Run", long)]
    pub json: bool,
}
