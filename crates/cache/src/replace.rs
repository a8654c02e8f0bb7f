//! Atomic replacement of files.

use std::fs::File;
use std::io::Write;
use std::path::Path;

/// The ending of files that are being written, or whose writer was interrupted.
pub(crate) const PARTIAL: &str = "partial";

/// Writes a file so that its path names either the old contents or all of the new ones, at
/// every moment and after any interruption: the parts go into a file beside it, which is then
/// renamed. Two processes must not write the same file at the same time.
pub fn replace_file(path: &Path, parts: &[&[u8]]) -> std::io::Result<()> {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".");
    partial.push(PARTIAL);
    let mut file = File::create(&partial)?;
    for part in parts {
        file.write_all(part)?;
    }
    file.sync_all()?;
    std::fs::rename(&partial, path)
}
