//! Atomic replacement of files.

use std::io::{self, BufWriter, Write};
use std::path::Path;

/// The ending of files that are being written, or whose writer was interrupted.
pub(crate) const PARTIAL: &str = "partial";

/// Writes a file so that its path names either the old contents or all of the new ones, at
/// every moment, after any interruption, and whoever else writes it: the parts go into a file of
/// its own beside it, `NAME.RANDOM.partial`, which is then renamed.
pub fn replace_file(path: &Path, parts: &[&[u8]]) -> io::Result<()> {
    replace_file_by(path, |file| {
        parts.iter().try_for_each(|part| file.write_all(part))
    })
}

/// [`replace_file`] with contents that are written bit by bit.
pub fn replace_file_by(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let file = with_usual_permissions(
        tempfile::Builder::new()
            .prefix(&format!("{name}."))
            .suffix(&format!(".{PARTIAL}")),
    )
    .tempfile_in(folder)?;
    let mut buffered = BufWriter::with_capacity(1 << 20, file);
    write(&mut buffered)?;
    let file = buffered
        .into_inner()
        .map_err(io::IntoInnerError::into_error)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
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
