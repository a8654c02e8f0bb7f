//! Columns and rows of a sweep, laid out for its steps.

use super::Triple;
use crate::{SymmetricMatrix, packed_row};
use radiosity_simd::WIDE;
use std::ops::Range;

/// Columns of a band, and rows of a block, which are as many as numbers in a piece.
pub(super) const WIDTH: usize = 512;
pub(super) const BLOCK: usize = WIDE;
pub(super) const PIECES: usize = WIDTH / WIDE;

/// So many numbers of a row, from a column on that is a multiple of that.
pub(super) type Piece<T> = [T; WIDE];
/// Something of each row of a block, for three vectors.
pub(super) type OfRows<T> = Triple<[T; BLOCK]>;

/// The columns of a band: their values and what is known of them.
pub(super) struct Band {
    pub(super) triples: Vec<OfBand>,
}

/// Three vectors on a band.
pub(super) struct OfBand {
    pub(super) x: Triple<[Piece<f32>; PIECES]>,
    /// The sums below the diagonal, but for what is pending.
    pub(super) below: Triple<[Piece<f64>; PIECES]>,
    /// What the last few blocks add to them.
    pub(super) pending: Triple<[Piece<f32>; PIECES]>,
}

/// The rows of a block, left of the first of them.
#[derive(Clone, Copy)]
pub(super) struct Block<'a> {
    /// Where there are fewer rows, the last one again: the values that it is multiplied by are zero
    /// then, and its products are not looked at.
    rows: [&'a [Piece<f32>]; BLOCK],
}

/// The rows of a block in a band.
pub(super) struct BlockInBand<'a> {
    rows: &'a [&'a [Piece<f32>]; BLOCK],
    pub(super) pieces: Range<usize>,
}

/// The rows of a block.
pub(super) fn rows_of(block: usize, size: usize) -> Range<usize> {
    let first = block * BLOCK;
    first.min(size)..size.min(first + BLOCK)
}

/// Whether all values of a block are zero.
pub(super) fn is_zero(values: &[OfRows<f32>]) -> bool {
    let values = values.as_flattened().as_flattened();
    values.iter().all(|&value| value == 0.0)
}

/// How many blocks there are.
pub(super) fn blocks_of(matrix: &SymmetricMatrix) -> usize {
    matrix.size().div_ceil(BLOCK)
}

impl<'a> Block<'a> {
    /// The block with a number, if there is one.
    pub(super) fn new(matrix: &'a SymmetricMatrix, block: usize) -> Option<Block<'a>> {
        let rows = rows_of(block, matrix.size());
        let last = rows.end.checked_sub(1).filter(|_| !rows.is_empty())?;
        let values = matrix.values();
        let row = |k: usize| {
            let row = packed_row(last.min(rows.start + k));
            values[row][..rows.start].as_chunks().0
        };
        Some(Block {
            rows: std::array::from_fn(row),
        })
    }

    /// The rows in a band.
    pub(super) fn in_band(&self, band: usize) -> BlockInBand<'_> {
        let pieces = self.rows[0].len();
        let first = pieces.min(band * PIECES);
        BlockInBand {
            rows: &self.rows,
            pieces: first..pieces.min(first + PIECES),
        }
    }
}

impl<'a> BlockInBand<'a> {
    /// Some of the rows, as far as so many pieces.
    #[inline(always)]
    pub(super) fn rows<const COUNT: usize>(
        &self,
        first: usize,
        pieces: usize,
    ) -> [&'a [Piece<f32>]; COUNT] {
        let mut rows = [&[][..]; COUNT];
        for (row, whole) in rows.iter_mut().zip(&self.rows[first..first + COUNT]) {
            *row = &whole[self.pieces.clone()][..pieces];
        }
        rows
    }
}

impl Band {
    /// With its values and no sums.
    pub(super) fn new(x: &[Triple<f32>], triples: usize) -> Band {
        let blank = || OfBand {
            x: [[[0.0; WIDE]; PIECES]; 3],
            below: [[[0.0; WIDE]; PIECES]; 3],
            pending: [[[0.0; WIDE]; PIECES]; 3],
        };
        let mut band = Band {
            triples: (0..triples).map(|_| blank()).collect(),
        };
        for (k, x) in x.iter().enumerate() {
            let of_band = &mut band.triples[k % triples];
            (0..3).for_each(|c| of_band.x[c].as_flattened_mut()[k / triples] = x[c]);
        }
        band
    }

    /// The new values of a block's columns, and the first sums below them.
    pub(super) fn set(&mut self, column: usize, x: &[OfRows<f32>], below: &[OfRows<f64>]) {
        let piece = column / WIDE;
        let of_triples = x.iter().zip(below);
        for (of_band, (x, below)) in self.triples.iter_mut().zip(of_triples) {
            for c in 0..3 {
                of_band.x[c][piece] = x[c];
                of_band.below[c][piece] = below[c];
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
