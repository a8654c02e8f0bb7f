//! Files that a command is told to read.

use crate::error::Error;
use radiosity::resources::check_file;
use std::path::Path;

/// All bytes of a file.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Error> {
    check_regular(path)?;
    let size = std::fs::metadata(path).map_or(0, |metadata| metadata.len());
    check_file(path, size)?;
    std::fs::read(path)
        .map_err(|error| Error::input(format!("cannot read {}: {error}", path.display())))
}

/// Refuses what is there and no file, before it is opened: opening a pipe waits for its writer, and
/// a device may have no end.
pub(super) fn check_regular(path: &Path) -> Result<(), Error> {
    match std::fs::metadata(path) {
        Ok(metadata) if !metadata.is_file() => Err(Error::with_help(
            format!("cannot read {}: it is no regular file", path.display()),
            "what comes from a pipe or a device must be saved first",
        )),
        _ => Ok(()),
    }
}
