//! How an image becomes what a screen or a file holds.

use super::display_quantity::Number;
use radiosity::image::{ColorScale, Image, Rgb8Image, Rgb16Image, ToneMap, Transfer, with_legend};
use radiosity::params::NumberOrWord;
use radiosity::renderer::Outlines;
use std::cell::OnceCell;

/// Which levels numbers have.
#[derive(Clone)]
pub(super) enum Palette {
    Tones(ToneMap),
    Colors(ColorScale, Number),
}

/// An image and all that it takes to show it.
pub(super) struct DisplayImage<'a> {
    pub(super) palette: &'a Palette,
    /// The quantity over pi, clamped for screens.
    pub(super) image: &'a Image,
    /// The same as it is.
    pub(super) linear: &'a Image,
    /// Where patches end, if lines are wanted.
    pub(super) outlines: Option<&'a Outlines>,
    /// Whether lines of equal numbers are drawn over false colours.
    pub(super) isolines: bool,
    /// Whether the borders of patches are drawn.
    pub(super) patch_lines: bool,
    /// What a screen shows, once it is asked for.
    pub(super) shown: OnceCell<Rgb8Image>,
}

/// Lines over pictures.
const LINES: [u8; 3] = [255; 3];
/// Of the borders of patches, which are many.
const FAINT: f32 = 0.3;

impl Palette {
    /// The levels alone, without lines and legend.
    pub(super) fn paint(&self, image: &Image) -> Rgb8Image {
        match self {
            Palette::Tones(tone) => tone.apply(image),
            Palette::Colors(scale, number) => scale.paint(&number.of(image)),
        }
    }

    /// What a file should say: of its numbers, and of the levels that stand for them.
    pub(super) fn facts(&self) -> Vec<(&'static str, String)> {
        match self {
            Palette::Tones(tone) => {
                let exposure = tone.exposure.number();
                vec![
                    ("Quantity", "radiance".to_owned()),
                    ("Unit", "W/m²/sr".to_owned()),
                    ("Exposure", exposure.unwrap_or_default().to_string()),
                ]
            }
            Palette::Colors(scale, number) => vec![
                ("Quantity", number.title.to_owned()),
                ("Unit", number.unit.clone()),
                ("Brightest colour", format!("{}", scale.top())),
            ],
        }
    }

    /// The curve that levels are made by.
    pub(super) fn transfer(&self) -> Transfer {
        match self {
            Palette::Tones(tone) => tone.transfer,
            Palette::Colors(..) => Transfer::Srgb,
        }
    }
}

impl DisplayImage<'_> {
    /// What a screen shows.
    pub(super) fn screen(&self) -> &Rgb8Image {
        self.shown.get_or_init(|| self.show())
    }

    fn show(&self) -> Rgb8Image {
        let mut picture = self.palette.paint(self.image);
        if let Some(outlines) = self.outlines {
            if let Palette::Colors(scale, number) = self.palette
                && self.isolines
            {
                let levels = scale.ticks();
                outlines.draw_isolines(&mut picture, &number.of(self.image), &levels);
            }
            if self.patch_lines {
                outlines.draw(&mut picture, LINES, FAINT);
            }
        }
        match self.palette {
            Palette::Tones(_) => picture,
            Palette::Colors(scale, number) => {
                with_legend(&picture, scale, number.title, &number.unit)
            }
        }
    }

    /// The same with 16 bits; false colours and lines have no more than 8.
    pub(super) fn deep_screen(&self) -> Rgb16Image {
        match self.palette {
            Palette::Tones(tone) if !self.patch_lines => tone.apply16(self.image),
            _ => self.screen().to_rgb16(),
        }
    }

    /// The numbers.
    pub(super) fn linear(&self) -> Image {
        match self.palette {
            Palette::Tones(_) => self.linear.clone(),
            Palette::Colors(_, number) => number.linear(self.linear),
        }
    }
}
