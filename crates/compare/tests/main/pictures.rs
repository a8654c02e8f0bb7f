//! The measure for pictures.

use radiosity_compare::{PictureError, compare_pictures, difference_picture};
use radiosity_image::{
    DecodeParams, Decoded, Image, PictureFormat, Regions, ToneMap, Transfer, decode_picture, encode,
};

fn image(width: u32, pixels: Vec<[f32; 3]>) -> Image {
    Image {
        width,
        height: pixels.len() as u32 / width,
        pixels,
    }
}

fn linear(image: Image) -> Decoded {
    Decoded {
        image,
        levels: false,
    }
}

fn ramp() -> Image {
    let pixel = |k: u8| [0.03, 0.1, 0.2].map(|c: f32| c * f32::from(k));
    image(3, (0..6).map(pixel).collect())
}

/// Region 0 is 10 % too bright, region 1 exact, region 2 too dark by 0.02. The pixel of region 0
/// that the reference shows clamped does not count, however wrong.
#[test]
fn regions_are_told_apart_and_clamped_pixels_left_out() {
    let reference = image(4, vec![[0.1; 3], [0.3; 3], [0.2; 3], [0.1; 3]]);
    let found = image(4, vec![[0.11; 3], [9.0; 3], [0.2; 3], [0.08; 3]]);
    let regions = Regions {
        width: 4,
        height: 1,
        labels: vec![0, 0, 1, 2],
    };
    let errors = compare_pictures(&found, &linear(reference), Some(&regions), 4.0).unwrap();
    let names: Vec<&str> = errors.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["0", "1", "2", "0-1", "all"]);
    let expected = [
        (10.0, 10.0, 3),
        (0.0, 0.0, 3),
        (20.0, -20.0, 3),
        (
            100.0 * 0.5_f64.sqrt() * 0.01 / 0.15,
            100.0 * 0.005 / 0.15,
            6,
        ),
        (
            100.0 * (0.0005_f64 / 3.0).sqrt() / (0.4 / 3.0),
            100.0 * (-0.01 / 3.0) / (0.4 / 3.0),
            9,
        ),
    ];
    for ((name, errors), (rmse, bias, values)) in errors.iter().zip(expected) {
        // The pictures are single precision.
        assert!(
            (errors.rmse_percent - rmse).abs() < 1e-4,
            "{name}: {errors:?}"
        );
        assert!(
            (errors.bias_percent - bias).abs() < 1e-4,
            "{name}: {errors:?}"
        );
        assert_eq!(errors.values, values, "{name}");
    }
    assert!((errors[4].1.percentiles.p50 - 7.5).abs() < 1e-4);
    assert!((errors[4].1.percentiles.max - 15.0).abs() < 1e-4);
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let good = linear(ramp());
    let compare = |found: &Image, reference: &Decoded| {
        compare_pictures(found, reference, None, 1.0).unwrap_err()
    };
    let narrow = image(2, ramp().pixels);
    assert!(matches!(compare(&narrow, &good), PictureError::Size { .. }));
    let mut broken = ramp();
    broken.pixels[4][1] = f32::NAN;
    let error = compare(&broken, &good);
    assert!(matches!(error, PictureError::NotFinite { x: 1, y: 1, .. }));
    let black = linear(Image::black(3, 2));
    assert_eq!(compare(&ramp(), &black), PictureError::Nothing);
}

/// The brightest level of a reference is clamped, since it stands for anything above.
#[test]
fn the_brightest_level_does_not_count() {
    let transfer = Transfer::Gamma(2.2);
    let params = DecodeParams {
        exposure: 4.0,
        ..DecodeParams::default()
    };
    let shown = ToneMap::clamped(4.0, transfer).apply(&ramp());
    let bytes = encode(&shown, PictureFormat::Png(transfer), &[]);
    let decoded = decode_picture(&bytes, &params).unwrap();
    let unclamped = ramp().pixels.iter().filter(|pixel| pixel[2] < 0.25).count();
    let (name, errors) = &compare_pictures(&ramp(), &decoded, None, 4.0).unwrap()[0];
    assert_eq!((name.as_str(), errors.values), ("all", 3 * unclamped));
}

#[test]
fn differences_are_red_above_and_blue_below() {
    let mut found = image(100, vec![[1.0; 3]; 100]);
    let reference = found.clone();
    found.pixels[0] = [1.5; 3];
    found.pixels[1] = [0.75; 3];
    // The largest of a hundred differences is beyond full colour, the next is at it.
    let shown = difference_picture(&found, &reference);
    assert_eq!(shown.full_scale, 0.25);
    assert_eq!(
        shown.picture.bytes[..9],
        [255, 0, 0, 0, 0, 255, 255, 255, 255]
    );
}

/// Most pixels are equal, few are not; the scale may be zero, and sums do not overflow.
#[test]
fn differences_are_shown_on_a_scale_of_their_own() {
    let flat = |value| Image {
        width: 200,
        height: 1,
        pixels: vec![[value; 3]; 200],
    };
    let equal = difference_picture(&flat(1.0), &flat(1.0));
    assert_eq!(equal.full_scale, 0.0);
    assert!(equal.picture.bytes.iter().all(|&byte| byte == 255));
    let mut one = flat(1.0);
    one.pixels[3] = [2.0; 3];
    let shown = difference_picture(&one, &flat(1.0)).picture.bytes;
    assert_eq!(shown[9..12], [255, 0, 0]);
    assert!(
        difference_picture(&flat(3e38), &flat(-3e38))
            .full_scale
            .is_finite()
    );
}
