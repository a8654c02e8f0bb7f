//! Rows of form factors in the order of their file, as many at a time as take a moment.

use crate::observer::Observer;
use radiosity_cache::Batch;
use radiosity_form_factors::{Estimation, Tally};
use radiosity_matrix::packed_len;
use std::time::{Duration, Instant};

/// How often checkpoints are made at most: an interruption loses what came since the last one, and
/// a run of rows is never cut.
const BETWEEN_CHECKPOINTS: Duration = Duration::from_millis(250);
/// How long a batch should take at most, with waiting until the one before it is written.
const OF_A_BATCH: Duration = Duration::from_millis(125);
/// How many pairs the first batch has, and any at most.
const FIRST_PAIRS: u64 = 1 << 16;
const MOST_PAIRS: u64 = 1 << 24;

/// What a checkpoint holds: how many rows are finished, and what is known of them.
pub(crate) type Finished = (u64, Tally);

/// Estimates the rows that are missing.
pub(crate) struct Batches<'a> {
    estimation: &'a Estimation<'a>,
    observer: &'a dyn Observer,
    /// Rows up to here are estimated.
    rows: usize,
    tally: Tally,
    pairs: u64,
    /// When the last batch was begun.
    begun: Option<Instant>,
    checkpoint: Instant,
}

impl<'a> Batches<'a> {
    /// After those that are finished.
    pub(crate) fn after(
        (rows, tally): Finished,
        estimation: &'a Estimation<'a>,
        observer: &'a dyn Observer,
    ) -> Batches<'a> {
        Batches {
            estimation,
            observer,
            rows: rows as usize,
            tally,
            pairs: FIRST_PAIRS,
            begun: None,
            checkpoint: Instant::now(),
        }
    }

    /// What is known of all rows that are estimated.
    pub(crate) fn into_tally(self) -> Tally {
        self.tally
    }

    /// More pairs or fewer, by how long the last batch took.
    fn adapt(&mut self) {
        if let Some(begun) = self.begun {
            self.pairs = match begun.elapsed() < OF_A_BATCH {
                true => MOST_PAIRS.min(2 * self.pairs),
                false => (self.pairs / 2).max(1),
            };
        }
        self.begun = Some(Instant::now());
    }

    /// What a checkpoint holds, if it is time for one.
    fn state(&mut self) -> Option<Finished> {
        let is_due = self.checkpoint.elapsed() > BETWEEN_CHECKPOINTS;
        is_due.then(|| {
            self.checkpoint = Instant::now();
            (self.rows as u64, self.tally.clone())
        })
    }
}

impl Iterator for Batches<'_> {
    type Item = Batch<Finished>;

    fn next(&mut self) -> Option<Batch<Finished>> {
        self.adapt();
        let rows = self.estimation.next_rows(self.rows, self.pairs)?;
        let mut values = vec![0.0; packed_len(rows.end) - packed_len(rows.start)];
        let advance = |pairs| self.observer.advance(pairs);
        self.rows = rows.end;
        self.estimation
            .fill_rows(rows, &mut values, &self.tally, &advance);
        let state = self.state();
        Some(Batch { values, state })
    }
}
