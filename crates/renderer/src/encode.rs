//! Pictures as files' bytes.

use crate::image::Image;
use crate::picture::{DeepPicture, Picture};
use crate::tone::Transfer;

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
pub fn encode(picture: &Picture, format: PictureFormat) -> Vec<u8> {
    match format {
        PictureFormat::PlainPpm => plain_ppm(picture),
        PictureFormat::Ppm => ppm(picture),
        PictureFormat::Png(transfer) => {
            let size = (picture.width, picture.height);
            png(size, &picture.bytes, png::BitDepth::Eight, transfer)
        }
    }
}

/// The bytes of a PNG of 16 bits, which records the curve that the picture was made for.
pub fn encode_deep_png(picture: &DeepPicture, transfer: Transfer) -> Vec<u8> {
    let data: Vec<u8> = picture
        .levels
        .iter()
        .flat_map(|level| level.to_be_bytes())
        .collect();
    let size = (picture.width, picture.height);
    png(size, &data, png::BitDepth::Sixteen, transfer)
}

/// The bytes of a portable float map (PF): linear radiance, 32-bit, little endian, rows from the
/// bottom up as the format wants them.
pub fn encode_pfm(image: &Image) -> Vec<u8> {
    let mut bytes = format!("PF\n{} {}\n-1.0\n", image.width, image.height).into_bytes();
    for row in image.pixels.chunks_exact(image.width as usize).rev() {
        for channel in row.iter().flatten() {
            bytes.extend(channel.to_le_bytes());
        }
    }
    bytes
}

fn header(magic: &str, picture: &Picture) -> String {
    format!("{magic}\n{} {}\n255\n", picture.width, picture.height)
}

/// One pixel a line: the format allows no line over 70 characters.
fn plain_ppm(picture: &Picture) -> Vec<u8> {
    use std::fmt::Write;
    let mut text = header("P3", picture);
    text.reserve(12 * picture.bytes.len() / 3);
    for pixel in picture.bytes.chunks_exact(3) {
        writeln!(text, "{} {} {}", pixel[0], pixel[1], pixel[2]).expect("strings take all text");
    }
    text.into_bytes()
}

fn ppm(picture: &Picture) -> Vec<u8> {
    [header("P6", picture).as_bytes(), &picture.bytes].concat()
}

fn png(
    (width, height): (u32, u32),
    data: &[u8],
    depth: png::BitDepth,
    transfer: Transfer,
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

    fn sample() -> Picture {
        Picture {
            width: 2,
            height: 1,
            bytes: vec![0, 1, 2, 253, 254, 255],
        }
    }

    #[test]
    fn portable_pixmaps_are_as_specified() {
        let plain = encode(&sample(), PictureFormat::PlainPpm);
        assert_eq!(plain, b"P3\n2 1\n255\n0 1 2\n253 254 255\n");
        let binary = encode(&sample(), PictureFormat::Ppm);
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
        let bytes = encode(&sample(), PictureFormat::Png(Transfer::Gamma(2.0)));
        let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        let mut reader = decoder.read_info().unwrap();
        assert_eq!(reader.info().gamma().unwrap().into_value(), 0.5);
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels, sample().bytes);
    }

    #[test]
    fn deep_png_holds_every_level_and_says_that_it_is_srgb() {
        let picture = DeepPicture {
            width: 1,
            height: 1,
            levels: vec![0, 258, 65535],
        };
        let bytes = encode_deep_png(&picture, Transfer::Srgb);
        let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        let mut reader = decoder.read_info().unwrap();
        assert!(reader.info().srgb.is_some());
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels, [0, 0, 1, 2, 255, 255]);
    }
}
