//! Rows of form factors in the order of their file, as many at a time as take a moment.
//!
//! What a row costs is not known before it is made: it may differ ten thousand times. So a batch is
//! no number of rows, but what is begun until its time is over. Threads take the next rows one
//! after the other, and those that are begun are finished.

use crate::observer::Observer;
use radiosity_cache::Batch;
use radiosity_form_factors::{Estimation, Tally};
use radiosity_matrix::packed_len;
use rayon::prelude::*;
use std::iter;
use std::ops::Range;
use std::time::{Duration, Instant};

/// What a checkpoint holds: how many rows are finished, and what is known of them.
pub(crate) type Finished = (u64, Tally);

/// Estimates the rows that are missing.
pub(crate) struct Batches<'a> {
    estimation: &'a Estimation<'a>,
    observer: &'a dyn Observer,
    /// Rows up to here are estimated.
    rows: usize,
    tally: Tally,
    size: BatchSize,
    checkpoint: Instant,
}

/// How large the next batch becomes: an interruption loses what came since the last checkpoint.
struct BatchSize {
    /// The most pairs.
    pairs: u64,
}

impl BatchSize {
    /// Rows are begun for so long.
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

impl<'a> Batches<'a> {
    /// How often checkpoints are made at most.
    const BETWEEN_CHECKPOINTS: Duration = Duration::from_millis(250);

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
            size: BatchSize::first(),
            checkpoint: Instant::now(),
        }
    }

    /// What is known of all rows that are estimated.
    pub(crate) fn into_tally(self) -> Tally {
        self.tally
    }

    /// Estimates the next rows, in the fewest that can be estimated by themselves at a time.
    fn estimate(&mut self) -> Vec<Vec<f32>> {
        let Batches {
            estimation,
            observer,
            tally,
            size,
            ..
        } = self;
        let (first, begun) = (self.rows, Instant::now());
        let pairs = |rows: Range<usize>| packed_len(rows.end) - packed_len(rows.start);
        let next = iter::from_fn(|| {
            let is_full = size.is_reached(pairs(first..self.rows) as u64, begun.elapsed());
            let rows = estimation.next_rows(self.rows, 0).filter(|_| !is_full)?;
            self.rows = rows.end;
            Some(rows)
        });
        let estimate = |rows: Range<usize>| {
            let mut values = vec![0.0; pairs(rows.clone())];
            let advance = |pairs| observer.advance(pairs);
            estimation.fill_rows(rows.clone(), &mut values, tally, &advance);
            (rows.start, values)
        };
        let mut made: Vec<(usize, Vec<f32>)> = next.par_bridge().map(estimate).collect();
        made.sort_unstable_by_key(|(start, _)| *start);
        made.into_iter().map(|(_, values)| values).collect()
    }

    /// What a checkpoint holds, if it is time for one.
    fn state(&mut self) -> Option<Finished> {
        let is_due = self.checkpoint.elapsed() >= Batches::BETWEEN_CHECKPOINTS;
        is_due.then(|| {
            self.checkpoint = Instant::now();
            (self.rows as u64, self.tally.clone())
        })
    }
}

impl Iterator for Batches<'_> {
    type Item = Batch<Finished>;

    fn next(&mut self) -> Option<Batch<Finished>> {
        let values = self.estimate();
        if values.is_empty() {
            return None;
        }
        self.size = self.size.next();
        let state = self.state();
        Some(Batch { values, state })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::observer::Silent;
    use radiosity_form_factors::Estimator;
    use radiosity_geometry::{Divisions, Mesh, subdivide};
    use std::path::Path;

    const MS: Duration = Duration::from_millis(1);

    /// The pairs and the time of each batch on one thread, where rows have so many pairs and take so
    /// long.
    fn batches(rows: &[(u64, Duration)]) -> Vec<(u64, Duration)> {
        let mut rows = rows.iter().peekable();
        let mut size = BatchSize::first();
        let mut batches = Vec::new();
        while rows.peek().is_some() {
            let (mut pairs, mut time) = (0, Duration::ZERO);
            while let Some((more, longer)) = rows.next_if(|_| !size.is_reached(pairs, time)) {
                (pairs, time) = (pairs + more, time + *longer);
            }
            batches.push((pairs, time));
            size = size.next();
        }
        batches
    }

    fn longest(batches: &[(u64, Duration)]) -> Duration {
        batches.iter().map(|(_, time)| *time).max().unwrap()
    }

    #[test]
    fn rows_slower_than_a_batch_are_batches_by_themselves() {
        let slow = [(1000, 2000 * MS); 20];
        assert_eq!(batches(&slow), slow);
    }

    #[test]
    fn no_batch_is_longer_than_its_time_and_a_row() {
        let (fast, slow) = ((10_000, MS / 100), (10_000, 40 * MS));
        let suddenly = [vec![fast; 50_000], vec![slow; 100], vec![fast; 5000]].concat();
        assert!(longest(&batches(&suddenly)) < BatchSize::TIME + 40 * MS);
    }

    #[test]
    fn fast_rows_are_many_to_a_batch() {
        let batches = batches(&vec![(10_000, MS / 1000); 20_000]);
        let total: u64 = batches.iter().map(|(pairs, _)| pairs).sum();
        let fewest = total / BatchSize::MOST_PAIRS;
        assert!(batches[0].0 < 2 * BatchSize::FIRST_PAIRS);
        assert!((batches.len() as u64) < fewest + 10, "{}", batches.len());
    }

    fn mesh() -> Mesh {
        let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        let scene = radiosity_scene::load(&scenes.join("cornell.toml")).unwrap();
        subdivide(&scene.geometry, Divisions::uniform(6)).unwrap()
    }

    #[test]
    fn batches_are_what_is_estimated_at_once() {
        let mesh = mesh();
        let estimation = Estimation::new(&mesh, Estimator::Accurate { tolerance: 0.01 });
        let whole = estimation.run(&|_| ());
        for threads in [1, 2, 7] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let nothing = (0, Tally::new(mesh.patches.len()));
            let mut batches = Batches::after(nothing, &estimation, &Silent);
            // Several batches, and a checkpoint behind each.
            batches.size.pairs = 1;
            let made: Vec<Batch<Finished>> =
                pool.build().unwrap().install(|| batches.by_ref().collect());
            assert!(made.len() > 5);
            let values: Vec<f32> = made.into_iter().flat_map(|b| b.values.concat()).collect();
            assert!(values == whole.exchange.values(), "{threads} threads");
            let exchange = radiosity_matrix::SymmetricMatrix::new(mesh.patches.len(), values);
            let completed = estimation.complete(exchange.unwrap(), &batches.into_tally());
            assert_eq!(completed.rows, whole.rows);
        }
    }
}
