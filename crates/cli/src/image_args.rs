//! What pictures are like, on the command line.

use super::choices::{DirectArg, FILTERS, FormatArg, ShadingArg, TONES, choice};
use super::parse::{number_or_word, parse_directions, parse_size};
use super::scene_args::set;
use super::show_args::ShowArgs;
use super::view_args::ViewArgs;
use clap::Args;
use radiosity::geometry::PixelFilter;
use radiosity::image::{Curve, Exposure, Transfer};
use radiosity::renderer::{ImageParams, Shading};
use std::path::PathBuf;

/// The flags of [`ImageArgs`].
pub(super) const OF_PICTURES: [&str; 7] = [
    "size",
    "subpixels",
    "filter",
    "exposure",
    "tone",
    "gamma",
    "dither",
];

/// What a picture is like, however it is made.
#[derive(Debug, Args)]
#[command(next_help_heading = "Pictures")]
pub struct ImageArgs {
    /// Size of the picture in pixels [default: the scene's, or 640x480]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// Sub-pixels along each edge of a pixel [default: the scene's, or 2]
    #[arg(long, value_name = "N")]
    pub subpixels: Option<u32>,
    /// How samples are spread around pixels and their parts [default: the scene's, or tents]
    #[arg(long, value_parser = choice::<PixelFilter>(&FILTERS))]
    pub filter: Option<PixelFilter>,
    /// Factor from radiance to brightness, or auto [default: the scene's, or auto]
    ///
    /// By auto, all pictures of a run have one exposure, which is printed: 98 % of what they show,
    /// lamps left out, is less bright than 0.8 of a screen.
    #[arg(
        long,
        value_name = "X|auto",
        value_parser = number_or_word::<Exposure>,
        allow_negative_numbers = true,
    )]
    pub exposure: Option<Exposure>,
    /// What becomes of what is brighter than a screen [default: the scene's, or clamp]
    #[arg(long, value_parser = choice::<Curve>(&TONES))]
    pub tone: Option<Curve>,
    /// Exponent of the screen, or srgb [default: the scene's, or srgb]
    #[arg(
        long,
        value_name = "X|srgb",
        value_parser = number_or_word::<Transfer>,
        allow_negative_numbers = true,
    )]
    pub gamma: Option<Transfer>,
    /// Dither levels: no bands in smooth gradients
    #[arg(long)]
    pub dither: bool,
}

/// How pictures are made.
#[derive(Debug, Args)]
#[allow(
    missing_docs,
    reason = "comments on flattened fields would replace help texts"
)]
pub struct DisplayArgs {
    #[command(flatten)]
    pub show: ShowArgs,
    #[command(flatten)]
    pub views: ViewArgs,
    #[command(flatten)]
    pub image: ImageArgs,
    /// Degrees between normals below which neighbouring faces of a mesh are shaded as one smooth
    /// surface [default: the scene's, or 30]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    pub crease_angle: Option<f64>,
    /// Clamp samples to the brightness of a screen before they are averaged, so that edges of lamps
    /// are smooth; the course averages first. Linear formats are never clamped [default: the
    /// scene's, or true]
    #[arg(long, value_name = "BOOL", action = clap::ArgAction::Set)]
    pub clamp_samples: Option<bool>,
    /// Samples per sub-pixel [default: the scene's, or 4]
    #[arg(long, value_name = "N")]
    pub samples: Option<u32>,
    /// How light that comes straight from emitters is shown: as patches have it, in a
    /// patch-constant and a smooth picture, or as it is at every sample, in one picture
    /// [default: patches]
    #[arg(long, value_enum)]
    pub direct: Option<DirectArg>,
    /// Look around from each sample for the light that is reflected more often, in N directions
    /// [default: the scene's, or 4]; light straight from emitters is exact then
    #[arg(
        long,
        value_name = "N",
        num_args = 0..=1,
        value_parser = parse_directions,
        conflicts_with = "direct",
    )]
    pub gather: Option<Option<u32>>,
    /// How pictures are shaded, one for each [default: constant,smooth]
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        value_name = "SHADING,..",
        conflicts_with = "direct"
    )]
    pub shading: Vec<ShadingArg>,
    /// Take up to N times as many samples where a pixel shows several faces of different
    /// brightness [default: the scene's, or 1]
    #[arg(long, value_name = "N")]
    pub adaptive: Option<u32>,
    /// Folder for the pictures [default: out]
    #[arg(help_heading = "Results", long, short, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// File formats of the pictures
    #[arg(
        help_heading = "Results",
        long,
        value_enum,
        value_delimiter = ',',
        default_values = ["ppm", "png"],
    )]
    pub format: Vec<FormatArg>,
    /// Show no small picture in the terminal
    #[arg(help_heading = "Run", long)]
    pub no_live: bool,
}

impl ImageArgs {
    pub(super) fn apply(&self, params: &mut ImageParams) {
        set(&mut params.width, self.size.map(|(width, _)| width));
        set(&mut params.height, self.size.map(|(_, height)| height));
        set(&mut params.subpixels, self.subpixels);
        set(&mut params.filter, self.filter);
        set(&mut params.exposure, self.exposure);
        set(&mut params.tone, self.tone);
        set(&mut params.gamma, self.gamma);
        params.dither |= self.dither;
    }
}

impl DisplayArgs {
    pub(super) fn apply(&self, params: &mut ImageParams) {
        self.image.apply(params);
        set(&mut params.backs, self.views.backs);
        set(&mut params.clamp_samples, self.clamp_samples);
        set(&mut params.samples, self.samples);
        set(&mut params.adaptive, self.adaptive);
        set(&mut params.directions, self.gather.flatten());
        set(&mut params.crease_angle, self.crease_angle);
        set(&mut params.lumens_per_watt, self.show.lumens_per_watt);
    }

    /// The pictures that are asked for.
    pub(crate) fn shadings(&self) -> Vec<Shading> {
        let mut wanted = self.shading.clone();
        if self.gather.is_some() {
            wanted.push(ShadingArg::Gathered);
        }
        if wanted.is_empty() {
            wanted = match self.direct {
                Some(DirectArg::Exact) => vec![ShadingArg::Exact],
                _ => vec![ShadingArg::Constant, ShadingArg::Smooth],
            };
        }
        wanted.sort();
        wanted.dedup();
        let shading = |shading| match shading {
            ShadingArg::Constant => Shading::Constant,
            ShadingArg::Smooth => Shading::Smooth,
            ShadingArg::Exact => Shading::Exact,
            ShadingArg::Gathered => Shading::Gathered,
        };
        wanted.into_iter().map(shading).collect()
    }
}
