//! Choices on the command line.

use clap::ValueEnum;

/// [`By`](radiosity::By) on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ByArg {
    /// Patches, in the order of the input
    Patch,
    /// Surfaces: the mean over their patches, weighted by area
    Surface,
    /// Groups of surfaces, as the scene names them, and of faces, as mesh files do
    Group,
}

/// [`Mode`](radiosity::scene::Mode) on the command line.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ModeArg {
    /// Fixed points on each patch, all pairs of them
    Regular,
    /// Exact where nothing stands between two patches, times their visible share where something
    /// does, to a --tolerance
    Accurate,
    /// Random points; its variance is unbounded where patches touch, so it needs many pairs
    /// there, or the solution may not exist
    MonteCarlo,
}

/// [`PixelFilter`](radiosity::geometry::PixelFilter) on the command line.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum FilterArg {
    /// A tent around each sub-pixel that overlaps its neighbours: the course's filter
    Tents,
    /// Evenly over the pixel
    Box,
    /// A tent around the pixel that reaches the neighbours' centres
    Tent,
    /// Mitchell and Netravali's cubic: sharp, but with dark lines round lamps far brighter than a screen
    Mitchell,
}

/// [`Tone`](radiosity::scene::Tone) on the command line.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ToneArg {
    /// It is white: the course's way
    Clamp,
    /// Luminance is compressed, up to the brightest of the picture (Reinhard 2002)
    Reinhard,
    /// The response of a film (Hable 2010)
    Filmic,
}

/// [`Backs`](radiosity::geometry::Backs) on the command line.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum BacksArg {
    /// They are black
    Black,
    /// The camera looks through them: into a room from outside
    Transparent,
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

/// [`Quantity`](radiosity::Quantity) on the command line, and how it is shown.
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

/// [`SolverMethod`](radiosity::scene::SolverMethod) on the command line.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum SolverArg {
    /// Row after row, with the newest values of all others
    GaussSeidel,
    /// Conjugate gradients: the fewest passes where light is reflected often
    #[value(alias = "conjugate-gradients")]
    Cg,
}
