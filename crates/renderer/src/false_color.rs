//! Numbers as colours: which number has which, and the legend that says so.

use crate::image::{Values, percentile};
use crate::lettering::{Align, INK, LINE, PAPER, letter, width_of};
use crate::picture::Picture;
use colorous::VIRIDIS;

/// Which numbers colours stand for: from dark blue to yellow, in steps that look alike, also to those
/// who do not tell red from green (Smith & van der Walt's "viridis", 2015). Nothing at all is black.
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
        let numbers = values.values.iter().copied();
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
    fn position(&self, value: f64) -> Option<f64> {
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
        let position = self.position(value);
        position.map_or(NOTHING, |at| VIRIDIS.eval_continuous(at).into_array())
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
    pub fn paint(&self, values: &Values) -> Picture {
        let numbers = values.values.iter();
        Picture {
            width: values.width,
            height: values.height,
            bytes: numbers.flat_map(|v| self.color(f64::from(*v))).collect(),
        }
    }
}

const MARGIN: u32 = 10;
const BAR: u32 = 16;
const TICK: u32 = 4;

/// Adds a legend to the right of a picture: the quantity, its unit, and which numbers the colours
/// stand for.
pub fn with_legend(picture: &Picture, scale: &ColorScale, name: &str, unit: &str) -> Picture {
    let ticks = scale.ticks();
    let labels: Vec<String> = ticks.iter().map(|tick| number(*tick)).collect();
    let beside_bar = BAR + TICK + MARGIN / 2;
    let texts = labels.iter().map(|label| beside_bar + width_of(label));
    let titles = [name, unit].map(width_of);
    let widest = texts.chain(titles).max().unwrap_or(beside_bar);
    let mut result = Picture::plain(picture.width + 2 * MARGIN + widest, picture.height, PAPER);
    result.paste(picture, (0, 0));
    let left = picture.width + MARGIN;
    letter(&mut result, name, (left, MARGIN), INK, Align::Left);
    letter(&mut result, unit, (left, MARGIN + LINE), INK, Align::Left);
    let top = MARGIN + 3 * LINE;
    let Some(height) = picture.height.checked_sub(top + MARGIN + LINE / 2 + 1) else {
        return result;
    };
    for y in 0..=height {
        let at = 1.0 - f64::from(y) / f64::from(height.max(1));
        let color = VIRIDIS.eval_continuous(at).into_array();
        result.paste(&Picture::plain(BAR, 1, color), (left, top + y));
    }
    let mut free_to = u32::MAX;
    for (tick, label) in ticks.iter().zip(&labels) {
        let at = scale.position(*tick).unwrap_or(0.0);
        let y = top + ((1.0 - at) * f64::from(height)).round() as u32;
        if y + LINE > free_to {
            continue;
        }
        free_to = y;
        result.paste(&Picture::plain(TICK, 1, INK), (left + BAR, y));
        let beside = (left + beside_bar, y.saturating_sub(LINE / 2));
        letter(&mut result, label, beside, INK, Align::Left);
    }
    result
}

/// With three digits, as short as it gets.
fn number(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let trimmed = |text: &str| {
        let digits = text.trim_end_matches('0');
        digits.trim_end_matches('.').to_owned()
    };
    if !(1e-3..1e6).contains(&x) {
        let text = format!("{x:.2e}");
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{power}", trimmed(digits));
    }
    let decimals = (2 - x.log10().floor() as i32).max(0) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') {
        trimmed(&text)
    } else {
        text
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
        let labels = [0.0, 0.25, 5.0, 150.0, 12_345.0, 2.5e-4, 3e6].map(number);
        assert_eq!(labels, ["0", "0.25", "5", "150", "12345", "2.5e-4", "3e6"]);
    }

    /// Labels say what ticks are, of any scale; and there are not many.
    #[test]
    fn labels_are_those_of_ticks() {
        for power in -37..38 {
            for digits in [1.0, 1.5, 2.0, 3.0, 7.3] {
                let top = digits * 10f64.powi(power);
                for scale in [ColorScale::linear(top), ColorScale::logarithmic(top)] {
                    let ticks = scale.ticks();
                    assert!((3..=11).contains(&ticks.len()), "{top} {ticks:?}");
                    for tick in ticks {
                        let label: f64 = number(tick).parse().unwrap();
                        assert!((label - tick).abs() <= 1e-9 * tick, "{label} {tick}");
                    }
                }
            }
        }
    }

    /// Of a hundred numbers two are above 98, and one of them is a lamp.
    #[test]
    fn the_top_leaves_lamps_aside() {
        let mut numbers: Vec<f32> = (1..=98).map(|k| k as f32).collect();
        numbers.extend([99.0, 1e6, 0.0, f32::INFINITY]);
        assert_eq!(ColorScale::top_for(&values(numbers)), 100.0);
        assert_eq!(number(ColorScale::top_for(&values(vec![0.3; 9]))), "0.3");
        assert_eq!(ColorScale::top_for(&values(vec![0.0; 9])), 1.0);
    }

    #[test]
    fn a_legend_stands_beside_the_picture() {
        let scale = ColorScale::linear(30.0);
        let picture = scale.paint(&values(vec![15.0; 9]));
        let tall = Picture {
            width: 1,
            height: 200,
            bytes: picture.bytes[..3].repeat(200),
        };
        let with = with_legend(&tall, &scale, "irradiance", "W/m²");
        assert!(with.width > 80 && with.height == 200);
        let middle = with.bytes[3 * with.width as usize * 100..][..3].to_vec();
        assert_eq!(middle, tall.bytes[..3]);
        let is_lettered = with.bytes.chunks_exact(3).any(|pixel| *pixel == INK);
        assert!(is_lettered);
        // Too small for anything but the picture itself is no trouble.
        assert_eq!(with_legend(&picture, &scale, "x", "y").height, 1);
    }
}
