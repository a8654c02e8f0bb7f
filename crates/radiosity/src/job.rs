//! Stage 2 on a real machine: form factors are kept as they are made.

use crate::artifact::{Sources, usable};
use crate::error::Error;
use crate::facts::FactorFacts;
use crate::observer::{Observer, Stage};
use crate::prediction::prediction;
use crate::resources::Needs;
use radiosity_cache::{CacheError, Draft, Id, Store};
use radiosity_form_factors::{Estimation, Estimator, FormFactors, Tally};
use radiosity_geometry::Mesh;
use radiosity_matrix::{SymmetricMatrix, packed_len};
use std::io::ErrorKind;
use std::ops::Range;
use std::time::{Duration, Instant};

/// What is to be estimated.
pub(crate) struct Job<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) estimator: Estimator,
    pub(crate) observer: &'a dyn Observer,
}

/// How often checkpoints are made at most: an interruption loses what came since the last one, and
/// a run of rows is never cut.
const BETWEEN_CHECKPOINTS: Duration = Duration::from_millis(250);
/// How many pairs are estimated before the clock is looked at: in the beginning, and at most.
const FIRST_PAIRS: u64 = 1 << 16;
const MOST_PAIRS: u64 = 1 << 24;

/// Rows that are written up to here.
struct Progress {
    draft: Draft,
    tally: Tally,
    rows: usize,
    /// How many pairs the last checkpoint has.
    saved: u64,
}

impl Job<'_> {
    /// In memory.
    pub(crate) fn run(&self) -> Result<FormFactors, Error> {
        self.needs().check_memory()?;
        Ok(self.run_in_memory(&Estimation::new(self.mesh, self.estimator)))
    }

    fn run_in_memory(&self, estimation: &Estimation<'_>) -> FormFactors {
        self.begin(&self.needs(), 0, estimation);
        let made = estimation.run(&|pairs| self.observer.advance(pairs));
        self.observer.end();
        made
    }

    /// In a draft of the artifact's file, which an interrupted run may have begun. The caller has
    /// the artifact's lock.
    pub(crate) fn run_journaled(
        &self,
        store: &Store,
        id: &Id<'_>,
        sources: Sources,
    ) -> Result<(FormFactors, bool), Error> {
        let needs = self.needs();
        needs.check_memory()?;
        let estimation = Estimation::new(self.mesh, self.estimator);
        let blank = FactorFacts::blank(self.mesh, self.estimator, estimation.tells_errors());
        let resumed = match sources {
            Sources::Cached => self.resume(store, id, &blank, &estimation),
            Sources::Computed => None,
        };
        let begun = match resumed {
            Some(progress) => {
                needs.check_disk(store, 4 * progress.saved)?;
                Some(progress)
            }
            None => self.begin_draft(store, id, &blank)?.map(|draft| Progress {
                draft,
                tally: Tally::new(self.mesh.patches.len()),
                rows: 0,
                saved: 0,
            }),
        };
        let Some(mut progress) = begun else {
            return Ok((self.run_in_memory(&estimation), false));
        };
        self.begin(&needs, progress.saved, &estimation);
        let written = progress.write(&estimation, self.observer);
        self.observer.end();
        let saved = progress.saved;
        written
            .and_then(|()| self.finish(progress, &estimation))
            .map(|made| (made, true))
            .map_err(|error| interrupted(&error, saved as f64 / needs.pairs as f64, sources))
    }

    /// A new draft, if the cache can be used and the disk has room, without what an interrupted
    /// writer has left.
    pub(crate) fn begin_draft(
        &self,
        store: &Store,
        id: &Id<'_>,
        blank: &FactorFacts,
    ) -> Result<Option<Draft>, Error> {
        let needs = self.needs();
        // It would only take the room that is needed now.
        Draft::discard(store, id);
        needs.check_disk(store, 0)?;
        let draft = Draft::begin(store, id, blank, needs.pairs);
        Ok(usable(draft, self.observer, id))
    }

    pub(crate) fn needs(&self) -> Needs {
        Needs::of(self.mesh.patches.len(), self.estimator)
    }

    /// Says what lies ahead.
    fn begin(&self, needs: &Needs, done: u64, estimation: &Estimation<'_>) {
        let left = needs.pairs - done;
        if done > 0 {
            let percent = 100.0 * done as f64 / needs.pairs as f64;
            self.observer.note(&format!(
                "an interrupted run has left {percent:.0} % of the form factors: only the others are computed"
            ));
        }
        if let Some(prediction) = prediction(needs, left, estimation, self.estimator) {
            self.observer.note(&prediction);
        }
        self.observer.begin(Stage::FormFactors, needs.pairs);
        self.observer.advance(done);
    }

    /// What an interrupted run has left, if it can be used.
    fn resume(
        &self,
        store: &Store,
        id: &Id<'_>,
        blank: &FactorFacts,
        estimation: &Estimation<'_>,
    ) -> Option<Progress> {
        let size = self.mesh.patches.len();
        let count = packed_len(size) as u64;
        let (draft, (rows, tally)) = Draft::resume::<(u64, Tally)>(store, id, blank, count)?;
        let rows = rows as usize;
        let is_whole = rows == size || estimation.next_rows(rows, 0).is_some();
        let fits = draft.written() == packed_len(rows) as u64;
        (fits && is_whole).then_some(Progress {
            saved: draft.written(),
            draft,
            tally,
            rows,
        })
    }

    /// All rows are written: maps them, and adds what they make together.
    fn finish(
        &self,
        progress: Progress,
        estimation: &Estimation<'_>,
    ) -> Result<FormFactors, CacheError> {
        let Progress {
            draft, tally, rows, ..
        } = progress;
        let exchange = SymmetricMatrix::new(rows, draft.values()?).expect("all rows are written");
        let made = estimation.complete(exchange, &tally);
        draft.finish(&FactorFacts::new(self.mesh, self.estimator, &made))?;
        Ok(made)
    }
}

impl Progress {
    /// Estimates and writes all rows that are missing.
    fn write(
        &mut self,
        estimation: &Estimation<'_>,
        observer: &dyn Observer,
    ) -> Result<(), CacheError> {
        let mut pairs = FIRST_PAIRS;
        let mut values = Vec::new();
        let mut saved = Instant::now();
        while let Some(rows) = estimation.next_rows(self.rows, pairs) {
            let start = Instant::now();
            self.write_rows(rows, &mut values, estimation, observer)?;
            if saved.elapsed() > BETWEEN_CHECKPOINTS {
                self.checkpoint()?;
                saved = Instant::now();
            }
            if start.elapsed() < BETWEEN_CHECKPOINTS / 2 {
                pairs = MOST_PAIRS.min(2 * pairs);
            } else {
                pairs = (pairs / 2).max(1);
            }
        }
        Ok(())
    }

    fn write_rows(
        &mut self,
        rows: Range<usize>,
        values: &mut Vec<f32>,
        estimation: &Estimation<'_>,
        observer: &dyn Observer,
    ) -> Result<(), CacheError> {
        values.clear();
        values.resize(packed_len(rows.end) - packed_len(rows.start), 0.0);
        let advance = |pairs| observer.advance(pairs);
        estimation.fill_rows(rows.clone(), values, &self.tally, &advance);
        self.draft.append(values)?;
        self.rows = rows.end;
        Ok(())
    }

    fn checkpoint(&mut self) -> Result<(), CacheError> {
        self.draft.checkpoint(&(self.rows as u64, &self.tally))?;
        self.saved = self.draft.written();
        Ok(())
    }
}

/// Nothing that was saved is lost, unless everything is to be computed anew.
fn interrupted(error: &CacheError, saved: f64, sources: Sources) -> Error {
    let goes_on = saved > 0.0 && sources == Sources::Cached;
    let from = if goes_on {
        format!(", which goes on at {:.0} %", 100.0 * saved)
    } else {
        String::new()
    };
    let mend = match error.error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            "make room there"
        }
        _ => "see to that",
    };
    Error::Resources {
        problem: error.to_string(),
        remedy: format!(
            "{mend} and run the same command again{from}; or use another folder with --cache, or \
             --no-cache"
        ),
    }
}
