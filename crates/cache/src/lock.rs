//! Locks between processes.

use std::fs::{File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};

/// Exclusive use of one artifact, until dropped. The operating system releases it too when the
/// process ends in any other way.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    /// Takes the lock file at `path`; calls `on_wait` once if somebody else has it.
    pub(crate) fn take(path: PathBuf, on_wait: impl FnOnce()) -> std::io::Result<Lock> {
        let mut on_wait = Some(on_wait);
        loop {
            let file = OpenOptions::new()
                .create(true)
                .truncate(false)
                .write(true)
                .open(&path)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    if let Some(on_wait) = on_wait.take() {
                        on_wait();
                    }
                    file.lock()?;
                }
                Err(TryLockError::Error(error)) => return Err(error),
            }
            // The previous owner may have removed the file between our opening and locking it.
            if is_still_at(&file, &path) {
                return Ok(Lock { path, _file: file });
            }
        }
    }

    /// Takes the lock file at `path` if nobody has it.
    pub(crate) fn try_take(path: PathBuf) -> std::io::Result<Option<Lock>> {
        let mut options = OpenOptions::new();
        let file = options.create(true).truncate(false).write(true);
        let file = file.open(&path)?;
        match file.try_lock() {
            Ok(()) if is_still_at(&file, &path) => Ok(Some(Lock { path, _file: file })),
            Ok(()) | Err(TryLockError::WouldBlock) => Ok(None),
            Err(TryLockError::Error(error)) => Err(error),
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        if cfg!(unix) {
            // A lock file that stays behind does no harm.
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

/// Whether the file that is open is the one at a path.
#[cfg(unix)]
pub(crate) fn is_still_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |metadata: std::fs::Metadata| (metadata.dev(), metadata.ino());
    match (file.metadata(), std::fs::metadata(path)) {
        (Ok(ours), Ok(there)) => identity(ours) == identity(there),
        _ => false,
    }
}

/// Where lock files are never removed, the one we opened is the one that is there.
#[cfg(not(unix))]
pub(crate) fn is_still_at(_: &File, _: &Path) -> bool {
    true
}
