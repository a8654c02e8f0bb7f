//! When an artifact was last used, and by which scene: `NAME.bin.used` beside it.
//!
//! The time is that file's modification time; what is in it is the scene's name, for people. The
//! artifact's own modification time cannot serve: whoever has it mapped takes a new one for a
//! change of its values ([`Values::check`](crate::Values::check)). Its access time could, but many
//! systems do not keep it. Nothing but the order of removal and what is shown to people depends on
//! the file, so one that is missing, wrong or cannot be written does no harm.

use crate::cache_file::last_use_of;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;
use std::time::SystemTime;

/// No name is longer, whatever the file says; in bytes.
const LONGEST_NAME: u64 = 4096;

/// Notes that a scene uses an artifact now.
pub(crate) fn note_use(artifact: &Path, scene: &str) {
    // Nothing is removed from a folder that cannot be written, so nobody needs it there.
    let _ = fs::write(last_use_of(artifact), scene);
}

/// The name of the scene that used an artifact last, if that is known.
pub fn last_user(artifact: &Path) -> Option<String> {
    let mut name = String::new();
    let file = File::open(last_use_of(artifact)).ok()?;
    file.take(LONGEST_NAME).read_to_string(&mut name).ok()?;
    (!name.is_empty()).then_some(name)
}

/// When a file was last written, where the file system tells.
pub(crate) fn modified(path: &Path) -> Option<SystemTime> {
    fs::metadata(path).ok()?.modified().ok()
}
