//! The curve of a screen, from brightness to levels.

use radiosity_params::NumberOrWord;

/// How a level becomes brightness, and the other way round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Transfer {
    /// `brightness = level ^ gamma`; 2.2 is the course's.
    Gamma(f64),
    /// A line near black and `((level + 0.055) / 1.055) ^ 2.4` above it (IEC 61966-2-1).
    Srgb,
}

impl NumberOrWord for Transfer {
    const WORD: &'static str = "srgb";

    fn new(number: Option<f64>) -> Transfer {
        number.map_or(Transfer::Srgb, Transfer::Gamma)
    }

    fn number(&self) -> Option<f64> {
        match *self {
            Transfer::Gamma(gamma) => Some(gamma),
            Transfer::Srgb => None,
        }
    }
}

/// Where brightness becomes the next of 256 levels.
pub(super) struct Quantizer {
    /// The least brightness of each level but the first.
    thresholds: [f32; 255],
    /// The level at the beginning of each of equal parts of the range from 0 to 1.
    starts: Vec<u8>,
}

const PARTS: usize = 4096;

impl Transfer {
    /// The level of a brightness, both from 0 to 1.
    pub fn encode(self, brightness: f32) -> f32 {
        // Not a number is black.
        let x = brightness.clamp(0.0, 1.0).max(0.0);
        match self {
            Transfer::Gamma(gamma) => x.powf(1.0 / gamma as f32),
            Transfer::Srgb if x <= 0.003_130_8 => 12.92 * x,
            Transfer::Srgb => 1.055 * x.powf(1.0 / 2.4) - 0.055,
        }
    }

    /// The brightness of a level, both from 0 to 1.
    pub fn decode(self, level: f64) -> f64 {
        match self {
            Transfer::Gamma(gamma) => level.powf(gamma),
            Transfer::Srgb if level <= 0.040_45 => level / 12.92,
            Transfer::Srgb => ((level + 0.055) / 1.055).powf(2.4),
        }
    }

    pub(super) fn quantizer(self) -> Quantizer {
        // Black is black, however steep the curve.
        let threshold = |k: usize| {
            let brightness = self.decode((k as f64 + 0.5) / 255.0) as f32;
            brightness.max(f32::MIN_POSITIVE)
        };
        let thresholds = std::array::from_fn(threshold);
        let level = |x: f32| thresholds.partition_point(|threshold| *threshold <= x) as u8;
        let starts = (0..=PARTS).map(|k| level(k as f32 / PARTS as f32));
        Quantizer {
            starts: starts.collect(),
            thresholds,
        }
    }
}

impl Quantizer {
    /// The nearest level, without the powers that it takes to compute it.
    #[inline]
    pub(super) fn level(&self, brightness: f32) -> u8 {
        // Not a number is black.
        let x = brightness.clamp(0.0, 1.0).max(0.0);
        let mut level = self.starts[(x * PARTS as f32) as usize];
        while level < 255 && self.thresholds[usize::from(level)] <= x {
            level += 1;
        }
        level
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const ALL: [Transfer; 3] = [Transfer::Gamma(2.2), Transfer::Gamma(1.0), Transfer::Srgb];

    proptest! {
        #[test]
        fn encoding_is_undone(x in 0.0f32..=1.0) {
            for transfer in ALL {
                let back = transfer.decode(f64::from(transfer.encode(x))) as f32;
                prop_assert!((back - x).abs() < 1e-6, "{transfer:?}");
            }
        }

        #[test]
        fn levels_are_the_nearest(x in -0.1f32..1.1) {
            for transfer in ALL {
                let exact = 255.0 * transfer.encode(x);
                let level = f32::from(transfer.quantizer().level(x));
                prop_assert!((level - exact).abs() <= 0.5 + 1e-4, "{transfer:?} {level} {exact}");
            }
        }
    }

    /// Where the two parts meet, and the middle grey that everyone knows.
    #[test]
    fn srgb_has_its_published_values() {
        let joint = Transfer::Srgb.decode(0.040_45);
        assert!((joint - 0.003_130_8).abs() < 1e-6);
        assert!((255.0 * Transfer::Srgb.encode(0.214_041_14) - 127.5).abs() < 1e-2);
        assert_eq!(Transfer::Srgb.quantizer().level(f32::NAN), 0);
    }
}
