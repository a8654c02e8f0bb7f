//! A small picture in the terminal, before the large ones are there: two pixels in a half block of
//! each character.

use console::Term;
use radiosity::image::Rgb8Image;
use std::fmt::Write;

/// Shows pictures where the terminal has colours, and nothing elsewhere.
pub(super) struct Thumbnail {
    terminal: Option<Term>,
    /// What the last picture took, which the next one replaces.
    lines: usize,
}

/// The widest picture, in characters.
const WIDEST: u16 = 72;

impl Thumbnail {
    /// On standard error, as progress is.
    pub(super) fn new(is_wanted: bool) -> Thumbnail {
        let terminal = Term::stderr();
        let is_fit = is_wanted && terminal.is_term() && console::colors_enabled_stderr();
        Thumbnail {
            terminal: is_fit.then_some(terminal),
            lines: 0,
        }
    }

    /// The size in pixels of what is shown of pictures of a size, if anything is.
    pub(super) fn size(&self, (width, height): (u32, u32)) -> Option<(u32, u32)> {
        let (rows, columns) = self.terminal.as_ref()?.size();
        let (most_wide, most_high) = (
            f64::from(columns.min(WIDEST)),
            f64::from(rows.saturating_sub(6)) * 2.0,
        );
        let (width, height) = (f64::from(width), f64::from(height));
        let scale = (most_wide / width).min(most_high / height).min(1.0);
        let [wide, high] = [width * scale, height * scale].map(|size| size as u32);
        (wide > 1 && high > 1).then_some((wide, high / 2 * 2))
    }

    /// Shows a picture in the place of the last one. A terminal that is gone is no reason to stop.
    pub(super) fn show(&mut self, picture: &Rgb8Image) {
        let Some(terminal) = &self.terminal else {
            return;
        };
        let text = half_blocks(picture, console::true_colors_enabled_stderr());
        let _ = terminal.clear_last_lines(self.lines);
        self.lines = text.lines().count();
        let _ = terminal.write_str(&text);
    }
}

/// A picture of an even number of rows, as characters with escape sequences (ECMA-48, and
/// ISO 8613-6 for colours).
fn half_blocks(picture: &Rgb8Image, has_true_colors: bool) -> String {
    let row_length = 3 * picture.width as usize;
    let mut text = String::new();
    for rows in picture.bytes.chunks_exact(2 * row_length) {
        let (upper, lower) = rows.split_at(row_length);
        for (upper, lower) in upper
            .as_chunks::<3>()
            .0
            .iter()
            .zip(lower.as_chunks::<3>().0)
        {
            let [front, back] = [upper, lower].map(|color| color_code(*color, has_true_colors));
            write!(text, "\x1b[38;{front};48;{back}m▀").expect("strings take all text");
        }
        text.push_str("\x1b[0m\n");
    }
    text
}

/// Of 24 bits, or of the cube of 6 x 6 x 6 colours that terminals of 256 have.
fn color_code([r, g, b]: [u8; 3], has_true_colors: bool) -> String {
    if has_true_colors {
        return format!("2;{r};{g};{b}");
    }
    let [r, g, b] = [r, g, b].map(|level| (u16::from(level) * 5 + 127) / 255);
    format!("5;{}", 16 + 36 * r + 6 * g + b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_character_is_two_pixels() {
        let picture = Rgb8Image {
            width: 1,
            height: 2,
            bytes: vec![255, 0, 128, 0, 0, 0],
        };
        assert_eq!(
            half_blocks(&picture, true),
            "\x1b[38;2;255;0;128;48;2;0;0;0m▀\x1b[0m\n"
        );
        assert_eq!(
            half_blocks(&picture, false),
            "\x1b[38;5;199;48;5;16m▀\x1b[0m\n"
        );
    }

    #[test]
    fn nothing_is_shown_where_nobody_looks() {
        let mut live = Thumbnail::new(false);
        assert_eq!(live.size((640, 480)), None);
        live.show(&Rgb8Image::plain(2, 2, [0; 3]));
    }
}
