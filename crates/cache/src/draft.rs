//! Artifacts that take long to make: whoever is interrupted loses only what came after the last
//! checkpoint.
//!
//! The values go to their places in what will be the artifact's file, `NAME.bin.partial`, one after
//! the other. At each checkpoint a small journal beside it, `NAME.bin.journal`, is replaced: how
//! many values are finished, their digests, and what their maker must know to go on. In the end the
//! head is written before the values, and the file gets its name. Writing values and checkpoints
//! takes about as long as making the values, so [`Draft::extend`] does that on another thread
//! meanwhile.

use crate::cache_file::{journal_of, partial_of};
use crate::digests::{Digest, Digests};
use crate::format;
use crate::key::Key;
use crate::mapping::{self, MappedValues};
use crate::replace::replace_file;
use crate::store::{CacheError, Id, Store};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::fs::{self, File, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::thread;

#[cfg(test)]
mod tests;

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
}

/// The next values of a draft.
#[derive(Debug)]
pub struct Batch<S> {
    /// The values, in any pieces.
    pub values: Vec<Vec<f32>>,
    /// What [`Draft::resume`] will give, if there is to be a checkpoint behind them.
    pub state: Option<S>,
}

/// What is known of a draft at a checkpoint.
#[derive(Serialize, Deserialize)]
struct Journal {
    key: [u8; 32],
    start: u64,
    count: u64,
    written: u64,
    digests: Vec<Digest>,
    state: Vec<u8>,
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
        Ok(Draft {
            store: store.clone(),
            path,
            stage: id.stage.to_owned(),
            key: id.key,
            file,
            start,
            count,
            written: 0,
            saved: 0,
            digests: Digests::default(),
        })
    }

    /// Removes what an interrupted writer of an artifact has left. The caller has its lock.
    pub fn discard(store: &Store, id: &Id<'_>) {
        store.remove_leftovers(&store.path(id));
    }

    /// Goes on with a draft that was interrupted, from its last checkpoint, if there is one and no
    /// byte of it is damaged; gives the state that was saved with it.
    pub fn resume<S: DeserializeOwned>(
        store: &Store,
        id: &Id<'_>,
        blank: &impl Serialize,
        count: u64,
    ) -> Option<(Draft, S)> {
        let path = store.path(id);
        let sealed = fs::read(journal_of(&path)).ok()?;
        let journal: Journal = format::decode(format::unsealed(&sealed)?)?;
        let fits = journal.key == id.key.bytes()
            && journal.start == start(id, blank, count)
            && journal.count == count
            && journal.written <= count;
        let state = format::decode(&journal.state).filter(|_| fits)?;
        let partial = partial_of(&path);
        let mut file = readable_and_writable().open(partial).ok()?;
        let end = journal.start + 4 * journal.written;
        if file.metadata().ok()?.len() < end {
            return None;
        }
        file.set_len(end).ok()?;
        let values = mapped(&file, journal.start, journal.written).ok()?;
        let digests = Digests::of(values.as_ref());
        if digests.all() != journal.digests {
            return None;
        }
        file.seek(SeekFrom::Start(end)).ok()?;
        let draft = Draft {
            store: store.clone(),
            path,
            stage: id.stage.to_owned(),
            key: id.key,
            file,
            start: journal.start,
            count,
            written: journal.written,
            saved: journal.written,
            digests,
        };
        Some((draft, state))
    }

    /// How many values an interruption does not lose.
    pub fn saved(&self) -> u64 {
        self.saved
    }

    /// Writes batches one after the other, each while the next one is made by the calling thread.
    /// After an error no more are made than the one that was begun. If making one panics, those
    /// before it are still written.
    ///
    /// # Panics
    ///
    /// If there are more values than was said.
    pub fn extend<S: Serialize + Send>(
        &mut self,
        batches: impl IntoIterator<Item = Batch<S>>,
    ) -> Result<(), CacheError> {
        let partial = partial_of(&self.path);
        thread::scope(|scope| {
            // Without room for any: one batch is being written, and one made.
            let (sender, receiver) = mpsc::sync_channel(0);
            let write = move || {
                receiver
                    .into_iter()
                    .try_for_each(|batch| self.write(&batch))
            };
            let writer = thread::Builder::new()
                .spawn_scoped(scope, write)
                .map_err(CacheError::new("start writing", &partial))?;
            for batch in batches {
                let writer_has_failed = sender.send(batch).is_err();
                if writer_has_failed {
                    break;
                }
            }
            drop(sender);
            writer.join().unwrap_or_else(|panic| resume_unwind(panic))
        })
    }

    fn write<S: Serialize>(&mut self, batch: &Batch<S>) -> Result<(), CacheError> {
        for values in &batch.values {
            self.append(values)?;
        }
        match &batch.state {
            Some(state) => self.checkpoint(state),
            None => Ok(()),
        }
    }

    fn append(&mut self, values: &[f32]) -> Result<(), CacheError> {
        self.written += values.len() as u64;
        assert!(self.written <= self.count, "more values than was said");
        let written = self.file.write_all(bytemuck::cast_slice(values));
        written.map_err(CacheError::new("write", &partial_of(&self.path)))?;
        self.digests.extend(values);
        Ok(())
    }

    /// Makes sure that what is written up to now is not lost.
    fn checkpoint(&mut self, state: &impl Serialize) -> Result<(), CacheError> {
        let synced = self.file.sync_data();
        synced.map_err(CacheError::new("write", &partial_of(&self.path)))?;
        let journal = Journal {
            key: self.key.bytes(),
            start: self.start,
            count: self.count,
            written: self.written,
            digests: self.digests.all(),
            state: format::encode(state),
        };
        let path = journal_of(&self.path);
        let sealed = format::sealed(&format::encode(&journal));
        replace_file(&path, &[&sealed]).map_err(CacheError::new("write", &path))?;
        self.saved = self.written;
        Ok(())
    }

    /// The values up to now, in place: they stay valid when the draft is finished or dropped.
    pub fn values(&self) -> Result<MappedValues, CacheError> {
        mapped(&self.file, self.start, self.written)
            .map_err(CacheError::new("map", &partial_of(&self.path)))
    }

    /// Turns the draft into the artifact.
    ///
    /// # Panics
    ///
    /// If values are missing, or the facts take more or less room than the blank ones.
    pub fn finish(mut self, facts: &impl Serialize) -> Result<(), CacheError> {
        assert_eq!(self.written, self.count, "values are missing");
        let digests = self.digests.all();
        let head = format::head(&self.stage, self.key, facts, self.count, digests);
        assert_eq!(
            head.len() as u64,
            self.start,
            "facts are not like the blank ones"
        );
        let partial = partial_of(&self.path);
        let mut complete = || {
            self.file.rewind()?;
            self.file.write_all(&head)?;
            self.file.sync_all()?;
            fs::rename(&partial, &self.path)
        };
        complete().map_err(CacheError::new("write", &partial))?;
        self.store.remove_leftovers(&self.path);
        Ok(())
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

fn mapped(file: &File, start: u64, count: u64) -> std::io::Result<MappedValues> {
    let (start, bytes) = (start as usize, 4 * count as usize);
    Ok(MappedValues::new(mapping::map(file)?, start..start + bytes))
}
