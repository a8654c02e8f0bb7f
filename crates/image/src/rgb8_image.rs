//! Pictures of levels, as screens show them, and what is drawn on their pixels.

/// A picture of 8-bit levels, ready for display, row by row from the top left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rgb8Image {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Red, green and blue of each pixel.
    pub bytes: Vec<u8>,
}

/// A picture of 16-bit levels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rgb16Image {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Red, green and blue of each pixel.
    pub levels: Vec<u16>,
}

impl Rgb8Image {
    /// A picture of one colour.
    pub fn plain(width: u32, height: u32, color: [u8; 3]) -> Rgb8Image {
        Rgb8Image {
            width,
            height,
            bytes: color.repeat(width as usize * height as usize),
        }
    }

    /// The same levels with 16 bits.
    pub fn to_rgb16(&self) -> Rgb16Image {
        let bytes = self.bytes.iter();
        Rgb16Image {
            width: self.width,
            height: self.height,
            levels: bytes.map(|byte| u16::from(*byte) * 257).collect(),
        }
    }

    /// Puts another picture onto this one; what of it lies outside is cut off.
    pub(crate) fn paste(&mut self, other: &Rgb8Image, (left, top): (u32, u32)) {
        let width = 3 * other.width.min(self.width.saturating_sub(left)) as usize;
        let rows = other.height.min(self.height.saturating_sub(top));
        for y in 0..rows {
            let to = 3 * ((top + y) as usize * self.width as usize + left as usize);
            let from = 3 * y as usize * other.width as usize;
            self.bytes[to..to + width].copy_from_slice(&other.bytes[from..from + width]);
        }
    }

    /// The colour that stands out against a pixel: white, or black.
    pub fn contrast(&self, index: usize) -> [u8; 3] {
        let channels = self.bytes[3 * index..3 * index + 3].iter();
        let sum: u32 = channels
            .zip([2, 6, 1])
            .map(|(c, weight)| u32::from(*c) * weight)
            .sum();
        if sum > 9 * 150 { [0; 3] } else { [255; 3] }
    }

    /// Blends a colour into a pixel: a share of 0 leaves it as it is, 1 replaces it.
    pub fn blend(&mut self, index: usize, color: [u8; 3], share: f32) {
        for (byte, color) in self.bytes[3 * index..3 * index + 3].iter_mut().zip(color) {
            let blended = f32::from(*byte) + share * (f32::from(color) - f32::from(*byte));
            *byte = (blended + 0.5) as u8;
        }
    }
}
