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
//! Sums are in single precision over a band and in double precision beyond, in an order that
//! neither threads nor instruction sets have a part in.

mod band;
mod step;
mod team;

#[cfg(test)]
mod tests;

use crate::{SymmetricMatrix, packed_row};
use band::{BLOCK, Band, Block, WIDTH};
use radiosity_simd::InstructionSet;
use std::ops::Range;
use team::Team;

/// Three vectors side by side at a row.
pub type Triple<T> = [T; 3];

/// Is told a row, its sums, and its values, which it may change.
pub type Update<'a> = dyn FnMut(usize, &[Triple<f64>], &mut [Triple<f32>]) + Send + 'a;

/// A thread for fewer rows than this is more trouble than help.
const WORTH_A_THREAD: usize = 2048;

impl SymmetricMatrix {
    /// Goes through all rows once, for vectors side by side: `x[i * triples + k]` holds the vectors
    /// `3 k .. 3 k + 3` at row `i`. In order, `update` is told of each row `i` the sums
    /// `sum_{j < i} S_ij x_j`, with the newest values, and may change `x_i`. Returns the sums
    /// `sum_{i > j} S_ij x_i` of each row `j`, with the values at the end.
    ///
    /// The same bits for any number of threads and any instruction set. Over up to 512 numbers,
    /// sums have the rounding errors of single precision.
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
        members: usize,
        x: &mut [Triple<f32>],
        triples: usize,
        update: &mut Update<'_>,
    ) -> Vec<Triple<f64>> {
        assert_eq!(x.len(), self.size() * triples, "so many triples per row");
        if x.is_empty() {
            return Vec::new();
        }
        let bands = (0..self.size()).step_by(WIDTH);
        let bands = bands.map(|start| Band::new(start, x, triples)).collect();
        let team = Team::new(set, bands, members);
        rayon::scope(|scope| {
            let _dismissal = team.dismissed_at_end();
            let team = &team;
            (1..members).for_each(|member| scope.spawn(move |_| team.help(member)));
            self.lead(team, x, triples, update);
        });
        let mut below = Vec::with_capacity(x.len().next_multiple_of(WIDTH));
        team.into_bands()
            .for_each(|band| band.append_below(&mut below));
        below.truncate(x.len());
        below
    }

    /// Takes all steps, and solves each block between two of them.
    fn lead<'a>(
        &'a self,
        team: &Team<'a>,
        x: &mut [Triple<f32>],
        triples: usize,
        update: &mut Update<'_>,
    ) {
        let mut last: Option<Block<'a>> = None;
        for first in (0..self.size()).step_by(BLOCK) {
            let rows = first..self.size().min(first + BLOCK);
            let bands = first.div_ceil(WIDTH);
            let next = team.lead(bands, last, Some(Block::new(self, &rows, triples)));
            let mut above = vec![[0.0; 3]; BLOCK * triples];
            (0..bands).for_each(|band| team.band(band).add_products(&mut above));
            let below = self.triangle(&rows, &mut above, x, triples, update);
            let values = &x[rows.start * triples..rows.end * triples];
            team.band(first / WIDTH).set(first % WIDTH, values, &below);
            last = next.map(|block| block.with_values(values));
        }
        let bands = last.as_ref().map_or(0, |last| last.first.div_ceil(WIDTH));
        team.lead(bands, last, None);
    }

    /// How many threads a sweep keeps busy.
    fn worth_threads(&self) -> usize {
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        let bands = self.size() / WORTH_A_THREAD;
        rayon::current_num_threads()
            .min(processors)
            .min(bands.max(1))
    }

    /// The part of a block that its own rows have in each other, row by row. `above` holds the sums
    /// of what stands left of it. Returns the sums below the diagonal.
    fn triangle(
        &self,
        rows: &Range<usize>,
        above: &mut [Triple<f64>],
        x: &mut [Triple<f32>],
        triples: usize,
        update: &mut Update<'_>,
    ) -> Vec<Triple<f64>> {
        let mut below = vec![[0.0; 3]; rows.len() * triples];
        for i in rows.clone() {
            let entries = &self.values()[packed_row(i)][rows.start..];
            let (known, rest) = x.split_at_mut(i * triples);
            let known = &known[rows.start * triples..];
            let (x_i, sums) = (
                &mut rest[..triples],
                &mut above[(i - rows.start) * triples..][..triples],
            );
            for (&s, x_j) in entries.iter().zip(known.chunks_exact(triples)) {
                add_scaled(sums, s, x_j);
            }
            update(i, sums, x_i);
            for (&s, below) in entries.iter().zip(below.chunks_exact_mut(triples)) {
                add_scaled(below, s, x_i);
            }
        }
        below
    }
}

/// `sums += factor * x`, number by number.
pub(crate) fn add_scaled(sums: &mut [Triple<f64>], factor: f32, x: &[Triple<f32>]) {
    for (sum, x) in sums.iter_mut().zip(x) {
        for c in 0..3 {
            sum[c] += f64::from(factor) * f64::from(x[c]);
        }
    }
}
