//! One pass over the stored half, in which every number serves both of its rows.
//!
//! Gauss-Seidel needs row `i` whole: what stands left of the diagonal times the newest values, and
//! what stands right of it times those of the last sweep. The right part is the mirror image of the
//! column below the diagonal. So a stored row `i` serves twice when it is read: its product with
//! the values above is part of the sum of row `i` now, and it times the new value `x_i` is part of
//! the sums of all rows above in the *next* sweep.
//!
//! Rows are taken in blocks, columns in bands. A block's values are known once its products with
//! all bands are, and only then can it be added to the sums above. But that addition and the
//! products of the block after it go band by band without regard to each other: one step does both
//! on every band, on all threads, while the numbers of the first block are still in the
//! processor's cache. Only the triangle on the diagonal goes row by row.
//!
//! Sums are in single precision over a band or some blocks and in double precision beyond, in an
//! order that neither threads nor instruction sets have a part in.

mod band;
mod shared;
mod step;
mod triangle;
mod worker;
mod workers;

#[cfg(test)]
mod tests;

use crate::SymmetricMatrix;
use band::{OfRows, WIDTH, blocks_of, rows_of};
use radiosity_simd::InstructionSet;
use std::sync::OnceLock;
use triangle::{Solve, Triangle};
use worker::Worker;
use workers::Workers;

/// Three vectors side by side at a row.
pub type Triple<T> = [T; 3];

/// Is told a row, its sums, and its values, which it may change.
pub type Update<'a> = dyn FnMut(usize, &[Triple<f64>], &mut [Triple<f32>]) + 'a;

/// A thread for fewer rows than this is more trouble than help.
const WORTH_A_THREAD: usize = 1024;

impl SymmetricMatrix {
    /// Goes through all rows once, for vectors side by side: `x[i * triples + k]` holds the vectors
    /// `3 k .. 3 k + 3` at row `i`. In order, `update` is told of each row `i` the sums
    /// `sum_{j < i} S_ij x_j`, with the newest values, and may change `x_i`. Returns the sums
    /// `sum_{i > j} S_ij x_i` of each row `j`, with the values at the end.
    ///
    /// The same bits for any number of threads and any instruction set. Over up to 512 numbers,
    /// sums have the rounding errors of single precision. Bands of 512
    /// values and blocks of 16 that are all zero are passed over.
    ///
    /// `update` must not wait for other threads of the pool: they may be waiting for it.
    ///
    /// # Panics
    ///
    /// If `x` does not hold so many triples for each row.
    pub fn sweep(
        &self,
        x: &mut [Triple<f32>],
        triples: usize,
        update: &mut Update<'_>,
    ) -> Vec<Triple<f64>> {
        let set = InstructionSet::current();
        self.sweep_on(set, self.worth_threads(), x, triples, update)
    }

    fn sweep_on(
        &self,
        set: InstructionSet,
        count: usize,
        x: &mut [Triple<f32>],
        triples: usize,
        update: &mut Update<'_>,
    ) -> Vec<Triple<f64>> {
        assert_eq!(x.len(), self.size() * triples, "so many triples per row");
        if x.is_empty() {
            return Vec::new();
        }
        let workers = Workers::new(set, self, x, triples, count);
        rayon::in_place_scope(|scope| {
            let _dismissal = workers.dismissed_at_end();
            let workers = &workers;
            (1..count).for_each(|worker| scope.spawn(move |_| workers.help(worker)));
            lead(workers, x, update);
        });
        let mut below = Vec::with_capacity(x.len().next_multiple_of(WIDTH));
        workers
            .into_bands()
            .for_each(|band| band.append_below(&mut below));
        below.truncate(x.len());
        below
    }

    /// How many threads a sweep keeps busy.
    fn worth_threads(&self) -> usize {
        let threads = rayon::current_num_threads().min(processors());
        threads.min(self.size() / WORTH_A_THREAD).max(1)
    }
}

/// How many there are, which takes the system longer to tell than a small sweep takes.
fn processors() -> usize {
    static PROCESSORS: OnceLock<usize> = OnceLock::new();
    *PROCESSORS.get_or_init(|| std::thread::available_parallelism().map_or(1, usize::from))
}

/// Takes all steps, and solves each block after its own.
fn lead(workers: &Workers<'_>, x: &mut [Triple<f32>], update: &mut Update<'_>) {
    let (matrix, triples) = (workers.matrix, workers.triples);
    let mut leader = Worker::new(workers, 0);
    let mut above = vec![OfRows::default(); triples];
    let mut below = above.clone();
    let mut values = vec![OfRows::default(); triples];
    let mut triangle = Triangle::default();
    for block in 0..blocks_of(matrix) {
        workers.lead(block, &mut leader);
        above.fill(OfRows::default());
        below.fill(OfRows::default());
        workers.add_products(block, &mut above);
        let rows = rows_of(block, matrix.size());
        triangle.set(matrix, &rows);
        let x = &mut x[rows.start * triples..rows.end * triples];
        workers.set.run(Solve {
            triangle: &triangle,
            rows,
            above: &mut above,
            below: &mut below,
            x,
            update,
        });
        values.fill(OfRows::default());
        for (k, x) in x.iter().enumerate() {
            (0..3).for_each(|c| values[k % triples][c][k / triples] = x[c]);
        }
        workers.set_values(block, &values, &below);
    }
    workers.lead(blocks_of(matrix), &mut leader);
}
