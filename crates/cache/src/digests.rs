//! Digests of values, block by block.

use rayon::prelude::*;

/// A BLAKE3 digest.
pub(crate) type Digest = [u8; 32];

/// Values per block; each block has a digest of its own.
pub(crate) const BLOCK_VALUES: usize = 1 << 18;

/// The digests of values that come one after the other, in pieces of any length.
#[derive(Debug, Default)]
pub(crate) struct Digests {
    /// Of whole blocks.
    whole: Vec<Digest>,
    /// Of the last one, and how many values it has.
    begun: blake3::Hasher,
    count: usize,
}

impl Digests {
    pub(crate) fn of(values: &[f32]) -> Digests {
        let (blocks, last) = values.as_chunks::<BLOCK_VALUES>();
        let digest = |block: &[f32; BLOCK_VALUES]| *blake3::hash(bytes(block)).as_bytes();
        let mut digests = Digests {
            whole: blocks.par_iter().map(digest).collect(),
            ..Digests::default()
        };
        digests.extend(last);
        digests
    }

    /// Adds values, on the calling thread alone: that of a writer belongs to no pool, and would
    /// wake one with more threads than were asked for.
    pub(crate) fn extend(&mut self, values: &[f32]) {
        let mut left = values;
        while !left.is_empty() {
            let missing = BLOCK_VALUES - self.count;
            let (next, rest) = left.split_at(missing.min(left.len()));
            self.begun.update(bytes(next));
            self.count += next.len();
            if self.count == BLOCK_VALUES {
                self.whole.push(*self.begun.finalize().as_bytes());
                self.begun.reset();
                self.count = 0;
            }
            left = rest;
        }
    }

    /// One digest per block; the last block may be shorter than others.
    pub(crate) fn all(&self) -> Vec<Digest> {
        let mut all = self.whole.clone();
        if self.count > 0 {
            all.push(*self.begun.finalize().as_bytes());
        }
        all
    }
}

fn bytes(values: &[f32]) -> &[u8] {
    bytemuck::cast_slice(values)
}
