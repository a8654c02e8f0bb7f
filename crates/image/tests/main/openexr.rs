//! How much memory headers of OpenEXR files may ask for.

use crate::bytes::{decode, refusal};
use proptest::prelude::*;
use radiosity_image::DecodeError;

const TILED: u8 = 0x02;
const DEEP: u8 = 0x08;

/// What a header says, and no pixels.
struct Header {
    flags: u8,
    size: [i32; 2],
    tile: Option<u32>,
    channels: usize,
    compression: u8,
}

const PLAIN: Header = Header {
    flags: 0,
    size: [4, 4],
    tile: None,
    channels: 3,
    compression: 3,
};

impl Header {
    fn bytes(&self) -> Vec<u8> {
        let [width, height] = self.size;
        let window = [0, 0, width - 1, height - 1].map(i32::to_le_bytes).concat();
        let channel = |k: usize| {
            let name = ["B", "G", "R"]
                .get(k)
                .map_or(format!("x{k}"), ToString::to_string);
            let float = [2, 0, 1, 1].map(i32::to_le_bytes).concat();
            [name.as_bytes(), &[0], &float].concat()
        };
        let channels: Vec<Vec<u8>> = (0..self.channels).map(channel).collect();
        let one = 1.0_f32.to_le_bytes();
        let mut bytes = vec![0x76, 0x2f, 0x31, 0x01, 2, self.flags, 0, 0];
        let mut attribute = |name: &str, kind: &str, value: &[u8]| {
            bytes.extend([name.as_bytes(), &[0], kind.as_bytes(), &[0]].concat());
            bytes.extend((value.len() as i32).to_le_bytes());
            bytes.extend(value);
        };
        attribute(
            "channels",
            "chlist",
            &[&channels.concat()[..], &[0]].concat(),
        );
        attribute("compression", "compression", &[self.compression]);
        attribute("dataWindow", "box2i", &window);
        attribute("displayWindow", "box2i", &window);
        attribute("lineOrder", "lineOrder", &[0]);
        attribute("pixelAspectRatio", "float", &one);
        attribute("screenWindowCenter", "v2f", &[0; 8]);
        attribute("screenWindowWidth", "float", &one);
        if let Some(tile) = self.tile {
            let size = tile.to_le_bytes();
            attribute("tiles", "tiledesc", &[&size[..], &size, &[0]].concat());
        }
        if self.flags == DEEP {
            attribute("type", "string", b"deepscanline");
            attribute("version", "int", &[1, 0, 0, 0]);
            attribute("maxSamplesPerPixel", "int", &[255, 255, 255, 127]);
        }
        bytes.push(0);
        bytes
    }
}

/// One block, said to have two thousand million bytes.
fn with_a_block(mut header: Vec<u8>, is_tile: bool) -> Vec<u8> {
    header.extend((header.len() as u64 + 8).to_le_bytes());
    header.extend(vec![0; if is_tile { 16 } else { 4 }]);
    header.extend(i32::MAX.to_le_bytes());
    header.extend([0; 64]);
    header
}

#[test]
fn windows_of_data_are_looked_at() {
    for size in [2000, 16_000, 60_000] {
        let header = Header {
            size: [size; 2],
            ..PLAIN
        };
        let error = refusal(&header.bytes());
        let expected = format!("has {size} x {size} pixels, but of a file of");
        assert!(error.starts_with(&expected), "{error}");
    }
}

/// However small the picture is: what is packed may have the size of a block.
#[test]
fn blocks_are_looked_at() {
    let tiles = Header {
        flags: TILED,
        tile: Some(1 << 14),
        ..PLAIN
    };
    let huge_tiles = Header {
        tile: Some((1 << 30) - 2),
        ..tiles
    };
    // Two hundred and fifty-six lines a block.
    let lines = Header {
        size: [1 << 20, 1],
        compression: 9,
        ..PLAIN
    };
    let channels = Header {
        size: [1 << 20, 1],
        channels: 600,
        ..PLAIN
    };
    for (header, expected) in [
        (
            tiles,
            "its blocks of 16384 x 16384 pixels with 3 channels are too large",
        ),
        (huge_tiles, "its blocks of 1073741822 x 1073741822 pixels"),
        (lines, "its blocks of 1048576 x 256 pixels"),
        (
            channels,
            "its blocks of 1048576 x 16 pixels with 600 channels",
        ),
    ] {
        let bytes = with_a_block(header.bytes(), header.tile.is_some());
        let error = refusal(&bytes);
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn deep_data_are_refused() {
    let deep = Header {
        flags: DEEP,
        ..PLAIN
    };
    let error = decode(&deep.bytes()).unwrap_err();
    assert!(matches!(error, DecodeError::Broken { .. }), "{error}");
    assert!(error.to_string().contains("deep"), "{error}");
}

/// A picture without compression, a line a block.
fn picture() -> Vec<u8> {
    let mut bytes = Header {
        compression: 0,
        ..PLAIN
    }
    .bytes();
    let (first, block) = (bytes.len() as u64 + 4 * 8, 8 + 4 * 3 * 4);
    let offsets = (0..4).map(|line| first + line * block);
    bytes.extend(offsets.flat_map(u64::to_le_bytes));
    for line in 0..4_i32 {
        bytes.extend([line, 4 * 3 * 4].map(i32::to_le_bytes).concat());
        bytes.extend([0.5_f32; 12].map(f32::to_le_bytes).concat());
    }
    bytes
}

#[test]
fn good_pictures_are_read() {
    let image = decode(&picture()).unwrap().image;
    assert_eq!((image.width, image.height), (4, 4));
    assert_eq!(image.pixels, vec![[0.5; 3]; 16]);
}

proptest! {
    /// Nothing that is wrong with a file makes the reader panic.
    #[test]
    fn damage_is_survived(damage in prop::collection::vec((any::<u16>(), any::<u8>()), 1..4)) {
        let mut bytes = picture();
        for (at, byte) in damage {
            let length = bytes.len();
            bytes[usize::from(at) % length] = byte;
        }
        let _ = decode(&bytes);
    }
}
