//! Columns and rows of a sweep, laid out for its steps.

use super::Triple;
use crate::{SymmetricMatrix, packed_row};
use radiosity_simd::LANES;
use std::ops::Range;

/// Columns of a band, over which sums are in single precision, and rows of a block.
pub(super) const WIDTH: usize = 512;
pub(super) const BLOCK: usize = 16;
pub(super) const PIECES: usize = WIDTH / LANES;

pub(super) type Lanes<T> = [T; LANES];
/// Stretches of the rows of a block, all as long.
pub(super) type Pieces<'a> = [&'a [Lanes<f32>]; BLOCK];

/// The columns of a band: their values and what is known of them.
pub(super) struct Band {
    pub(super) start: usize,
    pub(super) triples: Vec<OfBand>,
}

/// Three vectors on a band.
pub(super) struct OfBand {
    pub(super) x: Triple<[Lanes<f32>; PIECES]>,
    /// The sums below the diagonal.
    pub(super) below: Triple<[Lanes<f64>; PIECES]>,
    /// The products of the next block's rows with this band.
    pub(super) products: Triple<[f64; BLOCK]>,
}

/// Some rows, left of their first column.
pub(super) struct Block<'a> {
    pub(super) first: usize,
    /// Where there are fewer rows, the last one again; its values are zero then.
    rows: Pieces<'a>,
    pub(super) values: Vec<Triple<[f32; BLOCK]>>,
}

impl<'a> Block<'a> {
    /// Without values.
    pub(super) fn new(
        matrix: &'a SymmetricMatrix,
        rows: &Range<usize>,
        triples: usize,
    ) -> Block<'a> {
        let first = rows.start;
        let row = |k: usize| {
            let row = packed_row((first + k).min(rows.end - 1));
            matrix.values()[row][..first].as_chunks().0
        };
        Block {
            first,
            rows: std::array::from_fn(row),
            values: vec![[[0.0; BLOCK]; 3]; triples],
        }
    }

    /// The rows in a band.
    #[inline(always)]
    pub(super) fn pieces(&self, band: &Band) -> Pieces<'a> {
        let (start, end) = (band.start / LANES, self.first / LANES);
        let mut pieces = self.rows;
        for row in &mut pieces {
            *row = &row[start.min(end)..end.min(start + PIECES)];
        }
        pieces
    }

    /// With the values of its rows.
    pub(super) fn with_values(mut self, values: &[Triple<f32>]) -> Block<'a> {
        let triples = self.values.len();
        for (row, of_row) in values.chunks_exact(triples).enumerate() {
            for (triple, of_row) in self.values.iter_mut().zip(of_row) {
                (0..3).for_each(|c| triple[c][row] = of_row[c]);
            }
        }
        self
    }
}

impl Band {
    /// The band that starts at a column, with its values and no sums.
    pub(super) fn new(start: usize, x: &[Triple<f32>], triples: usize) -> Band {
        let blank = || OfBand {
            x: [[[0.0; LANES]; PIECES]; 3],
            below: [[[0.0; LANES]; PIECES]; 3],
            products: [[0.0; BLOCK]; 3],
        };
        let mut band = Band {
            start,
            triples: (0..triples).map(|_| blank()).collect(),
        };
        let end = x.len().min((start + WIDTH) * triples);
        band.set_values(0, &x[start * triples..end]);
        band
    }

    fn set_values(&mut self, column: usize, x: &[Triple<f32>]) {
        let triples = self.triples.len();
        for (k, x) in x.iter().enumerate() {
            let of_band = &mut self.triples[k % triples];
            (0..3).for_each(|c| of_band.x[c].as_flattened_mut()[column + k / triples] = x[c]);
        }
    }

    /// The new values of some columns, and their first sums.
    pub(super) fn set(&mut self, column: usize, x: &[Triple<f32>], below: &[Triple<f64>]) {
        self.set_values(column, x);
        let triples = self.triples.len();
        for (k, below) in below.iter().enumerate() {
            let of_band = &mut self.triples[k % triples];
            (0..3)
                .for_each(|c| of_band.below[c].as_flattened_mut()[column + k / triples] = below[c]);
        }
    }

    /// Adds the products to the sums of the block's rows.
    pub(super) fn add_products(&self, sums: &mut [Triple<f64>]) {
        let triples = self.triples.len();
        for (k, of_band) in self.triples.iter().enumerate() {
            for row in 0..BLOCK {
                let sum = &mut sums[row * triples + k];
                (0..3).for_each(|c| sum[c] += of_band.products[c][row]);
            }
        }
    }

    /// Appends the sums below the diagonal, column by column.
    pub(super) fn append_below(&self, sums: &mut Vec<Triple<f64>>) {
        for column in 0..WIDTH {
            let of_column =
                |of_band: &OfBand| std::array::from_fn(|c| of_band.below[c].as_flattened()[column]);
            sums.extend(self.triples.iter().map(of_column));
        }
    }
}
