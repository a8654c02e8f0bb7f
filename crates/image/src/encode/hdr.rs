//! Radiance's pictures (Ward, "Real Pixels", 1991): a common exponent for three channels of 8 bits.

use super::Metadata;
use crate::image::Image;
use image::Rgb;
use image::codecs::hdr::HdrEncoder;

/// How every file begins.
const SIGNATURE: &[u8] = b"#?RADIANCE\n";

/// The bytes of a `.hdr` file of linear numbers: to 1 % of the brightest channel of each pixel.
pub fn encode_hdr(image: &Image, metadata: &Metadata<'_>) -> Vec<u8> {
    let pixels: Vec<Rgb<f32>> = image.pixels.iter().map(|pixel| Rgb(*pixel)).collect();
    let mut plain = Vec::new();
    HdrEncoder::new(&mut plain)
        .encode(&pixels, image.width as usize, image.height as usize)
        .expect("memory takes all bytes");
    // The encoder has no room for lines of the header, which may be anything.
    let rest = plain.strip_prefix(SIGNATURE).expect("so it begins");
    let mut bytes = SIGNATURE.to_vec();
    for (key, value) in metadata {
        let line = format!("# {key}: {value}").replace(['\n', '\r'], " ");
        bytes.extend(line.as_bytes());
        bytes.push(b'\n');
    }
    bytes.extend(rest);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::codecs::hdr::HdrDecoder;
    use image::{ImageDecoder, Rgb32FImage};
    use std::io::Cursor;

    #[test]
    fn radiance_comes_back_to_the_format_s_digits() {
        let image = Image {
            width: 9,
            height: 2,
            pixels: (0..18)
                .map(|k| [0.01 * k as f32, 1.0, 100.0 - k as f32])
                .collect(),
        };
        let bytes = encode_hdr(&image, &[("Unit", "W/m^2/sr\nand more".to_owned())]);
        assert!(bytes.starts_with(b"#?RADIANCE\n# Unit: W/m^2/sr and more\n"));
        let decoder = HdrDecoder::new(Cursor::new(bytes)).unwrap();
        assert_eq!(decoder.dimensions(), (9, 2));
        let mut data = vec![0; decoder.total_bytes() as usize];
        decoder.read_image(&mut data).unwrap();
        let channels = data
            .as_chunks::<4>()
            .0
            .iter()
            .map(|c| f32::from_ne_bytes(*c));
        let found = Rgb32FImage::from_raw(9, 2, channels.collect()).unwrap();
        for (found, expected) in found.pixels().zip(&image.pixels) {
            for c in 0..3 {
                // A channel has 8 bits at the exponent of the brightest.
                assert!((found.0[c] - expected[c]).abs() <= expected[2] / 128.0);
            }
        }
    }
}
