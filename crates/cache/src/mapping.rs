//! Files as memory.

use std::fs::File;
use std::ops::Range;

/// The values of a cache file, mapped into memory.
#[derive(Debug)]
pub struct MappedValues {
    map: memmap2::Mmap,
    values: Range<usize>,
}

/// Maps a file, read-only.
#[allow(
    unsafe_code,
    reason = "a map is sound only while nobody changes the file"
)]
pub(crate) fn map(file: &File) -> std::io::Result<memmap2::Mmap> {
    // SAFETY: cache files are never changed in place, but for the head of a draft, at which its
    // owner does not look. A new file is written under another name and renamed over the old one,
    // which stays alive for those who have mapped it.
    unsafe { memmap2::Mmap::map(file) }
}

impl MappedValues {
    /// The `f32` values in a range of bytes, which must be aligned.
    pub(crate) fn new(map: memmap2::Mmap, values: Range<usize>) -> MappedValues {
        MappedValues { map, values }
    }
}

impl AsRef<[f32]> for MappedValues {
    fn as_ref(&self) -> &[f32] {
        bytemuck::cast_slice(&self.map[self.values.clone()])
    }
}
