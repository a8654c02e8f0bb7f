//! Many pictures on one sheet.

use crate::rgb8_image::Rgb8Image;
use crate::text::{Align, INK, LINE_HEIGHT, PAPER, draw_text};
use image::RgbImage;
use image::imageops::thumbnail;

const MARGIN: u32 = 12;

/// The widest thumbnail, and the widest sheet, in pixels.
const THUMBNAIL: u32 = 320;
const SHEET: u32 = 6400;

/// How wide and high pictures may be so that so many fit on a sheet.
pub fn thumbnail_width(pictures: usize) -> u32 {
    let columns = (pictures as f64).sqrt().ceil() as u32;
    (SHEET / columns.max(1)).clamp(1, THUMBNAIL)
}

impl Rgb8Image {
    /// The same, not wider or higher than this.
    pub fn thumbnail(&self, most: u32) -> Rgb8Image {
        let longest = self.width.max(self.height);
        if longest <= most {
            return self.clone();
        }
        let scaled = |edge: u32| {
            let edge = u64::from(edge) * u64::from(most) / u64::from(longest);
            (edge as u32).max(1)
        };
        let image = RgbImage::from_raw(self.width, self.height, self.bytes.clone());
        let image = image.expect("the size is that of the picture");
        let small = thumbnail(&image, scaled(self.width), scaled(self.height));
        Rgb8Image {
            width: small.width(),
            height: small.height(),
            bytes: small.into_raw(),
        }
    }
}

/// Pictures side by side, in rows about as many as there are columns, each above its name.
pub fn contact_sheet(pictures: &[(String, Rgb8Image)]) -> Rgb8Image {
    let count = pictures.len() as u32;
    let columns = f64::from(count).sqrt().ceil() as u32;
    let rows = count.div_ceil(columns.max(1));
    let largest = |size: fn(&Rgb8Image) -> u32| {
        let sizes = pictures.iter().map(|(_, picture)| size(picture));
        sizes.max().unwrap_or(0)
    };
    let width = largest(|picture| picture.width) + MARGIN;
    let height = largest(|picture| picture.height) + LINE_HEIGHT + MARGIN;
    let mut sheet = Rgb8Image::plain(columns * width + MARGIN, rows * height + MARGIN, PAPER);
    for ((name, picture), k) in pictures.iter().zip(0..) {
        let place = (MARGIN + k % columns * width, MARGIN + k / columns * height);
        sheet.paste(picture, place);
        let below = (place.0 + picture.width / 2, place.1 + picture.height + 2);
        draw_text(&mut sheet, name, below, INK, Align::Center);
    }
    sheet
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_picture_has_its_place() {
        let picture = |level: u8| Rgb8Image::plain(40, 30, [level; 3]);
        let pictures: Vec<(String, Rgb8Image)> = (1..=5)
            .map(|k| (format!("p{k}"), picture(40 * k)))
            .collect();
        let sheet = contact_sheet(&pictures);
        assert_eq!((sheet.width, sheet.height), (3 * 52 + 12, 2 * 57 + 12));
        let at = |x: u32, y: u32| sheet.bytes[3 * (y * sheet.width + x) as usize];
        // The fifth is the second of the second row.
        assert_eq!(at(12 + 52 + 20, 12 + 57 + 15), 200);
        assert_eq!(at(12 + 104 + 20, 12 + 57 + 15), PAPER[0]);
        assert_eq!(contact_sheet(&[]).bytes.len(), 12 * 12 * 3);
        let small = Rgb8Image::plain(1280, 720, [7, 8, 9]).thumbnail(320);
        assert_eq!((small.width, small.height), (320, 180));
        assert_eq!(small.bytes[..3], [7, 8, 9]);
        assert_eq!(
            [1, 4, 401, 1_000_000].map(thumbnail_width),
            [320, 320, 304, 6]
        );
    }
}
