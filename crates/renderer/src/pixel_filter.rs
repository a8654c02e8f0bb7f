//! Wide reconstruction filters, from an image of sub-pixels.
//!
//! Samples that are shared by neighbouring pixels leave no noise of their own, which random places
//! in a filter with negative lobes do (Mitchell & Netravali 1988, section 3).

use crate::{Rgb, add_scaled};
use radiosity_geometry::PixelFilter;
use radiosity_image::Image;
use rayon::prelude::*;

/// An image of pixels, from one of `subpixels x subpixels` parts of each. At the border, what lies
/// beyond does not count.
pub(crate) fn filtered(parts: &Image, subpixels: u32, filter: PixelFilter) -> Image {
    let (width, height) = (parts.width / subpixels, parts.height / subpixels);
    let across = |row: &[Rgb]| -> Vec<Rgb> {
        let at = |x| weighted(x, subpixels, filter, parts.width, |k| row[k as usize]);
        (0..width).map(at).collect()
    };
    let rows = parts.pixels.par_chunks(parts.width as usize);
    let narrow: Vec<Vec<Rgb>> = rows.map(across).collect();
    let row = |y: u32| {
        let at = |x: u32| {
            let column = |k: u32| narrow[k as usize][x as usize];
            weighted(y, subpixels, filter, parts.height, column)
        };
        (0..width).map(at).collect::<Vec<Rgb>>()
    };
    Image {
        width,
        height,
        pixels: (0..height).into_par_iter().flat_map_iter(row).collect(),
    }
}

/// The mean around a pixel of a row of parts, by the filter's weight at their centres.
fn weighted(
    pixel: u32,
    subpixels: u32,
    filter: PixelFilter,
    parts: u32,
    value: impl Fn(u32) -> Rgb,
) -> Rgb {
    let reach = filter.half_width(subpixels);
    let center = (f64::from(pixel) + 0.5) * f64::from(subpixels);
    let span = reach * f64::from(subpixels);
    let first = (center - span).floor().max(0.0) as u32;
    let end = ((center + span).ceil() as u32).min(parts);
    let (mut sum, mut weights) = ([0.0; 3], 0.0);
    for part in first..end {
        let distance = (f64::from(part) + 0.5 - center) / f64::from(subpixels);
        let weight = filter.value(distance, subpixels) as f32;
        add_scaled(&mut sum, weight, value(part));
        weights += weight;
    }
    sum.map(|channel| channel / weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(value: impl Fn(f32, f32) -> f32) -> Image {
        let (width, height) = (40, 24);
        let at = |k: u32| [value((k % width) as f32 + 0.5, (k / width) as f32 + 0.5); 3];
        Image {
            width,
            height,
            pixels: (0..width * height).map(at).collect(),
        }
    }

    /// Sums of filters shifted by whole pixels are constant, and both are symmetric.
    #[test]
    fn lines_are_kept_away_from_the_border() {
        for filter in [PixelFilter::Tent, PixelFilter::Mitchell] {
            let found = filtered(&image(|x, y| 1.0 + 2.0 * x - y), 2, filter);
            assert_eq!((found.width, found.height), (20, 12));
            for y in 2..10 {
                for x in 2..18 {
                    let expected = 1.0 + 4.0 * (x as f32 + 0.5) - 2.0 * (y as f32 + 0.5);
                    let found = found.pixels[20 * y + x][0];
                    assert!(
                        (found - expected).abs() < 1e-4,
                        "{filter:?} {found} {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn constants_are_kept_everywhere() {
        for filter in [PixelFilter::Tent, PixelFilter::Mitchell] {
            let found = filtered(&image(|_, _| 3.0), 4, filter);
            assert!(
                found
                    .pixels
                    .iter()
                    .all(|pixel| (pixel[0] - 3.0).abs() < 1e-5)
            );
        }
    }

    /// Beside an edge, Mitchell's filter goes beyond both sides, as it is meant to.
    #[test]
    fn edges_are_sharpened() {
        let found = filtered(
            &image(|x, _| if x < 20.0 { 1.0 } else { 2.0 }),
            2,
            PixelFilter::Mitchell,
        );
        let row: Vec<f32> = found.pixels[120..140].iter().map(|p| p[0]).collect();
        assert!(row[8] < 0.995 && row[11] > 2.005, "{row:?}");
    }
}
