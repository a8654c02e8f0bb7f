//! The cache folder.

use crate::artifact::{Artifact, Opened};
use crate::cache_file::{CacheFile, EXTENSION, journal_of, lock_of, partial_of};
use crate::digests::Digests;
use crate::format::{self, Miss};
use crate::key::Key;
use crate::last_use::{last_user, note_use};
use crate::lock::Lock;
use crate::replace::replace_file;
use crate::values::{Changed, InUse};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[cfg(test)]
mod tests;

/// A folder of cached artifacts.
///
/// ```
/// use radiosity_cache::{Id, Key, Store};
///
/// let folder = tempfile::tempdir()?;
/// let store = Store::new(folder.path());
/// let id = |version| Id {
///     scene: "room",
///     stage: "squares",
///     key: Key::of("squares", version, &[1, 2, 3]),
/// };
/// store.write(&id(1), &"facts", &[1.0, 4.0, 9.0])?;
/// let (facts, values) = store.read::<String>(&id(1))?.into_values()?;
/// assert_eq!((facts.as_str(), values.as_ref()), ("facts", &[1.0, 4.0, 9.0][..]));
/// // Of other inputs, or another version, there is none.
/// assert!(store.read::<String>(&id(2)).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Store {
    folder: PathBuf,
    pub(crate) in_use: Arc<InUse>,
}

/// What names an artifact, and who asks for it. The file is `<stage>-<key prefix>.bin`: scenes that
/// have the same inputs share it, whatever they are called.
#[derive(Clone, Copy, Debug)]
pub struct Id<'a> {
    /// The name of the scene, for people alone.
    pub scene: &'a str,
    /// The name of the stage.
    pub stage: &'a str,
    /// The identity.
    pub key: Key,
}

/// A cache folder or file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("cannot {action} {}: {error}", path.display())]
pub struct CacheError {
    /// What was tried.
    pub action: &'static str,
    /// On what.
    pub path: PathBuf,
    /// What went wrong.
    #[source]
    pub error: std::io::Error,
}

impl Store {
    /// The cache in a folder, which is made when something is first written.
    pub fn new(folder: impl Into<PathBuf>) -> Store {
        Store {
            folder: folder.into(),
            in_use: Arc::default(),
        }
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The path of an artifact's file.
    pub fn path(&self, id: &Id<'_>) -> PathBuf {
        let (stage, prefix) = (id.stage, id.key.prefix());
        self.folder.join(format!("{stage}-{prefix}.{EXTENSION}"))
    }

    /// Takes exclusive use of an artifact; calls `on_wait` once if another process has it.
    pub fn lock(&self, id: &Id<'_>, on_wait: impl FnOnce()) -> Result<Lock, CacheError> {
        self.make_folder()?;
        let path = lock_of(&self.path(id));
        Lock::take(path.clone(), on_wait).map_err(CacheError::new("lock", &path))
    }

    /// Removes what an interrupted writer has left beside an artifact that is there, if nobody is
    /// writing it now.
    pub fn tidy(&self, id: &Id<'_>) {
        let path = self.path(id);
        let left = [partial_of(&path), journal_of(&path), lock_of(&path)];
        if left.iter().any(|path| path.exists())
            && let Ok(Some(_lock)) = Lock::try_take(lock_of(&path))
        {
            self.remove_leftovers(&path);
        }
    }

    /// Reads an artifact's facts, or says why it must be computed. The values are not yet read.
    pub fn read<F: DeserializeOwned>(&self, id: &Id<'_>) -> Result<Artifact<F>, Miss> {
        let opened = self.open(id)?;
        if opened.key != id.key || opened.stage != id.stage {
            return Err(Miss::OtherKey);
        }
        let artifact = opened.into_artifact()?;
        note_use(&self.path(id), id.scene);
        Ok(artifact)
    }

    fn open(&self, id: &Id<'_>) -> Result<Opened, Miss> {
        let path = self.path(id);
        match Opened::at(&path, self.in_use.clone()) {
            Err(Miss::Io(error)) if error.kind() == ErrorKind::NotFound => {
                if self.rename_former(&path) {
                    Opened::at(&path, self.in_use.clone())
                } else {
                    Err(self.absence(id))
                }
            }
            opened => opened,
        }
    }

    /// Gives the artifact that is to be at a path its name, if an earlier version wrote it under
    /// another; whether it is there now.
    fn rename_former(&self, path: &Path) -> bool {
        let files = self.files().unwrap_or_default();
        let former = files.iter().find(|file| file.is_former_name_of(path));
        former.is_some_and(|former| fs::rename(&former.path, path).is_ok())
    }

    /// Whether files whose values are used in place are still what they were. What was made of them
    /// is worth nothing if not: ask before it is kept or shown.
    pub fn check(&self) -> Result<(), Changed> {
        self.in_use.check()
    }

    /// Writes an artifact. Whoever looks meanwhile, or after an interruption, finds the old
    /// file or none, never half of the new one. Returns the size in bytes.
    pub fn write(
        &self,
        id: &Id<'_>,
        facts: &impl Serialize,
        values: &[f32],
    ) -> Result<u64, CacheError> {
        self.make_folder()?;
        let path = self.path(id);
        self.remove_leftovers(&path);
        let (count, digests) = (values.len() as u64, Digests::of(values).all());
        let head = format::head(id.stage, id.key, facts, count, digests);
        let data: &[u8] = bytemuck::cast_slice(values);
        let checked = self.check().map_err(std::io::Error::other);
        checked
            .and_then(|()| replace_file(&path, &[&head, data]))
            .map_err(CacheError::new("write", &path))?;
        note_use(&path, id.scene);
        Ok((head.len() + data.len()) as u64)
    }

    /// Removes what interrupted writers of an artifact left. The caller has its lock.
    pub(crate) fn remove_leftovers(&self, artifact: &Path) {
        for file in self.files().unwrap_or_default() {
            if file.artifact == artifact && file.is_leftover() {
                // One that stays does no harm.
                let _ = fs::remove_file(&file.path);
            }
        }
    }

    pub(crate) fn make_folder(&self) -> Result<(), CacheError> {
        fs::create_dir_all(&self.folder).map_err(CacheError::new("create", &self.folder))
    }

    /// Why there is no file: never made, or made from other inputs.
    fn absence(&self, id: &Id<'_>) -> Miss {
        let is_of_the_scene = |file: &CacheFile| {
            file.is_artifact()
                && file.stage == id.stage
                && last_user(&file.artifact).as_deref() == Some(id.scene)
        };
        match self.files() {
            Ok(files) if files.iter().any(is_of_the_scene) => Miss::InputsChanged,
            _ => Miss::Nothing,
        }
    }

    /// All files of the folder that have the name of an artifact, its lock or a part of it.
    pub(crate) fn files(&self) -> Result<Vec<CacheFile>, CacheError> {
        let entries = match fs::read_dir(&self.folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(CacheError::new("list", &self.folder)(error)),
        };
        let paths = entries.filter_map(|entry| {
            let entry = entry.ok()?;
            entry.file_type().ok()?.is_file().then(|| entry.path())
        });
        let mut files: Vec<CacheFile> = paths.filter_map(CacheFile::of).collect();
        files.sort_by(|a, b| a.path.cmp(&b.path));
        Ok(files)
    }
}

impl CacheError {
    pub(crate) fn new(action: &'static str, path: &Path) -> impl Fn(std::io::Error) -> CacheError {
        let path = path.to_owned();
        move |error| CacheError {
            action,
            path: path.clone(),
            error,
        }
    }
}
