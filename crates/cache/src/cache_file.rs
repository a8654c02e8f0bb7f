//! The names of files in the cache folder.

use crate::partial::{PARTIAL, is_partial};
use std::path::{Path, PathBuf};

pub(crate) const EXTENSION: &str = "bin";
const LOCK: &str = "lock";
const JOURNAL: &str = "journal";
const LAST_USE: &str = "used";
/// How many hexadecimal digits of a key are in a name.
const KEY_DIGITS: usize = 16;

/// A file in the folder, and the artifact that it is or belongs to.
pub(crate) struct CacheFile {
    pub(crate) path: PathBuf,
    pub(crate) artifact: PathBuf,
    /// What stands before the key: the stage. Earlier versions had `SCENE-STAGE` there.
    pub(crate) stage: String,
}

impl CacheFile {
    /// Recognizes `STAGE-KEY.bin`, and the same with more behind it.
    pub(crate) fn of(path: PathBuf) -> Option<CacheFile> {
        let name = path.file_name()?.to_str()?;
        let end = name.rfind(&format!(".{EXTENSION}"))?;
        let (stage, key) = name[..end].rsplit_once('-')?;
        let is_key = key.len() == KEY_DIGITS && key.bytes().all(|b| b.is_ascii_hexdigit());
        let suffix = &name[end + 1 + EXTENSION.len()..];
        let is_ours = suffix.is_empty()
            || suffix == format!(".{LOCK}")
            || suffix == format!(".{JOURNAL}")
            || suffix == format!(".{LAST_USE}")
            || suffix == format!(".{PARTIAL}")
            || is_partial(&path);
        let (stage, artifact) = (stage.to_owned(), format!("{stage}-{key}.{EXTENSION}"));
        let artifact = path.with_file_name(artifact);
        (is_key && is_ours).then_some(CacheFile {
            path,
            artifact,
            stage,
        })
    }

    pub(crate) fn is_artifact(&self) -> bool {
        self.path == self.artifact
    }

    pub(crate) fn is_draft(&self) -> bool {
        self.path == partial_of(&self.artifact)
    }

    pub(crate) fn is_lock(&self) -> bool {
        self.path == lock_of(&self.artifact)
    }

    pub(crate) fn is_last_use(&self) -> bool {
        self.path == last_use_of(&self.artifact)
    }

    /// Whether an interrupted writer left it.
    pub(crate) fn is_leftover(&self) -> bool {
        let extension = self.path.extension();
        extension.is_some_and(|e| e == PARTIAL || e == JOURNAL)
    }

    /// Whether an earlier version gave this name to the artifact that is at a path now:
    /// `SCENE-STAGE-KEY.bin`.
    pub(crate) fn is_former_name_of(&self, artifact: &Path) -> bool {
        let Some(name) = artifact.file_name() else {
            return false;
        };
        let ending = format!("-{}", name.to_string_lossy());
        self.is_artifact() && self.path.to_string_lossy().ends_with(&ending)
    }
}

/// The lock file of an artifact.
pub(crate) fn lock_of(artifact: &Path) -> PathBuf {
    beside(artifact, LOCK)
}

/// The file that a [`Draft`](crate::Draft) of an artifact writes.
pub(crate) fn partial_of(artifact: &Path) -> PathBuf {
    beside(artifact, PARTIAL)
}

/// The file that says how far a [`Draft`](crate::Draft) has come.
pub(crate) fn journal_of(artifact: &Path) -> PathBuf {
    beside(artifact, JOURNAL)
}

/// The file that says when an artifact was last used.
pub(crate) fn last_use_of(artifact: &Path) -> PathBuf {
    beside(artifact, LAST_USE)
}

fn beside(artifact: &Path, ending: &str) -> PathBuf {
    artifact.with_extension(format!("{EXTENSION}.{ending}"))
}
