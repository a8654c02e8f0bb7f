//! Files that a command is told to read.

use crate::error::Error;
use crate::resources::check_file;
use std::fmt::Display;
use std::path::Path;

/// All bytes of a file.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Error> {
    check_file(path, size(path)?)?;
    std::fs::read(path).map_err(|error| unreadable(path, &error))
}

/// The size of a file. Whatever else is there is refused before it is opened: opening a pipe waits
/// for its writer, and a device may have no end.
pub(super) fn size(path: &Path) -> Result<u64, Error> {
    let metadata = std::fs::metadata(path).map_err(|error| unreadable(path, &error))?;
    if metadata.is_file() {
        Ok(metadata.len())
    } else {
        let help = "what comes from a pipe or a device must be saved first";
        let problem = format!("it is no regular file\n   = help: {help}");
        Err(unreadable(path, &problem))
    }
}

fn unreadable(path: &Path, problem: &dyn Display) -> Error {
    Error::Input(format!("cannot read {}: {problem}", path.display()))
}
