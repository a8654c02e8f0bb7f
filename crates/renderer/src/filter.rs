//! Where the samples of a pixel lie.

use rand::{Rng, RngExt};

/// The course's pixel filter: `subpixels x subpixels` parts of a pixel, each with samples drawn
/// from a tent of half-width one sub-pixel around its centre, all of equal weight. With 2 x 2
/// parts a pixel's support is -0.25 .. 1.25.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SubpixelTents {
    pub(crate) subpixels: u32,
    pub(crate) samples: u32,
}

impl SubpixelTents {
    pub(crate) fn count(&self) -> u32 {
        self.subpixels * self.subpixels * self.samples
    }

    /// The offset of sample `index` from the pixel's top left corner, in pixels.
    pub(crate) fn offset(&self, index: u32, rng: &mut impl Rng) -> (f64, f64) {
        let part = index / self.samples;
        let (row, column) = (part / self.subpixels, part % self.subpixels);
        let mut along = |part: u32| {
            let centre = f64::from(part) + 0.5;
            (centre + tent(rng.random())) / f64::from(self.subpixels)
        };
        (along(column), along(row))
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
    use rand::SeedableRng;

    #[test]
    fn samples_have_the_filters_support_and_moments() {
        let filter = SubpixelTents {
            subpixels: 2,
            samples: 4,
        };
        let mut rng = rand_pcg::Pcg64Mcg::seed_from_u64(1);
        let rounds = 20_000;
        let (mut sum, mut squares) = (0.0, 0.0);
        for index in (0..filter.count()).cycle().take(rounds * 16) {
            let (x, y) = filter.offset(index, &mut rng);
            for t in [x, y] {
                assert!((-0.25..=1.25).contains(&t));
                sum += t;
                squares += (t - 0.5) * (t - 0.5);
            }
        }
        let n = 32.0 * rounds as f64;
        // Variance 1/16 between sub-pixels and (1/6) / 4 within; five standard errors.
        let variance = 1.0 / 16.0 + 1.0 / 24.0;
        assert!((sum / n - 0.5).abs() < 5.0 * (variance / n).sqrt());
        assert!((squares / n - variance).abs() < 5.0 * variance * (2.0 / n).sqrt());
    }
}
