//! What the head of a picture's file says: its format, and its size before any memory is taken for
//! it.

#[cfg(feature = "openexr")]
use super::openexr;
use super::{DecodeError, hdr, png, portable};

/// The formats that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Png,
    OpenExr,
    Hdr,
    FloatMap,
    Pixmap,
}

/// What files of each begin with.
const MAGIC: [(&[u8], Format); 7] = [
    (b"\x89PNG\r\n\x1a\n", Format::Png),
    (b"\x76\x2f\x31\x01", Format::OpenExr),
    (b"#?RADIANCE", Format::Hdr),
    (b"PF", Format::FloatMap),
    (b"Pf", Format::FloatMap),
    (b"P3", Format::Pixmap),
    (b"P6", Format::Pixmap),
];

impl Format {
    pub(super) fn of(bytes: &[u8]) -> Result<Format, DecodeError> {
        let found = MAGIC.iter().find(|(magic, _)| bytes.starts_with(magic));
        found.map(|(_, format)| *format).ok_or(DecodeError::Unknown)
    }
}

/// How many pixels a picture has across and down, as [`decode_picture`](crate::decode_picture)
/// would read it. For whoever has little memory: what decoding takes grows with them.
pub fn picture_size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    match Format::of(bytes)? {
        Format::Png => png::size(bytes),
        #[cfg(feature = "openexr")]
        Format::OpenExr => openexr::size(bytes),
        #[cfg(not(feature = "openexr"))]
        Format::OpenExr => Err(DecodeError::LeftOut),
        Format::Hdr => hdr::size(bytes),
        Format::FloatMap => portable::size_of_float_map(bytes),
        Format::Pixmap => portable::size_of_pixmap(bytes),
    }
}
