//! OpenEXR.

use super::Metadata;
use crate::image::Image;
use exr::prelude::{
    AttributeValue, Encoding, Layer, LayerAttributes, SpecificChannels, Text, Vec2, WritableImage,
};
use std::io::Cursor;

/// The bytes of an OpenEXR file of linear numbers, 32-bit; what it says of itself are text attributes.
pub fn encode_exr(image: &Image, metadata: &Metadata<'_>) -> Vec<u8> {
    let (width, height) = (image.width as usize, image.height as usize);
    let pixel = |at: Vec2<usize>| {
        let [r, g, b] = image.pixels[at.y() * width + at.x()];
        (r, g, b)
    };
    let mut attributes = LayerAttributes::default();
    for (key, value) in metadata {
        let value = AttributeValue::Text(Text::from(value.as_str()));
        attributes.other.insert(Text::from(*key), value);
    }
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
