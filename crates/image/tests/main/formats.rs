//! The formats that pictures come in.

use crate::bytes::{decode, refusal};
use proptest::prelude::*;
use radiosity_image::{
    DecodeParams, Decoded, Image, PictureFormat, Rgb16Image, ToneMap, Transfer, decode_picture,
    decode_regions, encode, encode_hdr, encode_pfm, encode_png16,
};

/// Pictures whose brightest level is radiance 0.25.
const PARAMS: DecodeParams = DecodeParams {
    exposure: 4.0,
    transfer: None,
    default_transfer: Transfer::Gamma(2.2),
};

/// Six pixels, from black to where the blue channel is clamped.
fn ramp() -> Image {
    let pixel = |k: u8| [0.03, 0.1, 0.2].map(|c: f32| c * f32::from(k));
    Image {
        width: 3,
        height: 2,
        pixels: (0..6).map(pixel).collect(),
    }
}

#[test]
fn float_maps_come_back_as_they_went() {
    let linear = Decoded {
        image: ramp(),
        levels: false,
    };
    assert_eq!(decode(&encode_pfm(&ramp())), Ok(linear));
    let big_endian = [b"PF 1 1 2.0\n".as_slice(), &1.5f32.to_be_bytes().repeat(3)].concat();
    let decoded = decode(&big_endian).unwrap();
    assert_eq!(decoded.image.pixels, [[3.0; 3]]);
}

/// Levels come back as the radiance they stand for, within half a level.
#[test]
fn levels_become_radiance() {
    // The line and the power of sRGB are nowhere steeper than a gamma of 2.4.
    for (transfer, gamma) in [
        (Transfer::Gamma(2.2), 2.2),
        (Transfer::Gamma(1.8), 1.8),
        (Transfer::Srgb, 2.4),
    ] {
        let params = DecodeParams {
            transfer: Some(transfer),
            ..PARAMS
        };
        let tone = ToneMap::clamped(4.0, transfer);
        let picture = tone.apply(&ramp());
        let mut decoded = Vec::new();
        for format in [
            PictureFormat::Ppm,
            PictureFormat::PlainPpm,
            PictureFormat::Png(transfer),
        ] {
            decoded.push(decode_picture(&encode(&picture, format, &[]), &params).unwrap());
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
    }
}

/// What a PNG says of its gamma counts unless another is stated.
#[test]
fn pictures_may_know_their_gamma() {
    for own in [Transfer::Gamma(1.0), Transfer::Srgb] {
        let picture = ToneMap::clamped(4.0, own).apply(&ramp());
        let png = encode(&picture, PictureFormat::Png(own), &[]);
        let radiance = |transfer| {
            // The default of other pictures does not matter.
            let params = DecodeParams {
                transfer,
                default_transfer: Transfer::Gamma(1.7),
                ..PARAMS
            };
            decode_picture(&png, &params).unwrap().image.pixels[1][0]
        };
        assert!((radiance(None) - 0.03).abs() < 1e-3);
        let other = Transfer::Gamma(2.2).decode(f64::from(own.encode(0.12))) / 4.0;
        assert!((f64::from(radiance(Some(Transfer::Gamma(2.2)))) - other).abs() < 1e-3);
    }
}

#[test]
fn two_bytes_a_sample_are_read() {
    let wide = b"P6 # a comment\n1 1\n1000\n\x03\xe8\x01\xf4\x00\x00";
    let linear = DecodeParams {
        transfer: Some(Transfer::Gamma(1.0)),
        ..DecodeParams::default()
    };
    let decoded = decode_picture(wide, &linear).unwrap();
    assert_eq!(decoded.image.pixels, [[1.0, 0.5, 0.0]]);
    let deep = Rgb16Image {
        width: 1,
        height: 2,
        levels: vec![0, 1, 2, 65533, 65534, 65535],
    };
    let png = encode_png16(&deep, Transfer::Gamma(1.0), &[]);
    let decoded = decode(&png).unwrap();
    let level = |radiance: f32| (radiance * 65535.0).round() as u16;
    let levels: Vec<u16> = decoded
        .image
        .pixels
        .as_flattened()
        .iter()
        .map(|c| level(*c))
        .collect();
    assert_eq!(levels, deep.levels);
}

#[test]
fn damaged_pictures_are_told_from_good_ones() {
    assert!(refusal(b"GIF89a").contains("none of the formats"));
    assert!(refusal(b"P6 2 1 255\nabc").contains("6 samples or bytes should follow"));
    assert!(refusal(b"P3 1 1 255\n0 0 256").contains("brighter"));
    assert!(refusal(b"Pf 1 1 1\n").contains("no three channels"));
    assert!(refusal(b"PF 1 1 0\n").contains("scale"));
    assert!(refusal(b"P6 1 x 255\n").contains("width and height"));
    assert!(decode_regions(b"no picture").is_err());
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
        let _ = decode(&[magic.as_bytes(), &rest].concat());
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
        let _ = decode(&png);
        let _ = decode(&hdr);
        let _ = decode_regions(&png);
    }
}
