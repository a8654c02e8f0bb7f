//! OpenEXR.

use super::Metadata;
use crate::image::Image;
use exr::meta::attribute::TextBytes;
use exr::prelude::{Encoding, Layer, LayerAttributes, SpecificChannels, Text, Vec2, WritableImage};
use std::io::Cursor;

/// The bytes of an OpenEXR file of linear numbers, 32-bit; what it says of itself are its comments.
pub fn encode_exr(image: &Image, metadata: &Metadata<'_>) -> Vec<u8> {
    let (width, height) = (image.width as usize, image.height as usize);
    let pixel = |at: Vec2<usize>| {
        let [r, g, b] = image.pixels[at.y() * width + at.x()];
        (r, g, b)
    };
    // Further attributes would have no order. Comments may be of any characters, though the library
    // takes them for bytes.
    let lines = metadata
        .iter()
        .map(|(key, value)| format!("{key}: {value}\n"));
    let comments = TextBytes::from_slice(lines.collect::<String>().as_bytes());
    let attributes = LayerAttributes {
        comments: Some(Text::from_bytes_unchecked(comments)),
        ..LayerAttributes::default()
    };
    let layer = Layer::new(
        (width, height),
        attributes,
        Encoding::SMALL_LOSSLESS,
        SpecificChannels::rgb(pixel),
    );
    let mut bytes = Cursor::new(Vec::new());
    exr::prelude::Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .expect("memory takes all bytes");
    bytes.into_inner()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same bytes each time, whatever the letters.
    #[test]
    fn what_is_said_has_its_order() {
        let image = Image::black(3, 2);
        let metadata = [
            ("Scene", "комната".to_owned()),
            ("Unit", "W/m²/sr".to_owned()),
            ("Software", "radiosity".to_owned()),
        ];
        let bytes = encode_exr(&image, &metadata);
        let text = "Scene: комната\nUnit: W/m²/sr\nSoftware: radiosity\n".as_bytes();
        assert!(bytes.windows(text.len()).any(|part| part == text));
        for _ in 0..20 {
            assert!(encode_exr(&image, &metadata) == bytes);
        }
    }
}
