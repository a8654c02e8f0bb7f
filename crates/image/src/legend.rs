//! The legend beside false colours: the quantity, its unit, and which numbers the colours stand
//! for.

use crate::false_color::ColorScale;
use crate::rgb8_image::Rgb8Image;
use crate::text::{Align, INK, LINE_HEIGHT, PAPER, draw_text, text_width};

/// Around the legend, in pixels.
const MARGIN: u32 = 10;
/// Width of the bar of colours.
const BAR: u32 = 16;
/// Length of a tick.
const TICK: u32 = 4;
/// From the left end of the bar to the labels.
const TO_LABELS: u32 = BAR + TICK + MARGIN / 2;

/// A tick of the bar.
struct Tick {
    /// Where on the scale, from 0 to 1.
    position: f64,
    label: String,
}

/// Where the bar of colours stands.
struct Bar {
    left: u32,
    top: u32,
    height: u32,
}

/// Adds a legend to the right of a picture: the quantity, its unit, and which numbers the colours
/// stand for. The picture is as high as before; where that is too little for a bar, there is none.
pub fn with_legend(picture: &Rgb8Image, scale: &ColorScale, name: &str, unit: &str) -> Rgb8Image {
    let ticks = ticks(scale);
    let labels = ticks.iter().map(|tick| TO_LABELS + text_width(&tick.label));
    let titles = [name, unit].map(text_width);
    let widest = labels.chain(titles).max().unwrap_or(TO_LABELS);
    let width = picture.width + 2 * MARGIN + widest;
    let mut result = Rgb8Image::plain(width, picture.height, PAPER);
    result.paste(picture, (0, 0));
    let left = picture.width + MARGIN;
    draw_text(&mut result, name, (left, MARGIN), INK, Align::Left);
    let below = (left, MARGIN + LINE_HEIGHT);
    draw_text(&mut result, unit, below, INK, Align::Left);
    let top = MARGIN + 3 * LINE_HEIGHT;
    let below_bar = MARGIN + LINE_HEIGHT / 2 + 1;
    if let Some(height) = picture.height.checked_sub(top + below_bar) {
        let bar = Bar { left, top, height };
        draw_bar(&mut result, &bar);
        draw_ticks(&mut result, &bar, &ticks);
    }
    result
}

fn ticks(scale: &ColorScale) -> Vec<Tick> {
    let tick = |number: &f64| Tick {
        position: scale.position(*number).unwrap_or(0.0),
        label: short(*number),
    };
    scale.ticks().iter().map(tick).collect()
}

/// The brightest colour on top.
fn draw_bar(picture: &mut Rgb8Image, bar: &Bar) {
    for y in 0..=bar.height {
        let position = 1.0 - f64::from(y) / f64::from(bar.height.max(1));
        let color = ColorScale::color_at(position);
        picture.paste(&Rgb8Image::plain(BAR, 1, color), (bar.left, bar.top + y));
    }
}

/// Ticks from the lowest up, without those whose labels would lie on the one below.
fn draw_ticks(picture: &mut Rgb8Image, bar: &Bar, ticks: &[Tick]) {
    let mut free_to = u32::MAX;
    for tick in ticks {
        let down = ((1.0 - tick.position) * f64::from(bar.height)).round() as u32;
        let y = bar.top + down;
        if y + LINE_HEIGHT > free_to {
            continue;
        }
        free_to = y;
        picture.paste(&Rgb8Image::plain(TICK, 1, INK), (bar.left + BAR, y));
        let beside = (bar.left + TO_LABELS, y.saturating_sub(LINE_HEIGHT / 2));
        draw_text(picture, &tick.label, beside, INK, Align::Left);
    }
}

/// A number with three digits, as short as it gets.
fn short(number: f64) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    if !(1e-3..1e6).contains(&number) {
        let text = format!("{number:.2e}");
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{power}", without_zeros(digits));
    }
    let decimals = (2 - number.log10().floor() as i32).max(0) as usize;
    let text = format!("{number:.decimals$}");
    if text.contains('.') {
        without_zeros(&text).to_owned()
    } else {
        text
    }
}

/// A decimal fraction without the zeros at its end.
fn without_zeros(digits: &str) -> &str {
    digits.trim_end_matches('0').trim_end_matches('.')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_short() {
        let labels = [0.0, 0.25, 5.0, 150.0, 12_345.0, 2.5e-4, 3e6].map(short);
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
                        let label: f64 = short(tick).parse().unwrap();
                        assert!((label - tick).abs() <= 1e-9 * tick, "{label} {tick}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_legend_stands_beside_the_picture() {
        let scale = ColorScale::linear(30.0);
        let color = ColorScale::color_at(0.5);
        let tall = Rgb8Image::plain(1, 200, color);
        let with = with_legend(&tall, &scale, "irradiance", "W/m²");
        assert!(with.width > 80 && with.height == 200);
        let middle = &with.bytes[3 * with.width as usize * 100..][..3];
        assert_eq!(middle, color);
        assert!(with.bytes.chunks_exact(3).any(|pixel| *pixel == INK));
    }

    #[test]
    fn a_picture_too_low_for_a_bar_has_none() {
        let low = Rgb8Image::plain(9, 1, [7; 3]);
        let with = with_legend(&low, &ColorScale::linear(30.0), "x", "y");
        assert_eq!(with.height, 1);
        assert_eq!(with.bytes[..27], low.bytes);
    }
}
