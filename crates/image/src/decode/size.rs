//! How large a picture may be for the bytes that it comes in.
//!
//! A picture of one colour packs a thousand to one, and a header alone promises anything: three
//! kilobytes can ask for gigabytes. So a size is looked at before memory is taken for it. Pictures
//! up to [`ALWAYS`] are read however well they are packed. Larger ones hold [`PER_BYTE`] pixels
//! more for each byte of their file, a multiple of what pictures of light come to: those of this
//! project hold 2 to 4 a byte, and the smoothest some 20. Without compression no picture of eight
//! bits holds more than one a byte, so what is refused can be saved in a way that is not.

/// The largest picture that is read in any case: full HD, of either kind.
const ALWAYS: u64 = 1920 * 1088;
/// How many more pixels are read for each byte of the file.
pub(super) const PER_BYTE: u64 = 32;
/// The same of maps of regions, of which a pixel takes no more than the byte that it is: deflate
/// packs no better than this.
pub(super) const PER_BYTE_OF_MAP: u64 = 1032;
/// No picture is larger, whatever its file.
const MOST: u64 = 1 << 28;

/// A picture that is not read, since it has no pixels, or too many for its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SizeError {
    width: u64,
    height: u64,
    /// The size of the file.
    bytes: u64,
    /// How many pixels are read of such a file.
    most: u64,
}

/// Refuses pictures without pixels, or with more than memory is taken for. `bytes` are those of the
/// file.
pub(super) fn check_size(
    (width, height): (u64, u64),
    bytes: &[u8],
    per_byte: u64,
) -> Result<(), SizeError> {
    let bytes = bytes.len() as u64;
    let most = ALWAYS
        .saturating_add(per_byte.saturating_mul(bytes))
        .min(MOST);
    if (1..=most).contains(&width.saturating_mul(height)) {
        return Ok(());
    }
    Err(SizeError {
        width,
        height,
        bytes,
        most,
    })
}

impl std::error::Error for SizeError {}

impl std::fmt::Display for SizeError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let SizeError {
            width,
            height,
            bytes,
            most,
        } = self;
        write!(f, "has {width} x {height} pixels")?;
        if *width == 0 || *height == 0 {
            return Ok(());
        }
        write!(
            f,
            ", but of a file of {bytes} bytes at most {most} are read"
        )?;
        let remedy = if width.saturating_mul(*height) > MOST {
            "save it smaller"
        } else {
            "save it smaller, or with less compression"
        };
        write!(f, ": {remedy}")
    }
}
