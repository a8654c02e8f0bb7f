//! From radiance to what a screen shows: exposure, a curve that makes room for highlights, the
//! screen's own curve, and levels.

mod curve;
mod dither;
mod transfer;

use crate::Rgb;
use crate::image::Image;
use crate::percentile::{is_lit, percentile};
use crate::rgb8_image::{Rgb8Image, Rgb16Image};
pub use curve::Curve;
use dither::noise;
use radiosity_params::NumberOrWord;
use rayon::prelude::*;
pub use transfer::Transfer;

/// How radiance becomes levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToneMap {
    /// How bright the picture is.
    pub exposure: Exposure,
    /// What becomes of what is brighter than a screen.
    pub curve: Curve,
    /// The curve of the screen.
    pub transfer: Transfer,
    /// Whether levels are dithered: bands in smooth gradients become noise of half a level.
    pub dither: bool,
}

/// The factor from radiance, in W/(m^2 sr), to brightness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// This one.
    Fixed(f64),
    /// [`Exposure::of`] the image.
    Automatic,
}

/// Of pixels that are not black, so many are less bright than this by the automatic exposure: what
/// is left to 1 is for coloured light, of which one channel is brighter than the luminance.
const AUTOMATIC_PERCENTILE: f64 = 0.98;
const AUTOMATIC_BRIGHTNESS: f32 = 0.8;

impl NumberOrWord for Exposure {
    const WORD: &'static str = "auto";

    fn new(number: Option<f64>) -> Exposure {
        number.map_or(Exposure::Automatic, Exposure::Fixed)
    }

    fn number(&self) -> Option<f64> {
        match *self {
            Exposure::Fixed(factor) => Some(factor),
            Exposure::Automatic => None,
        }
    }
}

/// What the channels of linear sRGB add to luminance (ITU-R BT.709, item 3.2).
pub const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

pub(crate) fn luminance(rgb: Rgb) -> f32 {
    let [r, g, b] = LUMINANCE.map(|weight| weight as f32);
    r * rgb[0] + g * rgb[1] + b * rgb[2]
}

impl Exposure {
    /// The factor by which 98 % of the pixels of some images that are not black are less bright
    /// than 0.8, by luminance. It has three digits, so that whoever reads it can set it. There is
    /// none if all are black.
    ///
    /// ```
    /// use radiosity_image::{Exposure, Image};
    ///
    /// let grey = Image { width: 1, height: 1, pixels: vec![[0.3; 3]] };
    /// assert_eq!(Exposure::of(&[grey]), Some(2.67));
    /// assert_eq!(Exposure::of(&[Image::black(1, 1)]), None);
    /// ```
    pub fn of(images: &[Image]) -> Option<f64> {
        let pixels = images.iter().flat_map(|image| &image.pixels);
        let lit = pixels.map(|pixel| luminance(*pixel)).filter(is_lit);
        let bright = percentile(lit, AUTOMATIC_PERCENTILE)?;
        let factor: f64 = format!("{:.2e}", AUTOMATIC_BRIGHTNESS / bright)
            .parse()
            .ok()?;
        (factor > 0.0 && factor.is_finite()).then_some(factor)
    }

    /// The factor for an image.
    fn factor(self, image: &Image) -> f32 {
        match self {
            Exposure::Fixed(factor) => factor as f32,
            Exposure::Automatic => {
                Exposure::of(std::slice::from_ref(image)).map_or(1.0, |factor| factor as f32)
            }
        }
    }
}

impl ToneMap {
    /// `transfer(min(exposure L, 1))`: the course's, with a gamma of 2.2.
    pub fn clamped(exposure: f64, transfer: Transfer) -> ToneMap {
        ToneMap {
            exposure: Exposure::Fixed(exposure),
            curve: Curve::Clamp,
            transfer,
            dither: false,
        }
    }

    /// Makes an 8-bit picture of an image.
    pub fn apply(&self, image: &Image) -> Rgb8Image {
        let quantizer = self.transfer.quantizer();
        let mut bytes = vec![0; 3 * image.pixels.len()];
        self.for_each_row(image, &mut bytes, |brightness, noise| match noise {
            None => quantizer.level(brightness),
            Some(noise) => {
                let level = 255.0 * self.transfer.encode(brightness) + noise;
                level.floor().clamp(0.0, 255.0) as u8
            }
        });
        Rgb8Image {
            width: image.width,
            height: image.height,
            bytes,
        }
    }

    /// Makes a 16-bit picture of an image.
    pub fn apply16(&self, image: &Image) -> Rgb16Image {
        let mut levels = vec![0; 3 * image.pixels.len()];
        self.for_each_row(image, &mut levels, |brightness, noise| {
            let level = 65535.0 * self.transfer.encode(brightness) + noise.unwrap_or(0.5);
            level.floor().clamp(0.0, 65535.0) as u16
        });
        Rgb16Image {
            width: image.width,
            height: image.height,
            levels,
        }
    }

    /// Turns each channel, as bright as a screen shows it, into a level; with the noise that
    /// dithers it, uniform in [0, 1), if it is dithered.
    fn for_each_row<T: Send>(
        &self,
        image: &Image,
        levels: &mut [T],
        level: impl Fn(f32, Option<f32>) -> T + Sync,
    ) {
        let width = (image.width as usize).max(1);
        let exposure = self.exposure.factor(image);
        let scale = |pixel: &Rgb| pixel.map(|channel| exposure * channel);
        let brightest = || image.pixels.iter().map(|pixel| luminance(scale(pixel)));
        let curve = self.curve.for_picture(&mut brightest());
        let rows = levels
            .par_chunks_mut(3 * width)
            .zip(image.pixels.par_chunks(width));
        rows.enumerate().for_each(|(y, (levels, pixels))| {
            for (x, (levels, pixel)) in levels.chunks_exact_mut(3).zip(pixels).enumerate() {
                let shown = curve.apply(scale(pixel));
                for (c, (to, channel)) in levels.iter_mut().zip(shown).enumerate() {
                    let noise = self.dither.then(|| noise([x as u32, y as u32, c as u32]));
                    *to = level(channel, noise);
                }
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(pixels: Vec<Rgb>) -> Image {
        Image {
            width: pixels.len() as u32,
            height: 1,
            pixels,
        }
    }

    #[test]
    fn levels_follow_the_formula() {
        let course = ToneMap::clamped(4.0, Transfer::Gamma(2.2));
        let picture = course.apply(&image(vec![[0.0, 0.25, 0.125], [-1.0, 7.0, f32::NAN]]));
        // 0.5^(1/2.2) = 0.72974; not a number is shown black.
        assert_eq!(picture.bytes, [0, 255, 186, 0, 255, 0]);
        let deep = course.apply16(&image(vec![[0.0, 0.25, 0.125], [-1.0, 7.0, f32::NAN]]));
        assert_eq!(deep.levels, [0, 65535, 47824, 0, 65535, 0]);
    }

    /// Black pixels do not count, and a lamp among a hundred is above the percentile.
    #[test]
    fn the_automatic_exposure_follows_the_percentile() {
        let mut pixels = vec![[0.0; 3]; 500];
        pixels.extend((1..=99).map(|k| [k as f32; 3]));
        pixels.push([1e6; 3]);
        let exposure = Exposure::Automatic;
        let factor = exposure.factor(&image(pixels));
        assert!((0.8 / factor - 98.0).abs() < 1.5, "{factor}");
        assert_eq!(exposure.factor(&image(vec![[0.0; 3]])), 1.0);
    }

    /// Dithered levels are right on average: 4,000 of them, with a standard deviation of half a
    /// level.
    #[test]
    fn dithering_keeps_the_mean() {
        let brightness = 0.31f32;
        let dithered = ToneMap {
            dither: true,
            ..ToneMap::clamped(1.0, Transfer::Gamma(2.2))
        };
        let picture = dithered.apply(&image(vec![[brightness; 3]; 4000]));
        let mean = picture.bytes.iter().map(|b| f64::from(*b)).sum::<f64>() / 12000.0;
        let expected = 255.0 * f64::from(brightness).powf(1.0 / 2.2);
        assert!(
            (mean - expected).abs() < 4.0 * 0.5 / 12000f64.sqrt(),
            "{mean} {expected}"
        );
        assert!(picture.bytes.iter().any(|b| *b != picture.bytes[0]));
    }
}
