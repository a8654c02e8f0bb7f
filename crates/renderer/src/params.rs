//! The parameters of pictures.

use radiosity_geometry::{Backs, Film, PixelFilter};
use radiosity_image::{Curve, Exposure, ToneMap, Transfer};
use radiosity_params::{OutOfRange, Parameters, is_positive};
use serde::{Deserialize, Serialize};

/// How pictures are sampled, shaded and shown: `[image]` of a scene file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ImageParams {
    /// Pixels across, 1 to 65536. Default: 640.
    pub width: u32,
    /// Pixels down, 1 to 65536. Default: 480.
    pub height: u32,
    /// Sub-pixels along each edge of a pixel, 1 to 64. Default: 2.
    pub subpixels: u32,
    /// How samples are spread around sub-pixels; wide filters take the mean of sub-pixels instead.
    /// Default: tents.
    pub filter: PixelFilter,
    /// Samples per sub-pixel, 1 to 64. Default: 4.
    pub samples: u32,
    /// How many times as many samples a pixel may take that shows several faces of different
    /// brightness, 1 to 64; with 1, every pixel takes the same number. Default: 1.
    pub adaptive: u32,
    /// Directions in which [`Shading::Gathered`](crate::Shading::Gathered) looks from each sample,
    /// 1 to 4096. Default: 4.
    pub directions: u32,
    /// What is seen of the backs of faces. Default: black.
    pub backs: Backs,
    /// Degrees between normals below which neighbouring faces of a mesh are shaded as one smooth
    /// surface, 0 to 180. Default: 30.
    pub crease_angle: f64,
    /// The factor from radiance, in W/(m^2 sr), to brightness, or "auto". Default: auto.
    #[serde(with = "radiosity_params::number_or_word")]
    pub exposure: Exposure,
    /// What becomes of what is then brighter than a screen. Default: clamp.
    pub tone: Curve,
    /// The exponent of the screen, or "srgb". Default: srgb.
    #[serde(with = "radiosity_params::number_or_word")]
    pub gamma: Transfer,
    /// Whether levels are dithered. Default: false.
    pub dither: bool,
    /// Whether samples are clamped to what a screen can show before they are averaged, in pictures
    /// for people: the edges of lamps are smooth then. Linear images are not clamped. The course
    /// averages first. Default: true.
    pub clamp_samples: bool,
    /// The radiance to which samples are clamped, in W/(m^2 sr). Default: infinite, for linear
    /// images; [`ImageParams::for_screens`] sets it.
    #[serde(skip)]
    pub brightest: f32,
    /// The luminous flux of a watt of light, for illuminance, in lm/W. Default: 683, that of green
    /// light of 540 THz (BIPM, "The International System of Units", 9th edition, 2019).
    pub lumens_per_watt: f64,
    /// Seed of the sample positions. Default: 0.
    pub seed: u64,
}

impl Default for ImageParams {
    fn default() -> ImageParams {
        ImageParams {
            width: 640,
            height: 480,
            subpixels: 2,
            filter: PixelFilter::default(),
            samples: 4,
            adaptive: 1,
            directions: 4,
            backs: Backs::default(),
            crease_angle: 30.0,
            exposure: Exposure::Automatic,
            tone: Curve::default(),
            gamma: Transfer::Srgb,
            dither: false,
            clamp_samples: true,
            brightest: f32::INFINITY,
            lumens_per_watt: 683.0,
            seed: 0,
        }
    }
}

impl Parameters for ImageParams {
    fn check(&self) -> Result<(), OutOfRange> {
        let whole =
            |value, most, key, range| OutOfRange::unless((1..=most).contains(&value), key, range);
        whole(self.width, 1 << 16, "width", "between 1 and 65536")?;
        whole(self.height, 1 << 16, "height", "between 1 and 65536")?;
        whole(self.subpixels, 64, "subpixels", "between 1 and 64")?;
        whole(self.samples, 64, "samples", "between 1 and 64")?;
        whole(self.adaptive, 64, "adaptive", "between 1 and 64")?;
        whole(self.directions, 4096, "directions", "between 1 and 4096")?;
        let crease = (0.0..=180.0).contains(&self.crease_angle);
        OutOfRange::unless(crease, "crease_angle", "between 0 and 180 degrees")?;
        let exposure = match self.exposure {
            Exposure::Fixed(factor) => is_positive(factor),
            Exposure::Automatic => true,
        };
        OutOfRange::unless(exposure, "exposure", "a positive number, or \"auto\"")?;
        let gamma = match self.gamma {
            Transfer::Gamma(gamma) => is_positive(gamma),
            Transfer::Srgb => true,
        };
        OutOfRange::unless(gamma, "gamma", "a positive number, or \"srgb\"")?;
        let lumens = is_positive(self.lumens_per_watt);
        OutOfRange::unless(lumens, "lumens_per_watt", "a positive number")
    }
}

impl ImageParams {
    /// From radiance to levels.
    pub fn tone_map(&self) -> ToneMap {
        ToneMap {
            exposure: self.exposure,
            curve: self.tone,
            transfer: self.gamma,
            dither: self.dither,
        }
    }

    /// For images that screens will show at an exposure.
    pub fn for_screens(&self, exposure: f64) -> ImageParams {
        let white = self.tone.white() / exposure as f32;
        ImageParams {
            exposure: Exposure::Fixed(exposure),
            brightest: if self.clamp_samples {
                white
            } else {
                f32::INFINITY
            },
            ..*self
        }
    }

    /// For images of radiance as it is.
    pub fn linear(&self) -> ImageParams {
        ImageParams {
            brightest: f32::INFINITY,
            ..*self
        }
    }

    /// For a picture of sub-pixels, each of which is a pixel.
    pub(crate) fn of_parts(&self) -> ImageParams {
        ImageParams {
            width: self.width * self.subpixels,
            height: self.height * self.subpixels,
            subpixels: 1,
            filter: PixelFilter::Box,
            ..*self
        }
    }

    /// The pixels of the picture.
    pub fn film(&self) -> Film {
        Film {
            width: self.width,
            height: self.height,
            subpixels: self.subpixels,
            filter: self.filter,
        }
    }
}
