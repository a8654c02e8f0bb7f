//! The measure for pictures, and the formats that pictures come in.

use proptest::prelude::*;
use radiosity_compare::{
    Decoded, PictureError, Regions, Screen, compare_pictures, decode_picture, decode_regions,
    difference_picture,
};
use radiosity_renderer::{Image, PictureFormat, ToneMap, Transfer, encode, encode_hdr, encode_pfm};

const SCREEN: Screen = Screen {
    exposure: 4.0,
    transfer: None,
    usual: Transfer::Gamma(2.2),
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

#[test]
fn float_maps_come_back_as_they_went() {
    assert_eq!(
        decode_picture(&encode_pfm(&ramp()), &SCREEN),
        Ok(linear(ramp()))
    );
    let big_endian = [b"PF 1 1 2.0\n".as_slice(), &1.5f32.to_be_bytes().repeat(3)].concat();
    let decoded = decode_picture(&big_endian, &SCREEN).unwrap();
    assert_eq!(decoded.image.pixels, [[3.0; 3]]);
}

/// Levels come back as the radiance they stand for, within half a level; the brightest level of
/// a reference is clamped, since it stands for anything above.
#[test]
fn levels_become_radiance() {
    // The line and the power of sRGB are nowhere steeper than a gamma of 2.4.
    for (transfer, gamma) in [
        (Transfer::Gamma(2.2), 2.2),
        (Transfer::Gamma(1.8), 1.8),
        (Transfer::Srgb, 2.4),
    ] {
        let screen = Screen {
            transfer: Some(transfer),
            ..SCREEN
        };
        let tone = ToneMap::clamped(4.0, transfer);
        let picture = tone.apply(&ramp());
        let mut decoded = Vec::new();
        for format in [
            PictureFormat::Ppm,
            PictureFormat::PlainPpm,
            PictureFormat::Png(transfer),
        ] {
            decoded.push(decode_picture(&encode(&picture, format, &[]), &screen).unwrap());
        }
        assert!(
            decoded
                .iter()
                .all(|other| *other == decoded[0] && other.levels)
        );
        for (before, after) in ramp().pixels.iter().zip(&decoded[0].image.pixels) {
            for (&before, &after) in before.iter().zip(after) {
                let shown = f64::from(before.min(0.25));
                // d(level) = 1/510, so d(radiance) = gamma / 4 * brightness^(1 - 1 / gamma) / 510,
                // and more by curvature near black.
                assert!((shown - f64::from(after)).abs() < 1.1 * gamma / 4.0 / 510.0);
            }
        }
        let unclamped = ramp().pixels.iter().filter(|pixel| pixel[2] < 0.25).count();
        let (name, errors) = &compare_pictures(&ramp(), &decoded[0], None, 4.0).unwrap()[0];
        assert_eq!((name.as_str(), errors.values), ("all", 3 * unclamped));
    }
}

/// What a PNG says of its gamma counts unless another is stated.
#[test]
fn pictures_may_know_their_gamma() {
    for own in [Transfer::Gamma(1.0), Transfer::Srgb] {
        let picture = ToneMap::clamped(4.0, own).apply(&ramp());
        let png = encode(&picture, PictureFormat::Png(own), &[]);
        let radiance = |transfer| {
            // What is usual elsewhere does not matter.
            let screen = Screen {
                transfer,
                usual: Transfer::Gamma(1.7),
                ..SCREEN
            };
            decode_picture(&png, &screen).unwrap().image.pixels[1][0]
        };
        assert!((radiance(None) - 0.03).abs() < 1e-3);
        let other = Transfer::Gamma(2.2).decode(f64::from(own.encode(0.12))) / 4.0;
        assert!((f64::from(radiance(Some(Transfer::Gamma(2.2)))) - other).abs() < 1e-3);
    }
}

#[test]
fn two_bytes_a_sample_are_read() {
    let wide = b"P6 # a comment\n1 1\n1000\n\x03\xe8\x01\xf4\x00\x00";
    let linear = Screen {
        exposure: 1.0,
        transfer: Some(Transfer::Gamma(1.0)),
        ..SCREEN
    };
    let decoded = decode_picture(wide, &linear).unwrap();
    assert_eq!(decoded.image.pixels, [[1.0, 0.5, 0.0]]);
}

#[test]
fn damaged_pictures_are_told_from_good_ones() {
    let message = |bytes: &[u8]| decode_picture(bytes, &SCREEN).unwrap_err().to_string();
    assert!(message(b"GIF89a").contains("none of the formats"));
    assert!(message(b"P6 2 1 255\nabc").contains("6 samples or bytes should follow"));
    assert!(message(b"P3 1 1 255\n0 0 256").contains("brighter"));
    assert!(message(b"Pf 1 1 1\n").contains("no three channels"));
    assert!(message(b"PF 1 1 0\n").contains("scale"));
    assert!(message(b"P6 1 x 255\n").contains("width and height"));
    assert!(decode_regions(b"no picture").is_err());
}

#[test]
fn differences_are_red_above_and_blue_below() {
    let mut found = image(100, vec![[1.0; 3]; 100]);
    let reference = found.clone();
    found.pixels[0] = [1.5; 3];
    found.pixels[1] = [0.75; 3];
    // The largest of a hundred differences is beyond full colour, the next is at it.
    let shown = difference_picture(&found, &reference);
    assert_eq!(shown.full_scale, 0.5);
    assert_eq!(
        shown.picture.bytes[..9],
        [255, 0, 0, 128, 128, 255, 255, 255, 255]
    );
}

proptest! {
    /// Nothing that begins like a picture makes the reader panic.
    #[test]
    fn any_bytes_are_read_or_refused(
        magic in prop::sample::select(vec![
            "P3 ", "P6 ", "PF ", "P6 2 2 255\n", "PF 1 1 -1\n", "P3 1 1 9 ",
            "#?RADIANCE\n", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 9 +X 9\n",
            "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n",
        ]),
        rest in prop::collection::vec(any::<u8>(), 0..64),
    ) {
        let _ = decode_picture(&[magic.as_bytes(), &rest].concat(), &SCREEN);
    }

    /// Nor does a good picture with some bytes changed.
    #[test]
    fn damage_is_survived(damage in prop::collection::vec((any::<u16>(), any::<u8>()), 1..4)) {
        let picture = ToneMap::clamped(1.0, Transfer::Gamma(2.0)).apply(&ramp());
        let mut png = encode(&picture, PictureFormat::Png(Transfer::Gamma(2.0)), &[]);
        let mut hdr = encode_hdr(&ramp(), &[("Unit", "W/m^2/sr".to_owned())]);
        for (at, byte) in damage {
            for bytes in [&mut png, &mut hdr] {
                let length = bytes.len();
                bytes[usize::from(at) % length] = byte;
            }
        }
        let _ = decode_picture(&png, &SCREEN);
        let _ = decode_picture(&hdr, &SCREEN);
        let _ = decode_regions(&png);
    }
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
