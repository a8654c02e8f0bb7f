//! How pictures are sampled.

use radiosity_geometry::{Backs, Film, PixelFilter};

/// How pictures are sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageParams {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Sub-pixels along each edge of a pixel.
    pub subpixels: u32,
    /// How samples are spread around sub-pixels; wide filters take the mean of sub-pixels instead.
    pub filter: PixelFilter,
    /// Samples per sub-pixel.
    pub samples: u32,
    /// How many times as many samples a pixel may take that shows several faces of different
    /// brightness; 1 for all as many.
    pub adaptive: u32,
    /// What is seen of the backs of faces.
    pub backs: Backs,
    /// Seed of the sample positions.
    pub seed: u64,
}

impl Default for ImageParams {
    /// The course's pictures.
    fn default() -> ImageParams {
        ImageParams {
            width: 640,
            height: 480,
            subpixels: 2,
            filter: PixelFilter::default(),
            samples: 4,
            adaptive: 1,
            backs: Backs::Black,
            seed: 0,
        }
    }
}

impl ImageParams {
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

    pub(crate) fn film(&self) -> Film {
        Film {
            width: self.width,
            height: self.height,
            subpixels: self.subpixels,
            filter: self.filter,
        }
    }
}
