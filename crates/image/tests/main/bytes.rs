//! Reading bytes as pictures.

use radiosity_image::{DecodeError, DecodeParams, Decoded, decode_picture};

pub(crate) fn decode(bytes: &[u8]) -> Result<Decoded, DecodeError> {
    decode_picture(bytes, &DecodeParams::default())
}

/// Why bytes are not read.
pub(crate) fn refusal(bytes: &[u8]) -> String {
    decode(bytes).unwrap_err().to_string()
}
