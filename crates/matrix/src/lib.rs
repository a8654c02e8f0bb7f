//! How patches exchange light, as solvers see it: [`Exchange`], and the packed symmetric matrix
//! behind [`DenseExchange`], owned or memory-mapped.
//!
//! The matrix holds one number per unordered pair, so whatever is stored is symmetric by
//! construction. The diagonal is zero: planar patches do not see themselves.
//!
//! This crate knows nothing of geometry, nor of files.

mod exchange;
mod sweep;

#[cfg(test)]
mod tests;

pub use exchange::{DenseExchange, Exchange, Sweep};
pub use sweep::{Triple, Update};

use rayon::prelude::*;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// A symmetric `n x n` matrix of `f32` with a zero diagonal.
///
/// Stored is the strict lower triangle by rows: row `i` is the contiguous run of its entries in
/// columns `0 .. i`. Cloning shares the numbers.
///
/// ```
/// use radiosity_matrix::SymmetricMatrix;
///
/// // Of 3 rows: the entries (1, 0), (2, 0) and (2, 1).
/// let matrix = SymmetricMatrix::new(3, vec![0.5, 0.25, 2.0])?;
/// assert_eq!(matrix.get(2, 1), 2.0);
/// assert_eq!(matrix.get(1, 2), 2.0);
/// assert_eq!(matrix.product(&[1.0, 2.0, 4.0]), [2.0, 8.5, 4.25]);
/// # Ok::<(), radiosity_matrix::LengthMismatch>(())
/// ```
#[derive(Clone)]
pub struct SymmetricMatrix {
    size: usize,
    values: Arc<dyn AsRef<[f32]> + Send + Sync>,
}

/// The number of values does not fit the size of the matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LengthMismatch {
    /// What `n (n - 1) / 2` gives.
    pub expected: usize,
    /// What was there.
    pub found: usize,
}

impl fmt::Display for LengthMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let LengthMismatch { expected, found } = self;
        write!(f, "the matrix needs {expected} values but has {found}")
    }
}

impl std::error::Error for LengthMismatch {}

impl fmt::Debug for SymmetricMatrix {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "SymmetricMatrix({0} x {0})", self.size)
    }
}

impl SymmetricMatrix {
    /// Takes the packed values of a matrix of the given size.
    pub fn new(
        size: usize,
        values: impl AsRef<[f32]> + Send + Sync + 'static,
    ) -> Result<SymmetricMatrix, LengthMismatch> {
        let (expected, found) = (packed_len(size), values.as_ref().len());
        if expected != found {
            return Err(LengthMismatch { expected, found });
        }
        Ok(SymmetricMatrix {
            size,
            values: Arc::new(values),
        })
    }

    /// The number of rows.
    pub fn size(&self) -> usize {
        self.size
    }

    /// All packed values, row after row.
    pub fn values(&self) -> &[f32] {
        (*self.values).as_ref()
    }

    /// The rows `i` with their entries in columns `0 .. i`, in order.
    pub fn rows(&self) -> impl Iterator<Item = (usize, &[f32])> {
        let values = self.values();
        (0..self.size).map(move |i| (i, &values[packed_row(i)]))
    }

    /// One entry, from either triangle.
    pub fn get(&self, i: usize, j: usize) -> f32 {
        match i.cmp(&j) {
            std::cmp::Ordering::Equal => 0.0,
            std::cmp::Ordering::Greater => self.values()[packed_row(i).start + j],
            std::cmp::Ordering::Less => self.values()[packed_row(j).start + i],
        }
    }

    /// The sum of each full row, in `f64`; the same for any number of threads.
    pub fn row_sums(&self) -> Vec<f64> {
        self.product(&vec![1.0; self.size])
    }

    /// The product with a vector, in `f64`; the same for any number of threads.
    ///
    /// # Panics
    ///
    /// If the vector has another size than the matrix.
    pub fn product(&self, vector: &[f64]) -> Vec<f64> {
        assert_eq!(vector.len(), self.size, "one number per row");
        let values = self.values();
        let bands: Vec<Vec<f64>> = bands(self.size)
            .into_par_iter()
            .map(|rows| band_product(values, vector, rows))
            .collect();
        let mut sums = vec![0.0; self.size];
        for band in bands {
            sums.iter_mut()
                .zip(band)
                .for_each(|(sum, of_band)| *sum += of_band);
        }
        sums
    }
}

impl SymmetricMatrix {
    /// The sums over blocks of entries, in `f64`: entry `a * parts + b` is that of all `(i, j)`
    /// with `i` in part `a` and `j` in part `b`. Every `part_of[i]` is below `parts`. The same for
    /// any number of threads.
    pub fn block_sums(&self, part_of: &[usize], parts: usize) -> Vec<f64> {
        let mut rows_of = vec![Vec::new(); parts];
        part_of
            .iter()
            .enumerate()
            .for_each(|(row, &part)| rows_of[part].push(row));
        let values = self.values();
        let mut sums = vec![0.0; parts * parts];
        let by_part = sums.par_chunks_mut(parts.max(1)).zip(&rows_of);
        by_part.for_each(|(sums, rows)| {
            for &row in rows {
                let entries = values[packed_row(row)].iter().zip(part_of);
                entries.for_each(|(&value, &part)| sums[part] += f64::from(value));
            }
        });
        // The other triangle is the mirror image of the stored one.
        for a in 0..parts {
            sums[a * parts + a] *= 2.0;
            for b in 0..a {
                let sum = sums[a * parts + b] + sums[b * parts + a];
                sums[a * parts + b] = sum;
                sums[b * parts + a] = sum;
            }
        }
        sums
    }
}

/// Rows that are summed together, about as many numbers in each: fixed, so that sums do not depend
/// on the number of threads.
const BANDS: usize = 16;

fn bands(size: usize) -> Vec<Range<usize>> {
    let bound = |k: usize| (size as f64 * (k as f64 / BANDS as f64).sqrt()).round() as usize;
    (0..BANDS).map(|k| bound(k)..bound(k + 1)).collect()
}

/// What some stored rows add to a product.
fn band_product(values: &[f32], vector: &[f64], rows: Range<usize>) -> Vec<f64> {
    /// Sums side by side, so that one addition need not wait for the last.
    const SUMS: usize = 8;
    let mut sums = vec![0.0; rows.end];
    for i in rows {
        let (row, last_of_row) = values[packed_row(i)].as_chunks::<SUMS>();
        let (left, last_left) = vector[..i].as_chunks::<SUMS>();
        let (below, last_below) = sums[..i].as_chunks_mut::<SUMS>();
        let factor = vector[i];
        let mut partial = [0.0; SUMS];
        for ((values, left), below) in row.iter().zip(left).zip(below) {
            for k in 0..SUMS {
                let value = f64::from(values[k]);
                partial[k] += value * left[k];
                below[k] += value * factor;
            }
        }
        let last = last_of_row.iter().zip(last_left).zip(last_below);
        for (k, ((&value, left), below)) in last.enumerate() {
            partial[k] += f64::from(value) * left;
            *below += f64::from(value) * factor;
        }
        sums[i] += partial.iter().sum::<f64>();
    }
    sums
}

/// How many values a matrix of the given size stores.
pub fn packed_len(size: usize) -> usize {
    size * size.saturating_sub(1) / 2
}

/// Where the entries of row `i` stand among the packed values.
pub fn packed_row(i: usize) -> Range<usize> {
    let start = packed_len(i);
    start..start + i
}

/// The packed values of some rows, row by row, for filling in parallel.
pub fn rows_mut(rows: Range<usize>, values: &mut [f32]) -> Vec<&mut [f32]> {
    let mut rest = values;
    rows.map(|row| {
        rest.split_off_mut(..row)
            .expect("the values of all rows are there")
    })
    .collect()
}
