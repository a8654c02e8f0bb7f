//! What is known of a draft at its last checkpoint, and why a draft cannot be gone on with.

use crate::cache_file::{journal_of, partial_of};
use crate::digests::{BLOCK_VALUES, Digest, Digests};
use crate::format;
use crate::key::Key;
use crate::values::{Stamp, Values};
use serde::{Deserialize, Serialize};
use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::Path;

/// Raise it whenever the layout of journals changes.
const VERSION: u32 = 1;

/// What is known of a draft at a checkpoint.
#[derive(Serialize, Deserialize)]
pub(super) struct Journal {
    pub(super) key: [u8; 32],
    pub(super) start: u64,
    pub(super) count: u64,
    pub(super) written: u64,
    pub(super) digests: Vec<Digest>,
    pub(super) state: Vec<u8>,
}

/// Why what an interrupted writer has left is not gone on with.
#[derive(Debug, thiserror::Error)]
pub enum Unusable {
    /// It came to no checkpoint, or its journal is lost.
    #[error("it has no checkpoint")]
    NoCheckpoint,
    /// Its values or its journal cannot be read.
    #[error("it cannot be read: {0}")]
    Unreadable(#[from] io::Error),
    /// The journal's digest is wrong.
    #[error("its journal is damaged")]
    Journal,
    /// Another version of the program wrote it.
    #[error("another version of this program wrote it")]
    Version,
    /// It has the name of this artifact, and the key or the size of another.
    #[error("it belongs to other inputs")]
    OtherInputs,
    /// The file is shorter than it was at the last checkpoint.
    #[error("it is cut off at byte {found}, and its checkpoint is at byte {expected}")]
    Cut {
        /// How long it was.
        expected: u64,
        /// How long it is.
        found: u64,
    },
    /// The digest of some values is wrong.
    #[error("it is damaged somewhere from byte {from} to byte {to}")]
    Damaged {
        /// Where the first damaged block begins.
        from: u64,
        /// Where it ends.
        to: u64,
    },
}

impl Journal {
    /// The bytes of its file.
    pub(super) fn sealed(&self) -> Vec<u8> {
        format::sealed(&format::encode(&(VERSION, self)))
    }

    /// That of a draft, if there is a draft.
    pub(super) fn read(artifact: &Path) -> Result<Option<Journal>, Unusable> {
        let sealed = match fs::read(journal_of(artifact)) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                let is_draft = partial_of(artifact).exists();
                return if is_draft {
                    Err(Unusable::NoCheckpoint)
                } else {
                    Ok(None)
                };
            }
            sealed => sealed?,
        };
        let bytes = format::unsealed(&sealed).ok_or(Unusable::Journal)?;
        match format::decode::<(u32, Journal)>(bytes) {
            Some((VERSION, journal)) => Ok(Some(journal)),
            _ => Err(Unusable::Version),
        }
    }

    /// Whether it is that of this artifact.
    pub(super) fn check(&self, key: Key, start: u64, count: u64) -> Result<(), Unusable> {
        if self.key != key.bytes() || self.count != count || self.written > count {
            return Err(Unusable::OtherInputs);
        }
        // The facts of the same inputs take as much room in every run of one version.
        if self.start != start {
            return Err(Unusable::Version);
        }
        Ok(())
    }

    /// Where the values end that a draft had at the checkpoint.
    pub(super) fn end(&self) -> u64 {
        self.start + 4 * self.written
    }

    /// The digests of those values, if no byte is missing or damaged. Moves the file's cursor.
    pub(super) fn digests_of(&self, path: &Path, file: &File) -> Result<Digests, Unusable> {
        let (stamp, expected) = (Stamp::of(file)?, self.end());
        if stamp.len < expected {
            return Err(Unusable::Cut {
                expected,
                found: stamp.len,
            });
        }
        let values = Values::of(path, file, self.start..expected, stamp)?;
        let digests = Digests::of(values.as_ref());
        let all = digests.all();
        let damaged = all.iter().zip(&self.digests).position(|(a, b)| a != b);
        match damaged {
            None if all.len() == self.digests.len() => Ok(digests),
            None => Err(Unusable::Version),
            Some(block) => {
                let from = self.start + 4 * (block * BLOCK_VALUES) as u64;
                let to = expected.min(from + 4 * BLOCK_VALUES as u64) - 1;
                Err(Unusable::Damaged { from, to })
            }
        }
    }
}
