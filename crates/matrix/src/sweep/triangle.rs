//! The part of a block that its own rows have in each other, row by row.

use super::band::{BLOCK, OfRows};
use super::{Triple, Update};
use crate::{SymmetricMatrix, packed_row};
use radiosity_simd::{Float, Kernel, LANES, Simd};
use std::ops::Range;

/// A block on the diagonal, as it is and mirrored, with zeros elsewhere.
#[derive(Default)]
pub(super) struct Triangle {
    rows: [[f64; BLOCK]; BLOCK],
    columns: [[f64; BLOCK]; BLOCK],
}

impl Triangle {
    /// Takes the place of another. Where there are fewer rows, what was there is left:
    /// it only meets sums of rows that there are not.
    pub(super) fn set(&mut self, matrix: &SymmetricMatrix, rows: &Range<usize>) {
        let values = matrix.values();
        for (k, i) in rows.clone().enumerate() {
            let entries = &values[packed_row(i)][rows.start..];
            for (j, &entry) in entries.iter().enumerate() {
                self.rows[k][j] = f64::from(entry);
                self.columns[j][k] = f64::from(entry);
            }
        }
    }
}

/// Updates the rows of a block, one after the other.
pub(super) struct Solve<'a, 'u> {
    pub(super) rows: Range<usize>,
    pub(super) triangle: &'a Triangle,
    /// The sums of what stands left of the block; those left of the diagonal at the end.
    pub(super) above: &'a mut [OfRows<f64>],
    /// The sums below the diagonal, zero at first.
    pub(super) below: &'a mut [OfRows<f64>],
    /// The values of the rows.
    pub(super) x: &'a mut [Triple<f32>],
    pub(super) update: &'a mut Update<'u>,
}

impl Kernel for Solve<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let triples = self.above.len();
        let mut sums = vec![[0.0; 3]; triples];
        for (k, i) in self.rows.enumerate() {
            for (sums, above) in sums.iter_mut().zip(&*self.above) {
                *sums = [above[0][k], above[1][k], above[2][k]];
            }
            let x = &mut self.x[k * triples..][..triples];
            (self.update)(i, &sums, x);
            let Triangle { rows, columns } = self.triangle;
            for (t, x) in x.iter().enumerate() {
                for c in 0..3 {
                    let x = simd.splat_f64(f64::from(x[c]));
                    add(simd, &mut self.above[t][c], &columns[k], x);
                    add(simd, &mut self.below[t][c], &rows[k], x);
                }
            }
        }
    }
}

/// `sums += factors * x`
#[inline(always)]
fn add<S: Simd>(simd: S, sums: &mut [f64; BLOCK], factors: &[f64; BLOCK], x: S::F64) {
    let sums = sums.as_chunks_mut::<LANES>().0;
    for (sums, factors) in sums.iter_mut().zip(factors.as_chunks().0) {
        *sums = (simd.f64(sums) + simd.f64(factors) * x).lanes();
    }
}
