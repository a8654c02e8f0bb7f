//! Where the samples of a picture's pixels lie.

mod mitchell;

use crate::camera::Camera;
use crate::rays::ray::Ray;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// How samples are spread around a pixel, and how they count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PixelFilter {
    /// The course's: a tent of half-width one sub-pixel around the centre of each part. With
    /// 2 x 2 parts a pixel's support is -0.25 .. 1.25.
    #[default]
    Tents,
    /// Evenly over each part, and so over the pixel and nothing else.
    Box,
    /// A tent of half-width one pixel.
    Tent,
    /// Mitchell & Netravali's cubic with B = C = 1/3, of half-width two pixels ("Reconstruction
    /// Filters in Computer Graphics", SIGGRAPH 1988). Some of its samples count negatively.
    Mitchell,
}

/// The pixels of a picture, each of `subpixels x subpixels` parts with samples of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Film {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Parts along each edge of a pixel.
    pub subpixels: u32,
    /// How samples are spread around a part.
    pub filter: PixelFilter,
}

impl PixelFilter {
    /// Whether neighbouring pixels share most of their samples.
    pub fn is_wide(self) -> bool {
        matches!(self, PixelFilter::Tent | PixelFilter::Mitchell)
    }

    /// How far it reaches from the centre of a pixel along either axis, in pixels.
    pub fn half_width(self, subpixels: u32) -> f64 {
        match self {
            PixelFilter::Tents => 0.5 + 0.5 / f64::from(subpixels),
            PixelFilter::Box => 0.5,
            PixelFilter::Tent => 1.0,
            PixelFilter::Mitchell => mitchell::HALF_WIDTH,
        }
    }

    /// Its value along one axis, at a distance from the centre of a pixel, in pixels; the integral
    /// is 1.
    pub fn value(self, distance: f64, subpixels: u32) -> f64 {
        let tent = |from: f64, half: f64| (1.0 - (distance - from).abs() / half).max(0.0) / half;
        match self {
            PixelFilter::Box => f64::from(u8::from(distance.abs() <= 0.5)),
            PixelFilter::Tent => tent(0.0, 1.0),
            PixelFilter::Mitchell => mitchell::value(distance.abs()),
            PixelFilter::Tents => {
                let half = 1.0 / f64::from(subpixels);
                let center = |part: u32| (f64::from(part) + 0.5) * half - 0.5;
                let parts = (0..subpixels).map(|part| tent(center(part), half));
                half * parts.sum::<f64>()
            }
        }
    }
}

impl Film {
    /// How many parts a pixel has.
    pub fn parts(&self) -> u32 {
        self.subpixels * self.subpixels
    }

    /// How far samples lie from the centre of their pixel at most, along either axis.
    pub fn reach(&self) -> f64 {
        self.filter.half_width(self.subpixels)
    }

    /// The camera's ray through a sample of a part of the pixel in column `x` and row `y`, and how
    /// often it counts; `uniform` is a random point of the unit square.
    pub fn ray(&self, camera: &Camera, x: u32, y: u32, part: u32, uniform: DVec2) -> (Ray, f64) {
        let pixel = DVec2::new(f64::from(x), f64::from(y));
        let size = DVec2::new(f64::from(self.width), f64::from(self.height));
        let (offset, weight) = self.sample(part, uniform);
        let place = (pixel + offset) / size;
        (camera.ray(place.x, place.y, size.x / size.y), weight)
    }

    /// The place of a sample of a part, in pixels from the pixel's top left corner, and how often
    /// it counts: once on average.
    pub fn sample(&self, part: u32, uniform: DVec2) -> (DVec2, f64) {
        let (row, column) = (part / self.subpixels, part % self.subpixels);
        let corner = DVec2::new(f64::from(column), f64::from(row));
        let in_pixel = |in_part: DVec2| (corner + in_part) / f64::from(self.subpixels);
        let place = in_pixel(uniform);
        match self.filter {
            PixelFilter::Tents => {
                let in_part = 0.5 + DVec2::new(tent(uniform.x), tent(uniform.y));
                (in_pixel(in_part), 1.0)
            }
            PixelFilter::Box => (place, 1.0),
            PixelFilter::Tent => (0.5 + DVec2::new(tent(place.x), tent(place.y)), 1.0),
            PixelFilter::Mitchell => {
                let [(x, of_x), (y, of_y)] = [place.x, place.y].map(mitchell::sample);
                (0.5 + DVec2::new(x, y), of_x * of_y)
            }
        }
    }
}

/// A uniform number in [0, 1) to a tent-distributed one in -1 .. 1.
fn tent(uniform: f64) -> f64 {
    if uniform < 0.5 {
        (2.0 * uniform).sqrt() - 1.0
    } else {
        1.0 - (2.0 - 2.0 * uniform).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Support, and moments of second order, by the midpoint rule over a fine grid of uniform
    /// points.
    fn moments(filter: PixelFilter) -> (DVec2, DVec2, DVec2) {
        let film = Film {
            width: 1,
            height: 1,
            subpixels: 2,
            filter,
        };
        let steps = 400;
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (mut sum, mut squares, mut count) = (DVec2::ZERO, DVec2::ZERO, 0.0);
        let mut weights = 0.0;
        for part in 0..film.parts() {
            for k in 0..steps * steps {
                let cell = DVec2::new(f64::from(k % steps), f64::from(k / steps));
                let (offset, weight) = film.sample(part, (cell + 0.5) / f64::from(steps));
                (low, high) = (low.min(offset), high.max(offset));
                sum += weight * offset;
                squares += weight * (offset - 0.5) * (offset - 0.5);
                weights += weight;
                count += 1.0;
            }
        }
        assert!((weights / count - 1.0).abs() < 1e-3, "{}", weights / count);
        // The second moment again, of the filter's own values.
        let (fine, reach) = (4000, film.reach());
        let value = |k: u32| {
            let x = reach * ((2.0 * f64::from(k) + 1.0) / f64::from(fine) - 1.0);
            DVec2::new(1.0, x * x) * filter.value(x, 2) * 2.0 * reach / f64::from(fine)
        };
        let own: DVec2 = (0..fine).map(value).sum();
        assert!((own.x - 1.0).abs() < 1e-5 && (own.y - squares.x / count).abs() < 2e-3);
        assert!((sum / count - 0.5).abs().max_element() < 1e-3);
        assert!((low - 0.5).abs().max_element() <= film.reach());
        assert!((high - 0.5).abs().max_element() <= film.reach());
        (low, high, squares / count)
    }

    /// Variance 1/16 between sub-pixels and (1/6) / 4 within. The tent grows as a square root
    /// at its ends, so the midpoint rule errs by about steps^-1.5 = 1.2e-4.
    #[test]
    fn tents_overlap_the_neighbours() {
        let (low, high, variance) = moments(PixelFilter::Tents);
        assert!(low.max_element() < -0.2 && high.min_element() > 1.2);
        assert!((variance - (1.0 / 16.0 + 1.0 / 24.0)).abs().max_element() < 1.2e-4);
    }

    /// Variance 1/12, to the midpoint rule's steps^-2.
    #[test]
    fn a_box_covers_the_pixel_evenly() {
        let (low, high, variance) = moments(PixelFilter::Box);
        assert!(low.max_element() < 0.01 && high.min_element() > 0.99);
        assert!((variance - 1.0 / 12.0).abs().max_element() < 1e-5);
    }

    /// Variance 1/6.
    #[test]
    fn a_tent_reaches_the_neighbours_centres() {
        let (low, high, variance) = moments(PixelFilter::Tent);
        assert!(low.max_element() < -0.45 && high.min_element() > 1.45);
        assert!((variance - 1.0 / 6.0).abs().max_element() < 1.2e-4);
    }

    /// The cubic with B + 2 C = 1 reproduces lines and, with this B, has the second moment
    /// `B / 3 = 1/9`: that of its B-spline part.
    #[test]
    fn mitchells_filter_counts_what_is_far_negatively() {
        let (low, high, variance) = moments(PixelFilter::Mitchell);
        assert!(low.max_element() < -1.0 && high.min_element() > 2.0);
        assert!(
            (variance - 1.0 / 9.0).abs().max_element() < 2e-3,
            "{variance}"
        );
    }
}
