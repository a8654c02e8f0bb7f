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
//! Sums are in single precision over a tile and in double precision beyond, in an order that
//! neither threads nor instruction sets have a part in.

mod band;
mod step;

#[cfg(test)]
mod tests;

use crate::{SymmetricMatrix, packed_row};
use band::{BLOCK, Band, Block, WIDTH};
use radiosity_simd::InstructionSet;
use rayon::prelude::*;
use std::ops::Range;
use step::Step;

/// Three vectors side by side at a row: the colours of a light.
pub type Triple<T> = [T; 3];

/// Is told a row, its sums, and its values, which it may change.
pub type Update<'a> = dyn FnMut(usize, &[Triple<f64>], &mut [Triple<f32>]) + Send + 'a;

/// A step over fewer numbers than this is not worth more than one thread.
const WORTH_THREADS: usize = 1 << 15;

impl SymmetricMatrix {
    /// Goes through all rows once, for vectors side by side: `x[i * triples + k]` holds the vectors
    /// `3 k .. 3 k + 3` at row `i`. In order, `update` is told of each row `i` the sums
    /// `sum_{j < i} S_ij x_j`, with the newest values, and may change `x_i`. Returns the sums
    /// `sum_{i > j} S_ij x_i` of each row `j`, with the values at the end.
    ///
    /// The same bits for any number of threads and any instruction set. Over up to 512 numbers,
    /// sums have the rounding errors of single precision.
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
        // In a thread of the pool: from outside, each step would have to call for it.
        rayon::scope(|_| self.sweep_on(InstructionSet::current(), x, triples, update))
    }

    fn sweep_on(
        &self,
        set: InstructionSet,
        x: &mut [Triple<f32>],
        triples: usize,
        update: &mut Update<'_>,
    ) -> Vec<Triple<f64>> {
        assert_eq!(x.len(), self.size() * triples, "so many triples per row");
        if x.is_empty() {
            return Vec::new();
        }
        let mut bands: Vec<Band> = (0..self.size())
            .step_by(WIDTH)
            .map(|start| Band::new(start, x, triples))
            .collect();
        let mut last: Option<Block<'_>> = None;
        for first in (0..self.size()).step_by(BLOCK) {
            let rows = first..self.size().min(first + BLOCK);
            let next = Block::new(self, &rows, triples);
            step(set, &mut bands, last.as_ref(), Some(&next));
            let mut above = vec![[0.0; 3]; BLOCK * triples];
            for band in &bands[..first.div_ceil(WIDTH)] {
                band.add_products(&mut above);
            }
            let below = self.triangle(&rows, &mut above, x, triples, update);
            let values = &x[rows.start * triples..rows.end * triples];
            bands[first / WIDTH].set(first % WIDTH, values, &below);
            last = Some(next.with_values(values));
        }
        step(set, &mut bands, last.as_ref(), None);
        let below = bands.iter().flat_map(Band::below);
        below.take(x.len()).collect()
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

/// Adds the last block to the sums above it, and takes the products of the next one.
fn step(
    set: InstructionSet,
    bands: &mut [Band],
    last: Option<&Block<'_>>,
    next: Option<&Block<'_>>,
) {
    let columns = next.or(last).map_or(0, |block| block.first);
    let on = |band: &mut Band| set.run(Step { band, last, next });
    let used = &mut bands[..columns.div_ceil(WIDTH)];
    if columns * BLOCK < WORTH_THREADS {
        used.iter_mut().for_each(on);
    } else {
        used.par_iter_mut().for_each(on);
    }
}
