//! `compare`, as clap reads it.

use super::parse::{number_or_word, parse_counts, parse_positive, path_ending_in};
use super::scene_args::OutsideArgs;
use clap::Args;
use radiosity::image::Transfer;
use std::path::PathBuf;

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
    /// the scene's, or srgb]
    #[arg(
        long,
        value_name = "X|srgb",
        value_parser = number_or_word::<Transfer>,
        allow_negative_numbers = true,
    )]
    pub gamma: Option<Transfer>,
    /// Write the differences: .png in colours (red: brighter, blue: darker), .pfm as linear
    /// numbers
    #[arg(long, value_name = "FILE", value_parser = path_ending_in(&["png", "pfm"]))]
    pub difference: Option<PathBuf>,
    /// Print one JSON object on standard output
    #[arg(long)]
    pub json: bool,
}
