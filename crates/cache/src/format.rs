//! The bytes of an artifact's file.
//!
//! A file is one bincode value (fixed-size integers, little endian) of
//! `(Preamble, Header, padding: Vec<u8>, values: Vec<f32>)`. The padding places the values on a
//! multiple of [`ALIGNMENT`] bytes, so that a memory map of the file can be used in place.
//! Nothing is decoded before its digest has been checked.

use crate::digests::Digest;
use crate::key::Key;
use crate::values::Changed;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io::{self, Read};
use std::ops::Range;

#[cfg(target_endian = "big")]
compile_error!("cache files are little endian and used in place");

/// The first bytes of every file.
const MAGIC: [u8; 8] = *b"RADIOSTY";
/// Raise it whenever the layout of files changes.
const VERSION: u32 = 1;
/// Bytes; a cache line, and the widest vector register.
pub(crate) const ALIGNMENT: usize = 64;
/// No header may be larger, whatever its length field says.
const HEADER_LIMIT: usize = 1 << 30;

#[derive(Serialize, Deserialize)]
struct Preamble {
    magic: [u8; 8],
    version: u32,
    header_len: u64,
    header_digest: [u8; 32],
}

const PREAMBLE_LEN: usize = 8 + 4 + 8 + 32;
/// The length of a `Vec` stands before its contents.
const LENGTH_LEN: usize = 8;

/// What a file says of itself.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Header {
    pub(crate) stage: String,
    pub(crate) key: [u8; 32],
    /// The encoded facts.
    facts: Vec<u8>,
    value_count: u64,
    pub(crate) block_digests: Vec<Digest>,
}

/// Why an artifact is not taken from the cache.
#[derive(Debug, thiserror::Error)]
pub enum Miss {
    /// There is no file of this key, nor one of this stage that the scene used last.
    #[error("nothing cached yet")]
    Nothing,
    /// The file is being written, or its writer was interrupted; the next one goes on with it.
    #[error("unfinished")]
    Unfinished,
    /// The scene used a file of this stage that was made from other inputs.
    #[error("nothing cached for these inputs")]
    InputsChanged,
    /// The file cannot be read.
    #[error("the cached file cannot be read: {0}")]
    Io(#[from] io::Error),
    /// The file does not begin as a cache file does.
    #[error("the cached file is not a cache file")]
    NotACacheFile,
    /// The file was written by another version of this program.
    #[error("the cached file has format version {found}, this program writes {VERSION}")]
    Version {
        /// The version it names.
        found: u32,
    },
    /// The header's digest is wrong, or the header does not decode.
    #[error("the cached file's header is damaged")]
    Header,
    /// The facts do not decode: another version of the program wrote them.
    #[error("the cached file was written by another version of this program")]
    Facts,
    /// The file is shorter or longer than its header says.
    #[error("the cached file has {found} bytes instead of {expected}")]
    Length {
        /// What its header implies.
        expected: u64,
        /// What it has.
        found: u64,
    },
    /// The file's name and its contents disagree on the key.
    #[error("the cached file belongs to another key")]
    OtherKey,
    /// A block's digest is wrong.
    #[error("the cached file's data is damaged (block {block})")]
    Block {
        /// The first damaged block.
        block: usize,
    },
    /// Its values are not what they were any more.
    #[error(transparent)]
    Changed(#[from] Changed),
}

fn config() -> impl bincode::config::Config {
    bincode::config::standard()
        .with_fixed_int_encoding()
        .with_limit::<HEADER_LIMIT>()
}

pub(crate) fn encode(value: &impl Serialize) -> Vec<u8> {
    let unlimited = bincode::config::standard().with_fixed_int_encoding();
    bincode::serde::encode_to_vec(value, unlimited).expect("plain data always encodes")
}

/// Decodes a value that must fill all of `bytes`.
pub(crate) fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    let (value, consumed) = bincode::serde::decode_from_slice(bytes, config()).ok()?;
    (consumed == bytes.len()).then_some(value)
}

/// Bytes with their digest before them.
pub(crate) fn sealed(bytes: &[u8]) -> Vec<u8> {
    [blake3::hash(bytes).as_bytes(), bytes].concat()
}

/// The bytes that [`sealed`] was given, if they and their digest are undamaged.
pub(crate) fn unsealed(sealed: &[u8]) -> Option<&[u8]> {
    let (digest, bytes) = sealed.split_first_chunk::<32>()?;
    (blake3::hash(bytes).as_bytes() == digest).then_some(bytes)
}

/// Everything that stands before `count` values, their number included.
pub(crate) fn head(
    stage: &str,
    key: Key,
    facts: &impl Serialize,
    count: u64,
    block_digests: Vec<Digest>,
) -> Vec<u8> {
    let header = encode(&Header {
        stage: stage.to_owned(),
        key: key.0,
        facts: encode(facts),
        value_count: count,
        block_digests,
    });
    let preamble = Preamble {
        magic: MAGIC,
        version: VERSION,
        header_len: header.len() as u64,
        header_digest: *blake3::hash(&header).as_bytes(),
    };
    let mut head = encode(&preamble);
    head.extend(&header);
    head.extend(after_header(header.len(), count));
    head
}

/// The padding, and the length of the array that follows it.
fn after_header(header_len: usize, value_count: u64) -> Vec<u8> {
    let padding = vec![0u8; padding_len(header_len)];
    encode(&(padding, value_count))
}

/// Reads and checks everything that stands before the values of a file of so many bytes; gives the
/// header and where the values are.
pub(crate) fn read_head(file: &mut impl Read, len: u64) -> Result<(Header, Range<u64>), Miss> {
    let preamble = next_bytes(file, PREAMBLE_LEN)?;
    let preamble: Preamble = decode(&preamble).ok_or(Miss::NotACacheFile)?;
    if preamble.magic != MAGIC {
        return Err(Miss::NotACacheFile);
    }
    if preamble.version != VERSION {
        return Err(Miss::Version {
            found: preamble.version,
        });
    }
    let header_len = usize::try_from(preamble.header_len)
        .ok()
        .filter(|&header_len| header_len <= HEADER_LIMIT)
        .ok_or(Miss::Header)?;
    let header = next_bytes(file, header_len)?;
    let is_good = blake3::hash(&header).as_bytes() == &preamble.header_digest;
    let header: Header = decode(&header).filter(|_| is_good).ok_or(Miss::Header)?;
    let after_header = after_header(header_len, header.value_count);
    let start = (PREAMBLE_LEN + header_len + after_header.len()) as u64;
    let expected = start.saturating_add(header.value_count.saturating_mul(4));
    if expected != len {
        return Err(Miss::Length {
            expected,
            found: len,
        });
    }
    if next_bytes(file, after_header.len())? != after_header {
        return Err(Miss::Header);
    }
    Ok((header, start..len))
}

/// The next so many bytes, or as many as there are.
fn next_bytes(file: &mut impl Read, len: usize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(len as u64).read_to_end(&mut bytes)?;
    Ok(bytes)
}

impl Header {
    /// The typed facts.
    pub(crate) fn facts<F: DeserializeOwned>(&self) -> Result<F, Miss> {
        decode(&self.facts).ok_or(Miss::Facts)
    }
}

fn padding_len(header_len: usize) -> usize {
    let unpadded = PREAMBLE_LEN + header_len + 2 * LENGTH_LEN;
    unpadded.next_multiple_of(ALIGNMENT) - unpadded
}
