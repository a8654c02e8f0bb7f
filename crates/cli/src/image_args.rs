//! What pictures are like, on the command line.

use super::apply::set;
use super::choices::{DirectArg, FilterArg, FormatArg, ShadingArg, ToneArg};
use super::parse::{parse_angle, parse_directions, parse_exposure, parse_gamma, parse_size};
use super::show_args::ShowArgs;
use super::view_args::ViewArgs;
use clap::Args;
use radiosity::geometry::PixelFilter;
use radiosity::renderer::Shading;
use radiosity::scene::{Exposure, Gamma, Scene, Tone};
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
    /// Size of the picture in pixels, as WIDTHxHEIGHT
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// Sub-pixels along each edge of a pixel
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub subpixels: Option<u32>,
    /// How samples are spread around pixels and their parts
    #[arg(long, value_enum)]
    pub filter: Option<FilterArg>,
    /// Factor from radiance to brightness, or auto: 98 % of the lit pixels of each picture are then
    /// less bright than a screen
    #[arg(long, value_name = "X|auto", value_parser = parse_exposure, allow_negative_numbers = true)]
    pub exposure: Option<Exposure>,
    /// What becomes of what is brighter than a screen
    #[arg(long, value_enum)]
    pub tone: Option<ToneArg>,
    /// Exponent of the screen, or srgb
    #[arg(long, value_name = "X|srgb", value_parser = parse_gamma, allow_negative_numbers = true)]
    pub gamma: Option<Gamma>,
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
    /// surface [default: 30]
    #[arg(long, value_name = "DEGREES", value_parser = parse_angle, allow_negative_numbers = true)]
    pub crease_angle: Option<f64>,
    /// Samples per sub-pixel
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub samples: Option<u32>,
    /// How light that comes straight from emitters is shown: as patches have it, in a
    /// patch-constant and a smooth picture, or as it is at every sample, in one picture
    /// [default: patches]
    #[arg(long, value_enum)]
    pub direct: Option<DirectArg>,
    /// Look around from each sample for the light that is reflected more often, in N directions
    /// [default: 4]; light straight from emitters is exact then
    #[arg(long, value_name = "N", num_args = 0..=1, value_parser = parse_directions, conflicts_with = "direct")]
    pub gather: Option<Option<u32>>,
    /// The pictures to make, instead [default: constant,smooth]
    #[arg(
        long,
        value_enum,
        value_delimiter = ',',
        value_name = "SHADING,..",
        conflicts_with = "direct"
    )]
    pub shading: Vec<ShadingArg>,
    /// Take up to N times as many samples where a pixel shows several faces of different
    /// brightness [default: 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub adaptive: Option<u32>,
    /// Folder for the pictures [default: out]
    #[arg(help_heading = "Results", long, short, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// File formats of the pictures
    #[arg(help_heading = "Results", long, value_enum, value_delimiter = ',', default_values = ["ppm", "png"])]
    pub format: Vec<FormatArg>,
    /// Show no small picture in the terminal
    #[arg(help_heading = "Run", long)]
    pub no_live: bool,
}

impl ImageArgs {
    pub(crate) fn apply(&self, scene: &mut Scene) {
        let image = &mut scene.image;
        set(&mut image.width, self.size.map(|(width, _)| width));
        set(&mut image.height, self.size.map(|(_, height)| height));
        set(&mut image.subpixels, self.subpixels);
        let filter = self.filter.map(|filter| match filter {
            FilterArg::Tents => PixelFilter::Tents,
            FilterArg::Box => PixelFilter::Box,
            FilterArg::Tent => PixelFilter::Tent,
            FilterArg::Mitchell => PixelFilter::Mitchell,
        });
        set(&mut image.filter, filter);
        set(&mut image.exposure, self.exposure);
        let tone = self.tone.map(|tone| match tone {
            ToneArg::Clamp => Tone::Clamp,
            ToneArg::Reinhard => Tone::Reinhard,
            ToneArg::Filmic => Tone::Filmic,
        });
        set(&mut image.tone, tone);
        set(&mut image.gamma, self.gamma);
        image.dither |= self.dither;
    }
}

impl DisplayArgs {
    pub(crate) fn apply(&self, scene: &mut Scene) {
        self.image.apply(scene);
        self.views.apply(scene);
        set(&mut scene.image.samples, self.samples);
        set(&mut scene.image.adaptive, self.adaptive);
        set(&mut scene.image.directions, self.gather.flatten());
        set(&mut scene.image.crease_angle, self.crease_angle);
        set(&mut scene.image.lumens_per_watt, self.show.lumens_per_watt);
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
