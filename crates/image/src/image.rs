//! Linear images.

use crate::Rgb;

/// An image of linear radiance in W/(m^2 sr), row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// `width * height` pixels.
    pub pixels: Vec<Rgb>,
}

/// One number per pixel, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// `width * height` numbers.
    pub values: Vec<f32>,
}

impl Image {
    /// A black image.
    pub fn black(width: u32, height: u32) -> Image {
        Image {
            width,
            height,
            pixels: vec![[0.0; 3]; width as usize * height as usize],
        }
    }

    /// Whether any pixel is not black.
    pub fn shows_something(&self) -> bool {
        self.pixels
            .as_flattened()
            .iter()
            .any(|channel| *channel > 0.0)
    }

    /// The sum of the channels, weighted.
    pub fn weighted(&self, weights: [f64; 3]) -> Values {
        let [r, g, b] = weights.map(|weight| weight as f32);
        let pixels = self.pixels.iter();
        Values {
            width: self.width,
            height: self.height,
            values: pixels.map(|p| r * p[0] + g * p[1] + b * p[2]).collect(),
        }
    }

    /// All channels times a factor.
    pub fn scaled(&self, factor: f64) -> Image {
        let factor = factor as f32;
        let pixels = self.pixels.iter();
        Image {
            pixels: pixels.map(|p| p.map(|channel| factor * channel)).collect(),
            ..*self
        }
    }
}

impl Values {
    /// A grey image of the same numbers.
    pub fn into_image(self) -> Image {
        Image {
            width: self.width,
            height: self.height,
            pixels: self.values.into_iter().map(|value| [value; 3]).collect(),
        }
    }

    /// The number at a pixel.
    pub fn at(&self, x: u32, y: u32) -> f32 {
        self.values[y as usize * self.width as usize + x as usize]
    }
}
