//! Files that are being written, under names of their own: `NAME.radiosity-RANDOM.partial`.
//!
//! Whoever writes one has it locked. So one that nobody has locked was left by a process that was
//! killed, and is removed by the next that writes into the folder. A process that a signal ends
//! removes its own by [`remove_unfinished`].

use crate::lock::is_still_at;
use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::NamedTempFile;

/// The ending of files that are being written, or whose writer was interrupted.
pub(crate) const PARTIAL: &str = "partial";
/// Stands before the random part: nobody else names files so.
const MARK: &str = "radiosity-";
const RANDOM_LEN: usize = 6;

/// What this process is writing.
static HERE: Mutex<Here> = Mutex::new(Here {
    unfinished: BTreeSet::new(),
    swept: BTreeSet::new(),
});

struct Here {
    unfinished: BTreeSet<PathBuf>,
    /// Folders that were searched for what others have left.
    swept: BTreeSet<PathBuf>,
}

fn here() -> MutexGuard<'static, Here> {
    HERE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file that will be another's replacement, and is removed if it does not come to that.
#[derive(Debug)]
pub(crate) struct Partial {
    path: PathBuf,
    file: Option<NamedTempFile>,
}

impl Partial {
    /// A new one beside what it will replace.
    pub(crate) fn beside(target: &Path) -> io::Result<Partial> {
        let folder = match target.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        let mut here = here();
        if here.swept.insert(folder.to_owned()) {
            sweep(folder);
        }
        let file = locked(folder, &name)?;
        let path = file.path().to_owned();
        here.unfinished.insert(path.clone());
        Ok(Partial {
            path,
            file: Some(file),
        })
    }

    pub(crate) fn file(&self) -> &File {
        let file = self.file.as_ref();
        file.expect("there until it is dropped").as_file()
    }

    /// Gives it the name of what it replaces.
    pub(crate) fn persist(mut self, target: &Path) -> io::Result<()> {
        let _not_removed_meanwhile = here();
        let file = self.file.take().expect("there until it is dropped");
        file.persist(target).map_err(|error| error.error)?;
        Ok(())
    }
}

impl Drop for Partial {
    fn drop(&mut self) {
        let mut here = here();
        // Removes it, unless it has its name.
        self.file = None;
        here.unfinished.remove(&self.path);
    }
}

/// Removes all files that this process is replacing others by. No more are begun, and none gets its
/// name, until the result is dropped: for those whom a signal ends.
#[must_use = "files can be written again once it is dropped"]
pub fn remove_unfinished() -> impl Sized {
    let here = here();
    for path in &here.unfinished {
        // One that stays is removed by the next process.
        let _ = fs::remove_file(path);
    }
    here
}

/// A new file that this process has locked.
fn locked(folder: &Path, name: &str) -> io::Result<NamedTempFile> {
    loop {
        let (prefix, suffix) = (format!("{name}.{MARK}"), format!(".{PARTIAL}"));
        let mut builder = tempfile::Builder::new();
        builder
            .prefix(&prefix)
            .suffix(&suffix)
            .rand_bytes(RANDOM_LEN);
        let file = with_usual_permissions(&mut builder).tempfile_in(folder)?;
        // Where files cannot be locked, nobody takes them for left behind either.
        let _ = file.as_file().lock();
        // Another process may have taken it for left behind before it was locked.
        if is_still_at(file.as_file(), file.path()) {
            return Ok(file);
        }
    }
}

/// Removes what writers have left that are gone. One that stays does no harm.
fn sweep(folder: &Path) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let is_file = |entry: &fs::DirEntry| entry.file_type().is_ok_and(|kind| kind.is_file());
    let ours = entries.filter(is_file).map(|entry| entry.path());
    for path in ours.filter(|path| is_partial(path)) {
        let Ok(file) = OpenOptions::new().write(true).open(&path) else {
            continue;
        };
        if file.try_lock().is_ok() && is_still_at(&file, &path) {
            let _ = fs::remove_file(&path);
        }
    }
}

/// Whether a file has the name of one that is being written.
pub(crate) fn is_partial(path: &Path) -> bool {
    let random = || {
        let name = path.file_name()?.to_str()?;
        let stem = name.strip_suffix(PARTIAL)?.strip_suffix('.')?;
        let (_, random) = stem.rsplit_once(&format!(".{MARK}"))?;
        Some(random.as_bytes())
    };
    random().is_some_and(|random| {
        random.len() == RANDOM_LEN && random.iter().all(u8::is_ascii_alphanumeric)
    })
}

/// Results are no secrets: like any new file, as the user's mask says.
#[cfg(unix)]
fn with_usual_permissions<'a, 'b, 'c>(
    builder: &'c mut tempfile::Builder<'a, 'b>,
) -> &'c mut tempfile::Builder<'a, 'b> {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(std::fs::Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn with_usual_permissions<'a, 'b, 'c>(
    builder: &'c mut tempfile::Builder<'a, 'b>,
) -> &'c mut tempfile::Builder<'a, 'b> {
    builder
}

#[cfg(test)]
mod tests {
    use super::*;
    use tempfile::TempDir;

    #[test]
    fn names_are_told_from_others() {
        let is = |name: &str| is_partial(Path::new(name));
        assert!(is("out/x.csv.radiosity-a1B2c3.partial"));
        assert!(is("a.bin.journal.radiosity-a1B2c3.partial"));
        for other in [
            "x.csv.partial",
            "x.csv.backup.partial",
            "x.csv.radiosity-a1B2c.partial",
            "x.csv.radiosity-a1B2c34.partial",
            "x.csv.radiosity-a1B2_3.partial",
            "x.csv.radiosity-a1B2c3.partial.txt",
            "radiosity-a1B2c3.partial",
        ] {
            assert!(!is(other), "{other}");
        }
    }

    #[test]
    fn what_writers_that_are_gone_have_left_is_removed() {
        let folder = TempDir::new().unwrap();
        let path = |name: &str| folder.path().join(name);
        let [left, in_use] = [
            "a.csv.radiosity-abcdef.partial",
            "b.png.radiosity-123456.partial",
        ]
        .map(path);
        let stranger = path("a.csv.partial");
        for path in [&left, &in_use, &stranger] {
            fs::write(path, b"half").unwrap();
        }
        let writer = File::open(&in_use).unwrap();
        writer.lock().unwrap();
        crate::replace_file(&path("c.csv"), &[b"whole"]).unwrap();
        assert!(!left.exists() && in_use.exists() && stranger.exists());
    }

    #[test]
    fn writers_are_seen_to_be_there() {
        let folder = TempDir::new().unwrap();
        let partial = Partial::beside(&folder.path().join("a.csv")).unwrap();
        sweep(folder.path());
        assert!(partial.path.exists() && is_partial(&partial.path));
        let path = partial.path.clone();
        drop(partial);
        assert!(!path.exists());
        assert!(!here().unfinished.contains(&path));
    }
}
