//! Rows of form factors in the order of their file, as many at a time as take a moment.
//!
//! What a row costs is not known before it is made: it may differ ten thousand times. So a batch is
//! no number of rows, but what is done until its time is over. Threads take the next rows one
//! after the other; those that are not finished then go on in the next batch, and are part of
//! checkpoints as far as they are.

use crate::observer::Observer;
use radiosity_cache::Batch;
use radiosity_form_factors::{BegunRows, Estimation, Tally};
use radiosity_matrix::packed_len;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::iter;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// What a checkpoint holds.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Finished {
    /// How many rows are finished, and in the file.
    pub(crate) rows: u64,
    /// Those after them that are begun, or finished after one that is not.
    pub(crate) begun: Vec<BegunRows>,
    /// What is known of all of these.
    pub(crate) tally: Tally,
    /// How many pairs of them are estimated.
    pub(crate) pairs: u64,
}

/// Estimates the rows that are missing.
pub(crate) struct Batches<'a> {
    estimation: &'a Estimation<'a>,
    observer: &'a dyn Observer,
    finished: Finished,
    size: BatchSize,
    /// Batches last so long, and a part of a row more.
    time: Duration,
    checkpoint: Instant,
}

/// How large the next batch becomes: an interruption loses what came since the last checkpoint.
struct BatchSize {
    /// The most pairs.
    pairs: u64,
}

impl BatchSize {
    /// Rows are estimated for so long.
    const TIME: Duration = Duration::from_millis(250);
    /// The first batches are small, so that writing them begins early.
    const FIRST_PAIRS: u64 = 1 << 16;
    const MOST_PAIRS: u64 = 1 << 24;

    fn first() -> BatchSize {
        BatchSize {
            pairs: BatchSize::FIRST_PAIRS,
        }
    }

    fn next(&self) -> BatchSize {
        BatchSize {
            pairs: BatchSize::MOST_PAIRS.min(2 * self.pairs),
        }
    }

    /// Whether no more rows are begun in a batch that has so many pairs after so long.
    fn is_reached(&self, pairs: u64, elapsed: Duration) -> bool {
        pairs > 0 && (pairs >= self.pairs || elapsed >= BatchSize::TIME)
    }
}

impl Finished {
    /// Nothing yet, of so many patches.
    pub(crate) fn nothing(patches: usize) -> Finished {
        Finished {
            rows: 0,
            begun: Vec::new(),
            tally: Tally::new(patches),
            pairs: 0,
        }
    }
}

/// All rows at once, in the memory where they stay: batches would be copied.
pub(crate) fn estimate_in_memory(
    estimation: &Estimation<'_>,
    observer: &dyn Observer,
) -> (Vec<f32>, Tally) {
    let size = estimation.areas().len();
    let tally = Tally::new(size);
    let mut values = vec![0.0; packed_len(size)];
    let mut rest = &mut values[..];
    let mut first = 0;
    let next = iter::from_fn(|| {
        let rows = estimation.next_rows(first, 0)?;
        let pairs = packed_len(rows.end) - packed_len(first);
        first = rows.end;
        Some(estimation.begin_in(rows, rest.split_off_mut(..pairs)?))
    });
    next.par_bridge()
        .for_each(|mut rows: BegunRows<&mut [f32]>| {
            while !estimation.is_finished(&rows) {
                observer.advance(estimation.go_on(&mut rows, &tally));
            }
        });
    (values, tally)
}

impl<'a> Batches<'a> {
    /// After those that are finished.
    pub(crate) fn after(
        finished: Finished,
        estimation: &'a Estimation<'a>,
        observer: &'a dyn Observer,
    ) -> Batches<'a> {
        Batches {
            estimation,
            observer,
            finished,
            size: BatchSize::first(),
            time: BatchSize::TIME,
            checkpoint: Instant::now(),
        }
    }

    /// What is known of all rows that are estimated.
    pub(crate) fn into_tally(self) -> Tally {
        self.finished.tally
    }

    /// Estimates rows until time is over, those that are begun first, and gives those that are
    /// finished.
    fn estimate(&mut self) -> Vec<Vec<f32>> {
        let Finished {
            rows,
            begun,
            tally,
            pairs: estimated,
        } = &mut self.finished;
        let more = AtomicU64::new(0);
        let (estimation, size, start) = (self.estimation, &self.size, Instant::now());
        let pairs = |rows: Range<usize>| packed_len(rows.end) - packed_len(rows.start);
        let mut waiting = std::mem::take(begun).into_iter();
        let first = *rows as usize;
        let mut last = first;
        let next = iter::from_fn(|| {
            let next = waiting.next().or_else(|| {
                let is_full = size.is_reached(pairs(first..last) as u64, start.elapsed());
                let rows = estimation.next_rows(last, 0).filter(|_| !is_full)?;
                Some(estimation.begin(rows))
            })?;
            last = next.rows.end;
            Some(next)
        });
        let go_on = |mut rows: BegunRows| {
            while !estimation.is_finished(&rows) {
                let pairs = estimation.go_on(&mut rows, tally);
                more.fetch_add(pairs, Ordering::Relaxed);
                self.observer.advance(pairs);
                if start.elapsed() >= self.time {
                    break;
                }
            }
            (estimation.is_finished(&rows), rows)
        };
        let mut made: Vec<(bool, BegunRows)> = next.par_bridge().map(go_on).collect();
        *estimated += more.into_inner();
        made.sort_unstable_by_key(|(_, of)| of.rows.start);
        let finished = made.iter().take_while(|(is_finished, _)| *is_finished);
        let rest = made.split_off(finished.count());
        *begun = rest.into_iter().map(|(_, rows)| rows).collect();
        if let Some((_, of)) = made.last() {
            *rows = of.rows.end as u64;
        }
        made.into_iter().map(|(_, of)| of.values).collect()
    }

    /// What a checkpoint holds, if it is time for one.
    fn state(&mut self) -> Option<Finished> {
        let is_due = self.checkpoint.elapsed() >= self.time;
        is_due.then(|| {
            self.checkpoint = Instant::now();
            self.finished.clone()
        })
    }
}

impl Iterator for Batches<'_> {
    type Item = Batch<Finished>;

    fn next(&mut self) -> Option<Batch<Finished>> {
        let values = self.estimate();
        if values.is_empty() && self.finished.begun.is_empty() {
            return None;
        }
        self.size = self.size.next();
        let state = self.state();
        Some(Batch { values, state })
    }
}

#[cfg(test)]
mod tests;
