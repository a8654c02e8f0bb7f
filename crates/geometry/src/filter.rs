//! Where the samples of a pixel lie.

use glam::DVec2;

/// The course's pixel filter: `subpixels x subpixels` parts of a pixel, each with samples drawn
/// from a tent of half-width one sub-pixel around its centre, all of equal weight. With 2 x 2
/// parts a pixel's support is -0.25 .. 1.25.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SubpixelTents {
    /// Parts along each edge of a pixel.
    pub subpixels: u32,
}

impl SubpixelTents {
    /// How many parts a pixel has.
    pub fn parts(&self) -> u32 {
        self.subpixels * self.subpixels
    }

    /// The place of a sample of a part, in pixels from the pixel's top left corner; `uniform` is
    /// a random point of the unit square.
    pub fn offset(&self, part: u32, uniform: DVec2) -> DVec2 {
        let (row, column) = (part / self.subpixels, part % self.subpixels);
        let corner = DVec2::new(f64::from(column), f64::from(row));
        let in_part = 0.5 + DVec2::new(tent(uniform.x), tent(uniform.y));
        (corner + in_part) / f64::from(self.subpixels)
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

    /// Moments by the midpoint rule over a fine grid of uniform points.
    #[test]
    fn samples_have_the_filters_support_and_moments() {
        let filter = SubpixelTents { subpixels: 2 };
        let steps = 400;
        let (mut sum, mut squares, mut count) = (DVec2::ZERO, DVec2::ZERO, 0.0);
        for part in 0..filter.parts() {
            for k in 0..steps * steps {
                let cell = DVec2::new(f64::from(k % steps), f64::from(k / steps));
                let offset = filter.offset(part, (cell + 0.5) / f64::from(steps));
                assert!(offset.cmpge(DVec2::splat(-0.25)).all());
                assert!(offset.cmple(DVec2::splat(1.25)).all());
                sum += offset;
                squares += (offset - 0.5) * (offset - 0.5);
                count += 1.0;
            }
        }
        // Variance 1/16 between sub-pixels and (1/6) / 4 within. The tent grows as a square root
        // at its ends, so the midpoint rule errs by about steps^-1.5 = 1.2e-4.
        let (mean, variance) = (sum / count, squares / count);
        assert!((mean - 0.5).abs().max_element() < 1e-9);
        assert!((variance - (1.0 / 16.0 + 1.0 / 24.0)).abs().max_element() < 1.2e-4);
    }
}
