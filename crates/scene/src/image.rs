//! `[image]`: defaults that flags override.

use crate::settings::{Automatic, value_or};
use crate::source::{SceneError, Source};
use radiosity_geometry::{Backs, PixelFilter};
use serde::Deserialize;
use toml::Spanned;

/// The picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageSettings {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Sub-pixels along each edge of a pixel.
    pub subpixels: u32,
    /// How samples are spread around sub-pixels.
    pub filter: PixelFilter,
    /// Samples per sub-pixel.
    pub samples: u32,
    /// How many times as many samples a pixel may take that shows several faces of different
    /// brightness.
    pub adaptive: u32,
    /// In how many directions final gathering looks from each sample.
    pub directions: u32,
    /// What is seen of the backs of faces.
    pub backs: Backs,
    /// Degrees between normals below which neighbouring faces are shaded as one smooth surface.
    pub crease_angle: f64,
    /// What radiance is multiplied by.
    pub exposure: Exposure,
    /// What becomes of what then exceeds 1.
    pub tone: Tone,
    /// The curve of the screen.
    pub gamma: Gamma,
    /// Whether levels are dithered.
    pub dither: bool,
    /// The luminous flux of a watt of light, for illuminance: lm/W.
    pub lumens_per_watt: f64,
    /// Seed of the positions of samples.
    pub seed: u64,
}

/// The factor from radiance to brightness.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(untagged, expecting = "a positive number, or \"auto\"")]
pub enum Exposure {
    /// A positive number.
    Factor(f64),
    /// By how bright the picture is.
    Named(Automatic),
}

/// What becomes of what is brighter than a screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tone {
    /// It is white.
    #[default]
    Clamp,
    /// Luminance is compressed, up to the brightest of the picture.
    Reinhard,
    /// The response of a film.
    Filmic,
}

/// The curve of the screen.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(untagged, expecting = "a positive number, or \"srgb\"")]
pub enum Gamma {
    /// Levels are the 1/gamma-th power of brightness.
    Exponent(f64),
    /// A standard by its name.
    Named(Standard),
}

/// The name of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Standard {
    /// IEC 61966-2-1.
    Srgb,
}

impl Exposure {
    /// The factor, unless the picture tells it.
    pub fn factor(self) -> Option<f64> {
        match self {
            Exposure::Factor(factor) => Some(factor),
            Exposure::Named(Automatic::Auto) => None,
        }
    }
}

/// The course's.
const DEFAULT_GAMMA: f64 = 2.2;
const DEFAULT_CREASE_ANGLE: f64 = 30.0;
const DEFAULT_DIRECTIONS: u32 = 4;
/// Of green light of 540 THz (BIPM, "The International System of Units", 9th edition, 2019).
const DEFAULT_LUMENS_PER_WATT: f64 = 683.0;

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ImageTable {
    width: Option<Spanned<u32>>,
    height: Option<Spanned<u32>>,
    subpixels: Option<Spanned<u32>>,
    filter: Option<PixelFilter>,
    samples: Option<Spanned<u32>>,
    adaptive: Option<Spanned<u32>>,
    directions: Option<Spanned<u32>>,
    #[serde(default)]
    backs: Backs,
    crease_angle: Option<Spanned<f64>>,
    exposure: Option<Spanned<Exposure>>,
    #[serde(default)]
    tone: Tone,
    gamma: Option<Spanned<Gamma>>,
    #[serde(default)]
    dither: bool,
    lumens_per_watt: Option<Spanned<f64>>,
    seed: Option<u64>,
}

impl ImageTable {
    pub(crate) fn check(&self, source: &Source<'_>) -> Result<ImageSettings, SceneError> {
        let whole = |entry: &Option<Spanned<u32>>, default, most, what, range| {
            let holds = |n| (1..=most).contains(&n);
            value_or(source, entry.as_ref(), default, holds, (what, range))
        };
        let size =
            |entry, default, what| whole(entry, default, 1 << 16, what, "between 1 and 65536");
        let count = |entry, default, what| whole(entry, default, 64, what, "between 1 and 64");
        let is_positive = |x: f64| x > 0.0 && x.is_finite();
        Ok(ImageSettings {
            width: size(&self.width, 640, "`width`")?,
            height: size(&self.height, 480, "`height`")?,
            subpixels: count(&self.subpixels, 2, "`subpixels`")?,
            filter: self.filter.unwrap_or_default(),
            samples: count(&self.samples, 4, "`samples`")?,
            adaptive: count(&self.adaptive, 1, "`adaptive`")?,
            directions: whole(
                &self.directions,
                DEFAULT_DIRECTIONS,
                4096,
                "`directions`",
                "between 1 and 4096",
            )?,
            backs: self.backs,
            crease_angle: value_or(
                source,
                self.crease_angle.as_ref(),
                DEFAULT_CREASE_ANGLE,
                |angle| (0.0..=180.0).contains(&angle),
                ("`crease_angle`", "between 0 and 180 degrees"),
            )?,
            exposure: value_or(
                source,
                self.exposure.as_ref(),
                Exposure::Factor(1.0),
                |exposure: Exposure| exposure.factor().is_none_or(is_positive),
                ("`exposure`", "a positive number, or \"auto\""),
            )?,
            tone: self.tone,
            gamma: value_or(
                source,
                self.gamma.as_ref(),
                Gamma::Exponent(DEFAULT_GAMMA),
                |gamma| match gamma {
                    Gamma::Exponent(gamma) => is_positive(gamma),
                    Gamma::Named(Standard::Srgb) => true,
                },
                ("`gamma`", "a positive number, or \"srgb\""),
            )?,
            dither: self.dither,
            lumens_per_watt: value_or(
                source,
                self.lumens_per_watt.as_ref(),
                DEFAULT_LUMENS_PER_WATT,
                is_positive,
                ("`lumens_per_watt`", "a positive number"),
            )?,
            seed: self.seed.unwrap_or(0),
        })
    }
}
