//! What is in the cache folder.

use crate::artifact::open;
use crate::cache_file::{CacheFile, last_use_of};
use crate::format::Miss;
use crate::last_use::{last_user, modified};
use crate::store::{CacheError, Store};
use std::fs;
use std::path::PathBuf;
use std::time::SystemTime;

/// A file in the cache.
#[derive(Debug)]
pub struct Entry {
    /// Where it is.
    pub path: PathBuf,
    /// Its size.
    pub bytes: u64,
    /// When it was last written or read, where the file system tells.
    pub last_use: Option<SystemTime>,
    /// The scene that wrote or read it last, if that is known.
    pub scene: Option<String>,
    /// The stage it names, or why it is not usable.
    pub stage: Result<String, Miss>,
}

impl Store {
    /// All cached files, by name, unfinished ones included.
    pub fn list(&self) -> Result<Vec<Entry>, CacheError> {
        let is_listed = |file: &CacheFile| file.is_artifact() || file.is_draft();
        let files = self.files()?.into_iter().filter(is_listed);
        Ok(files.map(Entry::of).collect())
    }
}

impl Entry {
    fn of(file: CacheFile) -> Entry {
        Entry {
            bytes: fs::metadata(&file.path).map_or(0, |metadata| metadata.len()),
            last_use: modified(&file.path).max(modified(&last_use_of(&file.artifact))),
            scene: last_user(&file.artifact),
            stage: if file.is_draft() {
                Err(Miss::Unfinished)
            } else {
                open(&file.path).map(|opened| opened.stage)
            },
            path: file.path,
        }
    }
}
