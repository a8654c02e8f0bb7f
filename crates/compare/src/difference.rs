//! Where one picture is brighter than another.

use radiosity_image::{Image, Rgb8Image, percentile};

/// A picture of differences, and what its colours mean.
#[derive(Clone, Debug, PartialEq)]
pub struct DifferencePicture {
    /// White: equal. Red: brighter than the reference. Blue: darker.
    pub picture: Rgb8Image,
    /// The difference that is shown at full colour, in W/(m^2 sr).
    pub full_scale: f64,
}

/// Of all pixels, so many show less than full colour: a few outliers must not hide the others.
const SHARE_BELOW_FULL: f64 = 0.99;

/// Shows the mean difference of the channels of two pictures of one size.
pub fn difference_picture(found: &Image, reference: &Image) -> DifferencePicture {
    let mean = |pixel: &[f32; 3]| pixel.iter().map(|&c| f64::from(c)).sum::<f64>() / 3.0;
    let pairs = found.pixels.iter().zip(&reference.pixels);
    let differences: Vec<f64> = pairs.map(|(f, r)| mean(f) - mean(r)).collect();
    // Differences of single precision may be larger than it holds.
    let sizes = differences.iter().map(|d| (d.abs() as f32).min(f32::MAX));
    let full_scale = percentile(sizes, SHARE_BELOW_FULL).map_or(0.0, f64::from);
    let color = |difference: &f64| {
        let strength = (difference / full_scale.max(f64::MIN_POSITIVE)).clamp(-1.0, 1.0);
        let faded = (255.0 * (1.0 - strength.abs())).round() as u8;
        if strength > 0.0 {
            [255, faded, faded]
        } else {
            [faded, faded, 255]
        }
    };
    DifferencePicture {
        picture: Rgb8Image {
            width: found.width,
            height: found.height,
            bytes: differences.iter().flat_map(color).collect(),
        },
        full_scale,
    }
}
