//! Text on pictures.

use crate::rgb8_image::Rgb8Image;
use embedded_graphics::mono_font::iso_8859_1::FONT_7X13;
use embedded_graphics::mono_font::{MonoFont, MonoTextStyle};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::{Dimensions, DrawTarget, Drawable, Pixel, Point, RgbColor, Size};
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::{Alignment, Baseline, Text, TextStyleBuilder};
use std::convert::Infallible;

const FONT: &MonoFont<'_> = &FONT_7X13;
/// Beside pictures.
pub(crate) const PAPER: [u8; 3] = [24, 24, 24];
pub(crate) const INK: [u8; 3] = [225, 225, 225];
/// From one line to the next.
pub(crate) const LINE_HEIGHT: u32 = 15;

/// Where a text stands, as seen from its place.
#[derive(Clone, Copy)]
pub(crate) enum Align {
    /// It begins there.
    Left,
    /// Its middle is there.
    Center,
}

/// How wide a text is, in pixels.
pub(crate) fn text_width(text: &str) -> u32 {
    text.chars().count() as u32 * (FONT.character_size.width + FONT.character_spacing)
}

/// Writes a line whose upper end is at a pixel.
pub(crate) fn draw_text(
    picture: &mut Rgb8Image,
    text: &str,
    (x, y): (u32, u32),
    [r, g, b]: [u8; 3],
    align: Align,
) {
    let alignment = match align {
        Align::Left => Alignment::Left,
        Align::Center => Alignment::Center,
    };
    let layout = TextStyleBuilder::new()
        .alignment(alignment)
        .baseline(Baseline::Top)
        .build();
    let style = MonoTextStyle::new(FONT, Rgb888::new(r, g, b));
    let at = Point::new(x as i32, y as i32);
    let Ok(_) = Text::with_text_style(text, at, style, layout).draw(&mut Canvas(picture));
}

/// Where letters are drawn.
struct Canvas<'a>(&'a mut Rgb8Image);

impl Dimensions for Canvas<'_> {
    fn bounding_box(&self) -> Rectangle {
        Rectangle::new(Point::zero(), Size::new(self.0.width, self.0.height))
    }
}

impl DrawTarget for Canvas<'_> {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<Rgb888>>,
    {
        let area = self.bounding_box();
        for Pixel(at, color) in pixels {
            if area.contains(at) {
                let index = at.y as usize * self.0.width as usize + at.x as usize;
                let color = [color.r(), color.g(), color.b()];
                self.0.bytes[3 * index..3 * index + 3].copy_from_slice(&color);
            }
        }
        Ok(())
    }
}
