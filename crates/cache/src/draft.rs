//! Artifacts that take long to make: whoever is interrupted loses only what came after the last
//! checkpoint.
//!
//! The values go to their places in what will be the artifact's file, `NAME.bin.partial`, one after
//! the other. At each checkpoint a small journal beside it, `NAME.bin.journal`, is replaced: how
//! many values are finished, their digests, and what their maker must know to go on. In the end the
//! head is written before the values, and the file gets its name. Writing values and checkpoints
//! takes about as long as making the values, so [`Draft::extend`] does that on another thread
//! meanwhile. When the file cannot be written any more, what is in it is read back, and the rest is
//! made in memory.

use crate::cache_file::partial_of;
use crate::digests::{Digest, Digests};
use crate::format;
use crate::key::Key;
use crate::last_use::note_use;
use crate::lock::is_still_at;
use crate::store::{CacheError, Id, Store};
use crate::values::{Source, Stamp, Values};
use journal::Journal;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

mod journal;
#[cfg(test)]
mod tests;
mod writing;

pub use journal::Unusable;
pub use writing::{Batch, OnFailure};

/// An artifact being made, value after value. Whoever has one has the artifact's lock.
#[derive(Debug)]
pub struct Draft {
    store: Store,
    path: PathBuf,
    stage: String,
    key: Key,
    file: File,
    /// Where in the file the values begin, in bytes.
    start: u64,
    /// How many values there will be, and how many there are.
    count: u64,
    written: u64,
    /// How many there were at the last checkpoint.
    saved: u64,
    digests: Digests,
    /// All values, once the file cannot be written any more.
    memory: Option<Vec<f32>>,
    /// The file, if its values are used in place.
    source: Option<Arc<Source>>,
}

impl Draft {
    /// Begins an artifact of `count` values. `blank` stands for the facts that will be known in
    /// the end: any that are encoded in as many bytes.
    pub fn begin(
        store: &Store,
        id: &Id<'_>,
        blank: &impl Serialize,
        count: u64,
    ) -> Result<Draft, CacheError> {
        store.make_folder()?;
        let path = store.path(id);
        store.remove_leftovers(&path);
        let start = start(id, blank, count);
        let partial = partial_of(&path);
        let file = create(&partial, start).map_err(CacheError::new("create", &partial))?;
        note_use(&path, id.scene);
        Ok(Draft::of(store, id, file, start, count))
    }

    /// Without any values.
    fn of(store: &Store, id: &Id<'_>, file: File, start: u64, count: u64) -> Draft {
        Draft {
            store: store.clone(),
            path: store.path(id),
            stage: id.stage.to_owned(),
            key: id.key,
            file,
            start,
            count,
            written: 0,
            saved: 0,
            digests: Digests::default(),
            memory: None,
            source: None,
        }
    }

    /// Removes what an interrupted writer of an artifact has left. The caller has its lock.
    pub fn discard(store: &Store, id: &Id<'_>) {
        store.remove_leftovers(&store.path(id));
    }

    /// Goes on with a draft that was interrupted, from its last checkpoint; gives the state that
    /// was saved with it. `None` if there is no draft.
    pub fn resume<S: DeserializeOwned>(
        store: &Store,
        id: &Id<'_>,
        blank: &impl Serialize,
        count: u64,
    ) -> Result<Option<(Draft, S)>, Unusable> {
        let path = store.path(id);
        let Some(journal) = Journal::read(&path)? else {
            return Ok(None);
        };
        let start = start(id, blank, count);
        journal.check(id.key, start, count)?;
        let state = format::decode(&journal.state).ok_or(Unusable::Version)?;
        let partial = partial_of(&path);
        let mut file = readable_and_writable().open(&partial)?;
        let digests = journal.digests_of(&partial, &file)?;
        file.set_len(journal.end())?;
        file.seek(SeekFrom::End(0))?;
        note_use(&path, id.scene);
        let draft = Draft {
            written: journal.written,
            saved: journal.written,
            digests,
            ..Draft::of(store, id, file, start, count)
        };
        Ok(Some((draft, state)))
    }

    /// How many values an interruption does not lose.
    pub fn saved(&self) -> u64 {
        self.saved
    }

    /// The values up to now: they stay valid when the draft is finished or dropped. Those that are
    /// held in memory are given away.
    pub fn values(&mut self) -> Result<Values, CacheError> {
        if let Some(memory) = &mut self.memory {
            return Ok(Values::in_memory(std::mem::take(memory)));
        }
        let values = self.written_values()?;
        self.source = values.source().cloned();
        Ok(values)
    }

    fn written_values(&mut self) -> Result<Values, CacheError> {
        let partial = partial_of(&self.path);
        let range = self.start..self.start + 4 * self.written;
        let values = Stamp::of(&self.file)
            .and_then(|stamp| Values::of(&partial, &self.file, range, stamp))
            .and_then(|values| self.file.seek(SeekFrom::End(0)).map(|_| values));
        values.map_err(CacheError::new("read", &partial))
    }

    /// Turns the draft into the artifact; says whether it is there, which it is not if values had
    /// to be held in memory.
    ///
    /// # Panics
    ///
    /// If values are missing, or the facts take more or less room than the blank ones.
    pub fn finish(mut self, facts: &impl Serialize) -> Result<bool, CacheError> {
        if self.memory.is_some() {
            return Ok(false);
        }
        assert_eq!(self.written, self.count, "values are missing");
        let digests = self.digests.all();
        let head = format::head(&self.stage, self.key, facts, self.count, digests);
        assert_eq!(
            head.len() as u64,
            self.start,
            "facts are not like the blank ones"
        );
        let completed = self.complete(&head);
        if let Some(source) = &self.source {
            let renewed = source.renew();
            renewed.map_err(CacheError::new("read", &self.path))?;
            self.store.in_use.add(source);
        }
        completed.map_err(CacheError::new("write", &partial_of(&self.path)))?;
        self.store.remove_leftovers(&self.path);
        Ok(true)
    }

    fn complete(&mut self, head: &[u8]) -> io::Result<()> {
        self.store.check().map_err(io::Error::other)?;
        self.file.rewind()?;
        self.file.write_all(head)?;
        self.file.sync_all()?;
        let partial = partial_of(&self.path);
        if !is_still_at(&self.file, &partial) {
            return Err(ErrorKind::NotFound.into());
        }
        fs::rename(partial, &self.path)
    }
}

/// Where values begin: behind a head that does not depend on them but for its contents.
fn start(id: &Id<'_>, blank: &impl Serialize, count: u64) -> u64 {
    let blocks = count.div_ceil(crate::digests::BLOCK_VALUES as u64);
    let digests = vec![Digest::default(); blocks as usize];
    format::head(id.stage, id.key, blank, count, digests).len() as u64
}

/// A new file with room for a head; mapping needs it readable.
fn create(path: &Path, head_len: u64) -> std::io::Result<File> {
    let mut file = readable_and_writable()
        .create(true)
        .truncate(true)
        .open(path)?;
    file.set_len(head_len)?;
    file.seek(SeekFrom::End(0))?;
    Ok(file)
}

fn readable_and_writable() -> OpenOptions {
    let mut options = OpenOptions::new();
    options.read(true).write(true);
    options
}
