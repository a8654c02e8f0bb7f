//! Pictures as files' bytes.
//!
//! What a file should say of itself is a list of keys and values; formats that have no room for it
//! (PPM, PFM) leave it out.

mod hdr;
#[cfg(feature = "openexr")]
mod openexr;
mod portable;

use crate::rgb8_image::{Rgb8Image, Rgb16Image};
use crate::tone::Transfer;
pub use hdr::encode_hdr;
#[cfg(feature = "openexr")]
pub use openexr::encode_exr;
pub use portable::encode_pfm;
use portable::{plain_ppm, ppm};

/// What a file says of itself: keys, and their values.
pub type Metadata<'a> = [(&'a str, String)];

/// File formats for 8-bit pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PictureFormat {
    /// Portable pixmap, decimal numbers (P3).
    PlainPpm,
    /// Portable pixmap, bytes (P6).
    Ppm,
    /// Portable network graphics, which records the curve that the picture was made for.
    Png(Transfer),
}

/// The bytes of a file that holds the picture.
///
/// ```
/// use radiosity_image::{PictureFormat, Rgb8Image, encode};
///
/// let orange = Rgb8Image::plain(1, 1, [255, 128, 0]);
/// let ppm = encode(&orange, PictureFormat::PlainPpm, &[]);
/// assert_eq!(ppm, b"P3\n1 1\n255\n255 128 0\n");
/// ```
pub fn encode(picture: &Rgb8Image, format: PictureFormat, metadata: &Metadata<'_>) -> Vec<u8> {
    match format {
        PictureFormat::PlainPpm => plain_ppm(picture),
        PictureFormat::Ppm => ppm(picture),
        PictureFormat::Png(transfer) => {
            let size = (picture.width, picture.height);
            let data = (&picture.bytes[..], png::BitDepth::Eight);
            png(size, data, transfer, metadata)
        }
    }
}

/// The bytes of a PNG of 16 bits, which records the curve that the picture was made for.
pub fn encode_png16(picture: &Rgb16Image, transfer: Transfer, metadata: &Metadata<'_>) -> Vec<u8> {
    let levels = picture.levels.iter();
    let data: Vec<u8> = levels.flat_map(|level| level.to_be_bytes()).collect();
    let size = (picture.width, picture.height);
    png(size, (&data, png::BitDepth::Sixteen), transfer, metadata)
}

fn png(
    (width, height): (u32, u32),
    (data, depth): (&[u8], png::BitDepth),
    transfer: Transfer,
    metadata: &Metadata<'_>,
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(depth);
    encoder.set_compression(png::Compression::Fast);
    match transfer {
        Transfer::Gamma(gamma) => {
            encoder.set_source_gamma(png::ScaledFloat::new((1.0 / gamma) as f32));
        }
        Transfer::Srgb => encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual),
    }
    for (key, value) in metadata {
        let text = encoder.add_itxt_chunk((*key).to_owned(), value.clone());
        text.expect("keys are plain and short");
    }
    let mut writer = encoder.write_header().expect("memory takes all bytes");
    writer
        .write_image_data(data)
        .expect("the size is that of the picture");
    writer.finish().expect("memory takes all bytes");
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Image;

    fn sample() -> Rgb8Image {
        Rgb8Image {
            width: 2,
            height: 1,
            bytes: vec![0, 1, 2, 253, 254, 255],
        }
    }

    #[test]
    fn portable_pixmaps_are_as_specified() {
        let plain = encode(&sample(), PictureFormat::PlainPpm, &[]);
        assert_eq!(plain, b"P3\n2 1\n255\n0 1 2\n253 254 255\n");
        let binary = encode(&sample(), PictureFormat::Ppm, &[]);
        assert_eq!(binary, b"P6\n2 1\n255\n\x00\x01\x02\xfd\xfe\xff");
    }

    #[test]
    fn float_maps_run_from_the_bottom_up() {
        let image = Image {
            width: 1,
            height: 2,
            pixels: vec![[1.0; 3], [2.0; 3]],
        };
        let bytes = encode_pfm(&image);
        let (header, data) = bytes.split_at(12);
        assert_eq!(header, b"PF\n1 2\n-1.0\n");
        assert_eq!(data[..4], 2f32.to_le_bytes());
        assert_eq!(data[12..16], 1f32.to_le_bytes());
    }

    #[test]
    fn png_holds_the_picture_and_its_gamma() {
        let metadata = [("Unit", "W/m²".to_owned())];
        let bytes = encode(
            &sample(),
            PictureFormat::Png(Transfer::Gamma(2.0)),
            &metadata,
        );
        let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        let mut reader = decoder.read_info().unwrap();
        assert_eq!(reader.info().gamma().unwrap().into_value(), 0.5);
        let text = &reader.info().utf8_text[0];
        assert_eq!(
            (text.keyword.as_str(), text.get_text().unwrap()),
            ("Unit", "W/m²".to_owned())
        );
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels, sample().bytes);
    }

    #[test]
    fn deep_png_holds_every_level_and_says_that_it_is_srgb() {
        let picture = Rgb16Image {
            width: 1,
            height: 1,
            levels: vec![0, 258, 65535],
        };
        let bytes = encode_png16(&picture, Transfer::Srgb, &[]);
        let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        let mut reader = decoder.read_info().unwrap();
        assert!(reader.info().srgb.is_some());
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels, [0, 0, 1, 2, 255, 255]);
    }
}
