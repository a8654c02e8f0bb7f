//! How large pictures may be for the bytes of their files.

use crate::bytes::{decode, refusal};
use radiosity_image::decode_regions;

/// A PNG of one colour.
fn plain_png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().unwrap();
    let data = vec![127; width as usize * height as usize];
    writer.write_image_data(&data).unwrap();
    drop(writer);
    bytes
}

/// However well they are packed.
#[test]
fn plain_pictures_are_read_up_to_full_hd() {
    let png = plain_png(1920, 1080);
    assert!(png.len() < 10_000, "{}", png.len());
    let picture = decode(&png).unwrap().image;
    assert_eq!(picture.pixels.len(), 1920 * 1080);
    let large = plain_png(2048, 1200);
    let most = 1920 * 1088 + 32 * large.len();
    let expected = format!(
        "has 2048 x 1200 pixels, but of a file of {} bytes at most {most} are read: save it \
         smaller, or with less compression",
        large.len()
    );
    assert_eq!(refusal(&large), expected);
    // Of maps, a pixel is a byte.
    assert_eq!(decode_regions(&large).unwrap().labels.len(), 2048 * 1200);
}

/// A header may promise more than memory holds, and more than its file.
#[test]
fn huge_pictures_are_refused_before_memory_is_taken() {
    let promised_png = |size: u32| {
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, size, size);
        encoder.set_color(png::ColorType::Grayscale);
        let mut writer = encoder.write_header().unwrap();
        writer.write_chunk(png::chunk::IDAT, &[0]).unwrap();
        drop(writer);
        png
    };
    for size in [2000, 16_000, 60_000] {
        let promises = [
            promised_png(size),
            format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {size} +X {size}\n").into_bytes(),
            format!("PF {size} {size} -1\n").into_bytes(),
            format!("P6 {size} {size} 255\n").into_bytes(),
            format!("P3 {size} {size} 255\n").into_bytes(),
        ];
        for bytes in &promises {
            let error = refusal(bytes);
            let expected = format!("has {size} x {size} pixels, but of a file of");
            assert!(error.starts_with(&expected), "{error}");
            assert!(error.contains("compression") == (size < 16_384), "{error}");
        }
    }
    let error = decode_regions(&promised_png(4000)).unwrap_err().to_string();
    assert!(error.contains("at most 2"), "{error}");
}
