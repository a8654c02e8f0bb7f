//! The names of files in the cache folder.

use crate::partial::{PARTIAL, is_partial};
use std::path::{Path, PathBuf};

pub(crate) const EXTENSION: &str = "bin";
const LOCK: &str = "lock";
const JOURNAL: &str = "journal";

/// A file in the folder, and the artifact that it is or belongs to.
pub(crate) struct CacheFile {
    pub(crate) path: PathBuf,
    pub(crate) artifact: PathBuf,
}

impl CacheFile {
    /// Recognizes `SCENE-STAGE-KEY.bin`, and the same with more behind it.
    pub(crate) fn of(path: PathBuf) -> Option<CacheFile> {
        let name = path.file_name()?.to_str()?;
        let end = name.rfind(&format!(".{EXTENSION}"))?;
        let (scene_and_stage, key) = name[..end].rsplit_once('-')?;
        let is_key = key.len() == 16 && key.bytes().all(|b| b.is_ascii_hexdigit());
        let suffix = &name[end + 1 + EXTENSION.len()..];
        let is_ours = suffix.is_empty()
            || suffix == format!(".{LOCK}")
            || suffix == format!(".{JOURNAL}")
            || suffix == format!(".{PARTIAL}")
            || is_partial(&path);
        let artifact = path.with_file_name(format!("{scene_and_stage}-{key}.{EXTENSION}"));
        (is_key && is_ours).then_some(CacheFile { path, artifact })
    }

    pub(crate) fn is_artifact(&self) -> bool {
        self.path == self.artifact
    }

    pub(crate) fn is_draft(&self) -> bool {
        self.path == partial_of(&self.artifact)
    }

    /// Whether an interrupted writer left it.
    pub(crate) fn is_leftover(&self) -> bool {
        let extension = self.path.extension();
        extension.is_some_and(|e| e == PARTIAL || e == JOURNAL)
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

fn beside(artifact: &Path, ending: &str) -> PathBuf {
    artifact.with_extension(format!("{EXTENSION}.{ending}"))
}
