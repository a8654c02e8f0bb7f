//! The identity of an artifact.

use serde::Serialize;
use std::fmt;

/// The BLAKE3 digest of everything that a stage reads, and of its name and format version.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Key(pub(crate) [u8; 32]);

impl Key {
    /// The key of what stage `stage` makes from `inputs`. Raise `version` whenever the stage
    /// would make something else from the same inputs.
    pub fn of(stage: &str, version: u32, inputs: &impl Serialize) -> Key {
        let mut hasher = blake3::Hasher::new();
        let mut writer = std::io::BufWriter::new(&mut hasher);
        let config = bincode::config::standard().with_fixed_int_encoding();
        bincode::serde::encode_into_std_write((stage, version, inputs), &mut writer, config)
            .expect("plain data always encodes, and a hasher accepts every byte");
        let hasher = writer.into_inner().expect("a hasher accepts every byte");
        Key(*hasher.finalize().as_bytes())
    }

    /// All 32 bytes, for use in the inputs of a later stage's key.
    pub fn bytes(&self) -> [u8; 32] {
        self.0
    }

    /// The first eight bytes in hexadecimal: enough for file names.
    pub fn prefix(&self) -> String {
        self.0[..8].iter().map(|b| format!("{b:02x}")).collect()
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|b| write!(f, "{b:02x}"))
    }
}

impl fmt::Debug for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Key({self})")
    }
}
