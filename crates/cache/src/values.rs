//! The values of a file: in memory, or the file as memory.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

#[cfg(test)]
mod tests;

/// Values of so many bytes are read, more are mapped: reading takes some 20 ms at most, as much
/// memory as the solver needs anyway, and whoever changes the file later changes nothing.
const MOST_READ: u64 = 64 << 20;

/// The values of a cache file.
#[derive(Debug)]
pub struct Values(Place);

#[derive(Debug)]
enum Place {
    Memory(Vec<f32>),
    Mapped {
        map: memmap2::Mmap,
        values: Range<usize>,
        source: Arc<Source>,
    },
}

/// A file whose values are used in place.
#[derive(Debug)]
pub(crate) struct Source {
    path: PathBuf,
    file: File,
    stamp: Mutex<Stamp>,
}

/// What tells that a file was changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Stamp {
    pub(crate) len: u64,
    modified: Option<SystemTime>,
}

/// Somebody has cut or overwritten a file while its values were in use.
#[derive(Debug, thiserror::Error)]
#[error("{} was changed while it was in use", path.display())]
pub struct Changed {
    /// The file.
    pub path: PathBuf,
}

impl Stamp {
    pub(crate) fn of(file: &File) -> io::Result<Stamp> {
        let metadata = file.metadata()?;
        Ok(Stamp {
            len: metadata.len(),
            modified: metadata.modified().ok(),
        })
    }
}

impl Source {
    fn check(&self) -> Result<(), Changed> {
        match Stamp::of(&self.file) {
            Ok(stamp) if stamp == *self.stamp() => Ok(()),
            _ => Err(Changed {
                path: self.path.clone(),
            }),
        }
    }

    /// The file's owner has changed it, and not its values.
    pub(crate) fn renew(&self) -> io::Result<()> {
        *self.stamp() = Stamp::of(&self.file)?;
        Ok(())
    }

    fn stamp(&self) -> MutexGuard<'_, Stamp> {
        self.stamp.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Values {
    pub(crate) fn in_memory(values: Vec<f32>) -> Values {
        Values(Place::Memory(values))
    }

    /// Those in a range of a file's bytes, where they are aligned, as long as it has this stamp.
    /// Moves the file's cursor.
    pub(crate) fn of(
        path: &Path,
        file: &File,
        range: Range<u64>,
        stamp: Stamp,
    ) -> io::Result<Values> {
        if range.end - range.start <= MOST_READ {
            return read(file, range).map(Values::in_memory);
        }
        Ok(Values(Place::Mapped {
            map: map(file)?,
            values: range.start as usize..range.end as usize,
            source: Arc::new(Source {
                path: path.to_owned(),
                file: file.try_clone()?,
                stamp: Mutex::new(stamp),
            }),
        }))
    }

    /// The file, if it is used in place.
    pub(crate) fn source(&self) -> Option<&Arc<Source>> {
        match &self.0 {
            Place::Memory(_) => None,
            Place::Mapped { source, .. } => Some(source),
        }
    }

    /// Whether they are still what they were.
    pub fn check(&self) -> Result<(), Changed> {
        self.source().map_or(Ok(()), |source| source.check())
    }
}

impl AsRef<[f32]> for Values {
    fn as_ref(&self) -> &[f32] {
        match &self.0 {
            Place::Memory(values) => values,
            Place::Mapped { map, values, .. } => bytemuck::cast_slice(&map[values.clone()]),
        }
    }
}

fn read(file: &File, range: Range<u64>) -> io::Result<Vec<f32>> {
    let mut file = file;
    let mut values = vec![0.0f32; (range.end - range.start) as usize / 4];
    file.seek(SeekFrom::Start(range.start))?;
    file.read_exact(bytemuck::cast_slice_mut(&mut values))?;
    Ok(values)
}

/// Maps a file, read-only.
#[allow(
    unsafe_code,
    reason = "a map is sound only while nobody changes the file"
)]
fn map(file: &File) -> io::Result<memmap2::Mmap> {
    // SAFETY: this program never changes cache files in place, but for the head of a draft, at
    // which its owner does not look. A new file is written under another name and renamed over the
    // old one, which stays alive for those who have mapped it. That another program has changed
    // one is noticed before anything is made of it (`InUse`), unless it was cut: that ends the
    // process.
    unsafe { memmap2::Mmap::map(file) }
}

/// The files whose values are used in place.
#[derive(Debug, Default)]
pub(crate) struct InUse(Mutex<Vec<Arc<Source>>>);

impl InUse {
    pub(crate) fn add(&self, source: &Arc<Source>) {
        let mut sources = self.sources();
        // What was made of those that nobody uses any more is as good as they were up to now.
        sources.retain(|source| Arc::strong_count(source) > 1 || source.check().is_err());
        sources.push(source.clone());
    }

    /// Whether all are still what they were.
    pub(crate) fn check(&self) -> Result<(), Changed> {
        self.sources().iter().try_for_each(|source| source.check())
    }

    fn sources(&self) -> MutexGuard<'_, Vec<Arc<Source>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
