//! From radiance to what a screen shows.

use crate::image::Image;

/// `clamp(exposure * L, 0, 1) ^ (1 / gamma)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToneMap {
    /// Radiance times this is shown at full brightness from 1 on.
    pub exposure: f64,
    /// The screen's exponent.
    pub gamma: f64,
}

/// An 8-bit picture, ready for display, row by row from the top left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Red, green and blue of each pixel.
    pub bytes: Vec<u8>,
}

impl ToneMap {
    /// Applies it to every pixel.
    pub fn apply(&self, image: &Image) -> Picture {
        let level = |radiance: f32| {
            let shown = (self.exposure * f64::from(radiance)).clamp(0.0, 1.0);
            (shown.powf(1.0 / self.gamma) * 255.0).round() as u8
        };
        Picture {
            width: image.width,
            height: image.height,
            bytes: image.pixels.iter().flatten().map(|&x| level(x)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_follow_the_formula() {
        let image = Image {
            width: 2,
            height: 1,
            pixels: vec![[0.0, 0.25, 0.125], [-1.0, 7.0, f32::NAN]],
        };
        let picture = ToneMap {
            exposure: 4.0,
            gamma: 2.2,
        }
        .apply(&image);
        // 0.5^(1/2.2) = 0.72974; not a number is shown black.
        assert_eq!(picture.bytes, [0, 255, 186, 0, 255, 0]);
    }
}
