//! Numbers as colours: which number has which.

use crate::image::Values;
use crate::percentile::{is_lit, percentile};
use crate::rgb8_image::Rgb8Image;
use colorous::VIRIDIS;

/// Which numbers colours stand for: from dark blue to yellow, in steps that look alike, also to
/// those who do not tell red from green (Smith & van der Walt's "viridis", 2015). Nothing at all is
/// black.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorScale {
    /// The number that has the brightest colour; larger ones have it too.
    top: f64,
    /// The share of it that has the darkest one, for a logarithmic scale.
    bottom: Option<f64>,
}

/// Decades of a logarithmic scale.
const DECADES: i32 = 3;
/// The top of automatic scales: so many of the numbers that are not 0 are below it.
const BELOW_TOP: f64 = 0.98;
/// Where there is nothing to show.
const NOTHING: [u8; 3] = [0, 0, 0];

impl ColorScale {
    /// From 0 to a number, > 0.
    pub fn linear(top: f64) -> ColorScale {
        ColorScale { top, bottom: None }
    }

    /// Over three decades up to a number, > 0.
    pub fn logarithmic(top: f64) -> ColorScale {
        ColorScale {
            top,
            bottom: Some(10f64.powi(-DECADES)),
        }
    }

    /// The number that has the brightest colour.
    pub fn top(&self) -> f64 {
        self.top
    }

    /// A round number that few of some numbers exceed: the top of a scale for them.
    pub fn top_for(values: &Values) -> f64 {
        let numbers = values.values.iter().copied().filter(is_lit);
        let Some(high) = percentile(numbers, BELOW_TOP).map(f64::from) else {
            return 1.0;
        };
        let unit = 10f64.powf(high.log10().floor());
        let round = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0].map(|step| step * unit);
        // A number that is round already must not be rounded up for its last bit.
        let is_above = |&step: &f64| step >= high * (1.0 - 1e-6);
        round.into_iter().find(is_above).unwrap_or(10.0 * unit)
    }

    /// Where on the scale a number lies, from 0 to 1; nothing at all lies nowhere.
    pub(crate) fn position(&self, value: f64) -> Option<f64> {
        if value.is_nan() || value <= 0.0 {
            return None;
        }
        let share = value / self.top;
        let position = match self.bottom {
            None => share,
            Some(bottom) => 1.0 - share.log10() / bottom.log10(),
        };
        Some(position.clamp(0.0, 1.0))
    }

    fn color(&self, value: f64) -> [u8; 3] {
        self.position(value).map_or(NOTHING, ColorScale::color_at)
    }

    /// The colour at a position from 0 to 1.
    pub(crate) fn color_at(position: f64) -> [u8; 3] {
        VIRIDIS.eval_continuous(position).into_array()
    }

    /// Round numbers on the scale.
    pub fn ticks(&self) -> Vec<f64> {
        if self.bottom.is_some() {
            let highest = self.top.log10().floor() as i32;
            let decades = (highest - DECADES..=highest).map(|power| 10f64.powi(power));
            return decades
                .filter(|tick| *tick >= self.top * 10f64.powi(-DECADES))
                .collect();
        }
        let rough = self.top / 5.0;
        let unit = 10f64.powf(rough.log10().floor());
        let steps = [1.0, 2.0, 2.5, 5.0, 10.0].map(|step| step * unit);
        // 5 to 10 of them.
        let step = steps.into_iter().rev().find(|step| *step <= rough * 1.001);
        let step = step.unwrap_or(unit);
        let count = (self.top / step * (1.0 + 1e-9)) as u32;
        (0..=count).map(|k| f64::from(k) * step).collect()
    }

    /// The numbers as colours.
    pub fn paint(&self, values: &Values) -> Rgb8Image {
        let numbers = values.values.iter();
        Rgb8Image {
            width: values.width,
            height: values.height,
            bytes: numbers.flat_map(|v| self.color(f64::from(*v))).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(values: Vec<f32>) -> Values {
        Values {
            width: values.len() as u32,
            height: 1,
            values,
        }
    }

    #[test]
    fn colors_run_from_dark_blue_to_yellow() {
        let painted = ColorScale::linear(2.0).paint(&values(vec![0.0, 1e-9, 2.0, 9.0, f32::NAN]));
        assert_eq!(
            painted.bytes.as_chunks::<3>().0,
            [
                [0, 0, 0],
                [68, 1, 84],
                [253, 231, 37],
                [253, 231, 37],
                [0, 0, 0]
            ]
        );
        // Three decades below the top it is dark, and half of them below half as bright.
        let scale = ColorScale::logarithmic(50.0);
        assert_eq!(scale.position(0.05), Some(0.0));
        let middle = scale.position(50.0 / 10f64.powf(1.5)).unwrap();
        assert!((middle - 0.5).abs() < 1e-12);
    }

    #[test]
    fn ticks_are_round() {
        let linear = |top| ColorScale::linear(top).ticks();
        assert_eq!(linear(10.0), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(linear(30.0), [0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0]);
        assert_eq!(linear(1500.0)[..3], [0.0, 250.0, 500.0]);
        assert_eq!(ColorScale::logarithmic(50.0).ticks(), [0.1, 1.0, 10.0]);
    }

    /// Of a hundred numbers two are above 98, and one of them is a lamp.
    #[test]
    fn the_top_leaves_lamps_aside() {
        let mut numbers: Vec<f32> = (1..=98).map(|k| k as f32).collect();
        numbers.extend([99.0, 1e6, 0.0, f32::INFINITY]);
        assert_eq!(ColorScale::top_for(&values(numbers)), 100.0);
        // 0.3 in single precision is a little more, and must not become 0.4.
        let top = ColorScale::top_for(&values(vec![0.3; 9]));
        assert!((top - 0.3).abs() < 1e-6, "{top}");
        assert_eq!(ColorScale::top_for(&values(vec![0.0; 9])), 1.0);
    }
}
