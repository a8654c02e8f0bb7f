//! What becomes of what is brighter than a screen.

use super::luminance;
use crate::Rgb;
use serde::{Deserialize, Serialize};

/// A curve from brightness, which has no end, to what a screen shows, from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Curve {
    #[default]
    /// `min(x, 1)`: the course's.
    Clamp,
    /// On the luminance, `L (1 + L / W^2) / (1 + L)`, where `W` is the greatest of the picture
    /// (Reinhard, Stark, Shirley & Ferwerda, "Photographic Tone Reproduction for Digital Images",
    /// SIGGRAPH 2002, eq. 4); channels keep their ratios, and are clamped.
    Reinhard,
    /// On each channel, `f(2 x) / f(11.2)` with Hable's `f`, the response of a film ("Filmic
    /// Tonemapping for Real-time Rendering", SIGGRAPH 2010 course "Color Enhancement and
    /// Rendering in Film and Game Production").
    Filmic,
}

/// The same for one picture.
#[derive(Clone, Copy, Debug)]
pub(super) enum OfPicture {
    Clamp,
    Reinhard {
        /// `1 / W^2`.
        white: f32,
    },
    Filmic,
}

/// What Hable's curve shows as white, and how much brighter he makes pictures before it.
const FILMIC_WHITE: f32 = 11.2;
const FILMIC_EXPOSURE: f32 = 2.0;

impl Curve {
    /// The brightness from which on a screen shows white. Reinhard's curve has it where a picture
    /// is brightest.
    pub fn white(self) -> f32 {
        match self {
            Curve::Clamp => 1.0,
            Curve::Reinhard => f32::INFINITY,
            Curve::Filmic => FILMIC_WHITE / FILMIC_EXPOSURE,
        }
    }

    pub(super) fn for_picture(self, luminances: &mut dyn Iterator<Item = f32>) -> OfPicture {
        match self {
            Curve::Clamp => OfPicture::Clamp,
            Curve::Filmic => OfPicture::Filmic,
            Curve::Reinhard => {
                let finite = luminances.filter(|luminance| luminance.is_finite());
                // Where nothing is brighter than a screen, nothing needs room.
                let white = finite.fold(1.0, f32::max);
                OfPicture::Reinhard {
                    white: 1.0 / (white * white),
                }
            }
        }
    }
}

impl OfPicture {
    pub(super) fn apply(self, color: Rgb) -> Rgb {
        match self {
            OfPicture::Clamp => color,
            OfPicture::Reinhard { white } => {
                let bright = luminance(color).max(0.0);
                let scale = (1.0 + bright * white) / (1.0 + bright);
                color.map(|channel| scale * channel)
            }
            OfPicture::Filmic => {
                let white = 1.0 / filmic(FILMIC_WHITE);
                color.map(|channel| white * filmic(FILMIC_EXPOSURE * channel.max(0.0)))
            }
        }
    }
}

fn filmic(x: f32) -> f32 {
    let [shoulder, linear, angle, toe, numerator, denominator] = [0.15, 0.5, 0.1, 0.2, 0.02, 0.3];
    let above = x * (shoulder * x + angle * linear) + toe * numerator;
    let below = x * (shoulder * x + linear) + toe * denominator;
    above / below - numerator / denominator
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(curve: Curve, x: f32, brightest: f32) -> f32 {
        curve
            .for_picture(&mut [brightest].into_iter())
            .apply([x; 3])[0]
    }

    #[test]
    fn curves_begin_at_black_and_end_at_white() {
        for (curve, white) in [
            (Curve::Clamp, 1.0),
            (Curve::Reinhard, 7.0),
            (Curve::Filmic, Curve::Filmic.white()),
        ] {
            assert!(at(curve, 0.0, 7.0).abs() < 1e-6, "{curve:?}");
            assert!((at(curve, white, 7.0) - 1.0).abs() < 1e-5, "{curve:?}");
            let steps = (0..100).map(|k| at(curve, white * k as f32 / 100.0, 7.0));
            assert!(steps.collect::<Vec<f32>>().is_sorted(), "{curve:?}");
        }
    }

    /// By hand: f(1) = 0.204 / 0.71 - 1 / 15, f(11.2) = 19.38 / 24.476 - 1 / 15.
    #[test]
    fn the_film_has_its_published_values() {
        assert!((filmic(1.0) - (0.204 / 0.71 - 1.0 / 15.0)).abs() < 1e-6);
        assert!((filmic(FILMIC_WHITE) - (19.38 / 24.476 - 1.0 / 15.0)).abs() < 1e-6);
    }

    #[test]
    fn reinhards_curve_keeps_colours() {
        let curve = Curve::Reinhard.for_picture(&mut [9.0].into_iter());
        let [r, g, b] = curve.apply([4.0, 2.0, 1.0]);
        assert!((r / g - 2.0).abs() < 1e-5 && (g / b - 2.0).abs() < 1e-5);
    }
}
