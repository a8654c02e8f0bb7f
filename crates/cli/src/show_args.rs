//! What pictures show, on the command line.

use super::choices::ShowArg;
use super::parse::{PatchName, parse_patch, parse_top};
use clap::Args;

/// What pictures show.
#[derive(Debug, Args)]
#[command(next_help_heading = "What is shown")]
pub struct ShowArgs {
    /// What pictures show: light as an eye sees it, or numbers in false colours [default: light]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "WHAT,..")]
    pub show: Vec<ShowArg>,
    /// Show the form factors from one patch to all others: a surface, and the patch's two numbers
    /// in exported tables
    #[arg(long, value_name = "SURFACE:A,B", value_parser = parse_patch)]
    pub factors_of: Option<PatchName>,
    /// The number that has the brightest false colour [default: a round one that 2 % of what the
    /// first picture shows exceed]
    #[arg(long, value_name = "X", value_parser = parse_top, allow_negative_numbers = true)]
    pub top: Option<f64>,
    /// False colours over three decades, not from 0
    #[arg(long)]
    pub log: bool,
    /// Draw lines of equal numbers over false colours, at those of the legend
    #[arg(long)]
    pub isolines: bool,
    /// Draw the borders of patches over pictures
    #[arg(long)]
    pub patch_lines: bool,
    /// Luminous flux of a watt of light, for illuminance [default: the scene's, or 683]
    #[arg(long, value_name = "LM/W", allow_negative_numbers = true)]
    pub lumens_per_watt: Option<f64>,
}
