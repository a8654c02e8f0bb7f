//! Values into a draft's file, and into memory once that cannot be written any more.

use super::Draft;
use super::journal::Journal;
use crate::cache_file::{journal_of, partial_of};
use crate::digests::Digests;
use crate::format;
use crate::replace::replace_file;
use crate::store::CacheError;
use serde::Serialize;
use std::io::{self, ErrorKind, Write};
use std::panic::resume_unwind;
use std::sync::mpsc;
use std::thread;

/// The next values of a draft.
#[derive(Debug)]
pub struct Batch<S> {
    /// The values, in any pieces.
    pub values: Vec<Vec<f32>>,
    /// What [`Draft::resume`] will give, if there is to be a checkpoint behind them.
    pub state: Option<S>,
}

/// Is told, on another thread, why the rest of a draft is made in memory, and how many values are
/// kept for the next writer all the same.
pub type OnFailure<'a> = &'a (dyn Fn(&CacheError, u64) + Sync);

impl Draft {
    /// Writes batches one after the other, each while the next one is made by the calling thread.
    /// If they cannot be written any more, the rest is held in memory. If making one panics, those
    /// before it are still written.
    ///
    /// An error means that values are lost; no more are made then than the batch that was begun.
    ///
    /// # Panics
    ///
    /// If there are more values than was said.
    pub fn extend<S: Serialize + Send>(
        &mut self,
        batches: impl IntoIterator<Item = Batch<S>>,
        on_failure: OnFailure<'_>,
    ) -> Result<(), CacheError> {
        let partial = partial_of(&self.path);
        thread::scope(|scope| {
            // Without room for any: one batch is being written, and one made.
            let (sender, receiver) = mpsc::sync_channel(0);
            let write = move || {
                receiver
                    .into_iter()
                    .try_for_each(|batch| self.write(&batch, on_failure))
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

    fn write<S: Serialize>(
        &mut self,
        batch: &Batch<S>,
        on_failure: OnFailure<'_>,
    ) -> Result<(), CacheError> {
        for values in &batch.values {
            if let Err(error) = self.append(values) {
                self.leave_file(&error, on_failure)?;
                self.append(values)?;
            }
        }
        match &batch.state {
            Some(state) if self.memory.is_none() => self
                .checkpoint(state)
                .or_else(|error| self.leave_file(&error, on_failure)),
            _ => Ok(()),
        }
    }

    pub(super) fn append(&mut self, values: &[f32]) -> Result<(), CacheError> {
        let there = self
            .memory
            .as_ref()
            .map_or(self.written, |m| m.len() as u64);
        let fits = there + values.len() as u64 <= self.count;
        assert!(fits, "more values than was said");
        if let Some(memory) = &mut self.memory {
            memory.extend_from_slice(values);
            return Ok(());
        }
        let written = self.file.write_all(bytemuck::cast_slice(values));
        written.map_err(CacheError::new("write", &partial_of(&self.path)))?;
        self.written += values.len() as u64;
        self.digests.extend(values);
        Ok(())
    }

    /// Makes sure that what is written up to now is not lost.
    pub(super) fn checkpoint(&mut self, state: &impl Serialize) -> Result<(), CacheError> {
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
        replace_file(&path, &[&journal.sealed()]).map_err(CacheError::new("write", &path))?;
        self.saved = self.written;
        Ok(())
    }

    /// Reads back what is written. The next values are held in memory.
    fn leave_file(
        &mut self,
        error: &CacheError,
        on_failure: OnFailure<'_>,
    ) -> Result<(), CacheError> {
        let written = self.written_values()?;
        let mut digests = Digests::default();
        digests.extend(written.as_ref());
        if digests.all() != self.digests.all() {
            let changed = io::Error::new(ErrorKind::InvalidData, "it is damaged");
            return Err(CacheError::new("read", &partial_of(&self.path))(changed));
        }
        let mut memory = Vec::with_capacity(self.count as usize);
        memory.extend_from_slice(written.as_ref());
        self.memory = Some(memory);
        let left = [partial_of(&self.path), journal_of(&self.path)];
        let is_left = left.iter().all(|path| path.exists());
        on_failure(error, if is_left { self.saved } else { 0 });
        Ok(())
    }
}
