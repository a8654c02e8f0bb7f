//! Choices on the command line.

use clap::ValueEnum;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use radiosity::By;
use serde::de::value::{Error, StrDeserializer};
use serde::de::{DeserializeOwned, IntoDeserializer};

/// A choice of a parameter: its name, which scene files may use too, and what it means.
type Choice = (&'static str, &'static str);

/// Parses a parameter that has these choices.
pub(super) fn choice<T: DeserializeOwned + Clone + Send + Sync + 'static>(
    choices: &'static [Choice],
) -> impl TypedValueParser<Value = T> {
    // Method has a short name beside that of files.
    let alias = |name: &str| (name == "cg").then_some("conjugate-gradients");
    let value = |(name, help): &Choice| PossibleValue::new(*name).help(*help).aliases(alias(name));
    let parser = PossibleValuesParser::new(choices.iter().map(value));
    parser.try_map(|name| {
        let name: StrDeserializer<'_, Error> = name.as_str().into_deserializer();
        T::deserialize(name)
    })
}

/// [`Mode`](radiosity::form_factors::Mode).
pub(super) const MODES: [Choice; 3] = [
    ("regular", "Fixed points on each patch, all pairs of them"),
    (
        "accurate",
        "Exact where nothing stands between two patches, times their visible share where something \
         does, to a --tolerance",
    ),
    (
        "monte-carlo",
        "Random points; its variance is unbounded where patches touch, so it needs many pairs \
         there, or the solution may not exist",
    ),
];

/// [`PixelFilter`](radiosity::geometry::PixelFilter).
pub(super) const FILTERS: [Choice; 4] = [
    (
        "tents",
        "A tent around each sub-pixel that overlaps its neighbours: the course's filter",
    ),
    ("box", "Evenly over the pixel"),
    (
        "tent",
        "A tent around the pixel that reaches the neighbours' centres",
    ),
    (
        "mitchell",
        "Mitchell and Netravali's cubic: sharp, but with dark lines round lamps far brighter than \
         a screen",
    ),
];

/// [`Curve`](radiosity::image::Curve).
pub(super) const TONES: [Choice; 3] = [
    ("clamp", "It is white: the course's way"),
    (
        "reinhard",
        "Luminance is compressed, up to the brightest of the picture (Reinhard 2002)",
    ),
    ("filmic", "The response of a film (Hable 2010)"),
];

/// [`Backs`](radiosity::geometry::Backs).
pub(super) const BACKS: [Choice; 2] = [
    ("black", "They are black"),
    (
        "transparent",
        "The camera looks through them: into a room from outside",
    ),
];

/// [`Method`](radiosity::solver::Method).
pub(super) const METHODS: [Choice; 2] = [
    (
        "gauss-seidel",
        "Row after row, with the newest values of all others",
    ),
    (
        "cg",
        "Conjugate gradients: the fewest passes where light is reflected often",
    ),
];

/// [`By`] on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ByArg {
    /// Patches, in the order of the input
    Patch,
    /// Surfaces: the mean over their patches, weighted by area
    Surface,
    /// Groups of surfaces, as the scene names them, and of faces, as mesh files do
    Group,
}

impl From<ByArg> for By {
    fn from(by: ByArg) -> By {
        match by {
            ByArg::Patch => By::Patch,
            ByArg::Surface => By::Surface,
            ByArg::Group => By::Group,
        }
    }
}

/// [`Shading`](radiosity::renderer::Shading) on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum ShadingArg {
    /// Every patch in its own radiance
    Constant,
    /// Radiance interpolated between patches
    Smooth,
    /// Direct light at every sample, the rest interpolated: --direct exact
    Exact,
    /// All light at every sample: --gather
    Gathered,
}

/// How direct light is shown, on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DirectArg {
    /// As patches have it
    Patches,
    /// In closed form, with exact shadows; the rest is interpolated
    Exact,
}

/// File formats on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FormatArg {
    /// Portable pixmap, binary (P6)
    Ppm,
    /// Portable pixmap, text (P3)
    PlainPpm,
    /// Portable network graphics, 8 bit
    Png,
    /// Portable network graphics, 16 bit
    Png16,
    /// Portable float map: linear numbers
    Pfm,
    /// Radiance's pictures: linear numbers, to 1 %, with what they are
    Hdr,
    /// OpenEXR: linear numbers, 32 bit, with what they are
    #[cfg(feature = "openexr")]
    Exr,
}

/// [`Quantity`](radiosity::stages::Quantity) on the command line, and how it is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShowArg {
    /// All light
    Light,
    /// Light that is emitted, or reflected once
    Direct,
    /// Light that is reflected more often
    Indirect,
    /// Radiosity in false colours, W/m^2: what leaves surfaces
    Radiosity,
    /// Irradiance in false colours, W/m^2: what arrives at them
    Irradiance,
    /// Illuminance in false colours, lx
    Illuminance,
    /// The estimated errors of the form factors of each patch, in false colours
    Error,
}
