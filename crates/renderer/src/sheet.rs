//! Many pictures on one sheet.

use crate::lettering::{Align, LINE, letter};
use crate::picture::Picture;
use image::RgbImage;
use image::imageops::thumbnail;

const MARGIN: u32 = 12;
const PAPER: [u8; 3] = [24, 24, 24];
const INK: [u8; 3] = [225, 225, 225];

/// The widest thumbnail.
const THUMBNAIL: u32 = 320;

impl Picture {
    /// The same not wider than fits on a sheet.
    pub fn thumbnail(&self) -> Picture {
        if self.width <= THUMBNAIL {
            return self.clone();
        }
        let height = (u64::from(self.height) * u64::from(THUMBNAIL) / u64::from(self.width)) as u32;
        let image = RgbImage::from_raw(self.width, self.height, self.bytes.clone());
        let image = image.expect("the size is that of the picture");
        let small = thumbnail(&image, THUMBNAIL, height.max(1));
        Picture {
            width: small.width(),
            height: small.height(),
            bytes: small.into_raw(),
        }
    }
}

/// Pictures side by side, in rows about as many as there are columns, each above its name.
pub fn contact_sheet(pictures: &[(String, Picture)]) -> Picture {
    let count = pictures.len() as u32;
    let columns = f64::from(count).sqrt().ceil() as u32;
    let rows = count.div_ceil(columns.max(1));
    let largest = |size: fn(&Picture) -> u32| {
        let sizes = pictures.iter().map(|(_, picture)| size(picture));
        sizes.max().unwrap_or(0)
    };
    let width = largest(|picture| picture.width) + MARGIN;
    let height = largest(|picture| picture.height) + LINE + MARGIN;
    let mut sheet = Picture::plain(columns * width + MARGIN, rows * height + MARGIN, PAPER);
    for ((name, picture), k) in pictures.iter().zip(0..) {
        let place = (MARGIN + k % columns * width, MARGIN + k / columns * height);
        sheet.paste(picture, place);
        let below = (place.0 + picture.width / 2, place.1 + picture.height + 2);
        letter(&mut sheet, name, below, INK, Align::Center);
    }
    sheet
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_picture_has_its_place() {
        let picture = |level: u8| Picture::plain(40, 30, [level; 3]);
        let pictures: Vec<(String, Picture)> = (1..=5)
            .map(|k| (format!("p{k}"), picture(40 * k)))
            .collect();
        let sheet = contact_sheet(&pictures);
        assert_eq!((sheet.width, sheet.height), (3 * 52 + 12, 2 * 57 + 12));
        let at = |x: u32, y: u32| sheet.bytes[3 * (y * sheet.width + x) as usize];
        // The fifth is the second of the second row.
        assert_eq!(at(12 + 52 + 20, 12 + 57 + 15), 200);
        assert_eq!(at(12 + 104 + 20, 12 + 57 + 15), PAPER[0]);
        assert_eq!(contact_sheet(&[]).bytes.len(), 12 * 12 * 3);
        let small = Picture::plain(1280, 720, [7, 8, 9]).thumbnail();
        assert_eq!((small.width, small.height), (320, 180));
        assert_eq!(small.bytes[..3], [7, 8, 9]);
    }
}
