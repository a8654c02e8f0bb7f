//! Atomic replacement of files.

use crate::partial::Partial;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Writes a file so that its path names either the old contents or all of the new ones, at
/// every moment, after any interruption, and whoever else writes it: the parts go into a file of
/// its own beside it, `NAME.radiosity-RANDOM.partial`, which is then renamed.
pub fn replace_file(path: &Path, parts: &[&[u8]]) -> io::Result<()> {
    replace_file_by(path, |file| {
        parts.iter().try_for_each(|part| file.write_all(part))
    })
}

/// [`replace_file`] with contents that are written bit by bit; after an error nothing is replaced.
pub fn replace_file_by(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let partial = Partial::beside(path)?;
    let mut buffered = BufWriter::with_capacity(1 << 20, partial.file());
    write(&mut buffered)?;
    buffered.flush()?;
    drop(buffered);
    partial.file().sync_all()?;
    partial.persist(path)
}
