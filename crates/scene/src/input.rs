//! The one place that opens the files that a scene is made of.

use std::fs::{File, metadata};
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;

/// Where the meshes of a scene may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFiles {
    /// In the scene's folder and those in it, symbolic links followed: a scene of a stranger reads
    /// nothing else.
    InFolder,
    /// Wherever the scene says.
    Anywhere,
    /// These alone: their paths, relative to the scene's folder, and their bytes. No file is
    /// opened.
    InMemory(&'static [(&'static str, &'static [u8])]),
}

/// The most bytes of a file that are read: ten times what the most patches take as a mesh.
const MOST_BYTES: u64 = 1 << 30;

/// Reads a regular file. Pipes and devices are not opened: that could wait for ever, and they may
/// have no end.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>> {
    let metadata = metadata(path)?;
    if metadata.is_dir() {
        return Err(Error::other("it is a folder"));
    }
    if !metadata.is_file() {
        return Err(Error::other("it is a pipe or a device, not a file"));
    }
    read_at_most(MOST_BYTES, File::open(path)?, metadata.len())
}

/// Reads what ends within so many bytes.
fn read_at_most(most: u64, file: impl Read, expected: u64) -> Result<Vec<u8>> {
    let too_large = || {
        Error::other(format!(
            "it has more than {most} bytes, the most that is read"
        ))
    };
    if expected > most {
        return Err(too_large());
    }
    let mut bytes = Vec::with_capacity(expected as usize);
    file.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(too_large());
    }
    Ok(bytes)
}

impl MeshFiles {
    /// The bytes of the file that a scene in a folder calls so.
    pub(crate) fn read(self, folder: &Path, file: &str) -> Result<Vec<u8>> {
        let MeshFiles::InMemory(files) = self else {
            return read(&folder.join(file));
        };
        let found = files.iter().find(|(name, _)| *name == file);
        let (_, bytes) = found.ok_or(ErrorKind::NotFound)?;
        Ok(bytes.to_vec())
    }

    /// Whether a file is where meshes may be. One that does not exist is: reading it says so.
    pub(crate) fn include(self, path: &Path, folder: &Path) -> bool {
        if let MeshFiles::InMemory(_) = self {
            return true;
        }
        let folder = match folder.as_os_str().is_empty() {
            true => Path::new("."),
            false => folder,
        };
        let Ok(path) = path.canonicalize() else {
            return true;
        };
        let is_inside = folder
            .canonicalize()
            .is_ok_and(|folder| path.starts_with(folder));
        is_inside || self == MeshFiles::Anywhere
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endless_files_are_refused() {
        assert_eq!(read_at_most(8, &b"12345678"[..], 8).unwrap(), b"12345678");
        // It has grown since it was looked at, or has no end.
        let error = read_at_most(8, std::io::repeat(1), 0).unwrap_err();
        assert!(error.to_string().contains("more than 8 bytes"), "{error}");
        assert!(read_at_most(8, &b"1"[..], 9).is_err());
    }
}
