//! How patches exchange light: the operator that solvers see.

use crate::{SymmetricMatrix, Triple, Update};
use std::fmt;
use std::sync::Arc;

/// Form factors `F_ij` as an operator on values of patches.
///
/// `A_i F_ij` is one symmetric number for each pair, so that reciprocity `A_i F_ij = A_j F_ji`
/// holds; and no patch sees itself. What has no area has no such numbers but 0.
pub trait Exchange: fmt::Debug + Send + Sync {
    /// By patch, the area that exchanges light, in square scene units; 0 if none does.
    fn areas(&self) -> &[f64];

    /// `sum_j F_ij x_j` of each patch `i`, for vectors side by side: `x[i * triples + k]` holds the
    /// vectors `3 k .. 3 k + 3` at patch `i`. Where `x` leaves patches, this arrives at them.
    ///
    /// The same bits for any number of threads and any instruction set.
    fn product(&self, x: &[Triple<f32>], triples: usize) -> Vec<Triple<f64>>;

    /// The passes row after row that Gauss-Seidel needs, if there are rows.
    fn rows(&self) -> Option<&dyn Sweep>;

    /// How many patches there are.
    fn size(&self) -> usize {
        self.areas().len()
    }
}

/// Passes over all rows that use values as soon as they are known.
pub trait Sweep {
    /// Goes through all rows once, for vectors side by side as in [`Exchange::product`]. In order,
    /// `update` is told of each row `i` the sums `sum_{j < i} F_ij x_j`, with the newest values,
    /// and may change `x_i`. Returns the sums `sum_{j > i} F_ij x_j` of each row `i`, with the
    /// values at the end.
    ///
    /// `update` must not wait for other threads of the pool: they may be waiting for it.
    fn sweep(
        &self,
        x: &mut [Triple<f32>],
        triples: usize,
        update: &mut Update<'_>,
    ) -> Vec<Triple<f64>>;
}

/// The exchange of all pairs, each with a number of its own.
///
/// ```
/// use radiosity_matrix::{DenseExchange, Exchange, SymmetricMatrix};
///
/// // Two patches that see nothing but each other: A_0 F_01 = 1, of a total area of 1 + 2.
/// let matrix = SymmetricMatrix::new(2, vec![1.0 / 3.0])?;
/// let exchange = DenseExchange::new(matrix, vec![1.0, 2.0]);
/// assert!((exchange.exchange_area(0, 1) - 1.0).abs() < 1e-7);
/// assert!((exchange.product(&[[0.0; 3], [1.0; 3]], 1)[0][0] - 1.0).abs() < 1e-7);
/// # Ok::<(), radiosity_matrix::LengthMismatch>(())
/// ```
#[derive(Clone, Debug)]
pub struct DenseExchange {
    /// `A_i F_ij` in units of `unit`.
    matrix: SymmetricMatrix,
    /// An area in square scene units.
    unit: f64,
    /// By patch, of what exchanges light.
    areas: Arc<[f64]>,
}

impl DenseExchange {
    /// `matrix` has `A_i F_ij` in units of the sum of all areas, of which single precision holds
    /// them whatever the unit of the scene is.
    ///
    /// # Panics
    ///
    /// If there is not one area for each row.
    pub fn new(matrix: SymmetricMatrix, areas: Vec<f64>) -> DenseExchange {
        assert_eq!(matrix.size(), areas.len(), "one area per row");
        DenseExchange {
            matrix,
            unit: areas.iter().sum(),
            areas: areas.into(),
        }
    }

    /// The same numbers `A_i F_ij`, where only parts of patches exchange light: `areas` are those
    /// of the parts.
    ///
    /// # Panics
    ///
    /// If there is not one area for each row.
    pub fn of_parts(self, areas: Vec<f64>) -> DenseExchange {
        assert_eq!(self.matrix.size(), areas.len(), "one area per row");
        DenseExchange {
            areas: areas.into(),
            ..self
        }
    }

    /// The same areas with other numbers, in the same unit.
    ///
    /// # Panics
    ///
    /// If there is not one area for each row.
    pub fn with_matrix(&self, matrix: SymmetricMatrix) -> DenseExchange {
        assert_eq!(matrix.size(), self.areas.len(), "one area per row");
        DenseExchange {
            matrix,
            ..self.clone()
        }
    }

    /// The numbers as they are stored.
    pub fn matrix(&self) -> &SymmetricMatrix {
        &self.matrix
    }

    /// `A_i F_ij`, the direct exchange area of a pair (Hottel & Sarofim, "Radiative Transfer",
    /// 1967), in square scene units; in constant time.
    pub fn exchange_area(&self, i: usize, j: usize) -> f64 {
        f64::from(self.matrix.get(i, j)) * self.unit
    }

    /// `sum_j A_i F_ij x_j` of each patch `i`, in double precision.
    ///
    /// # Panics
    ///
    /// If there is not one number for each patch.
    pub fn weighted_sums(&self, x: &[f64]) -> Vec<f64> {
        let mut sums = self.matrix.product(x);
        sums.iter_mut().for_each(|sum| *sum *= self.unit);
        sums
    }

    /// The sums of exchange areas between sets of patches: entry `a * parts + b` is that of all
    /// pairs `(i, j)` with `i` in set `a` and `j` in set `b`. Every `part_of[i]` is below `parts`.
    pub fn exchange_areas_between(&self, part_of: &[usize], parts: usize) -> Vec<f64> {
        let mut sums = self.matrix.block_sums(part_of, parts);
        sums.iter_mut().for_each(|sum| *sum *= self.unit);
        sums
    }

    /// What makes a form factor of a stored number of a row.
    fn scale(&self, i: usize) -> f64 {
        match self.areas[i] > 0.0 {
            true => self.unit / self.areas[i],
            false => 0.0,
        }
    }

    /// Sums of stored numbers as those of form factors.
    fn scaled(&self, sums: &mut [Triple<f64>], triples: usize) {
        for (i, sums) in sums.chunks_exact_mut(triples.max(1)).enumerate() {
            let scale = self.scale(i);
            let sums = sums.as_flattened_mut().iter_mut();
            sums.for_each(|sum| *sum *= scale);
        }
    }
}

impl Exchange for DenseExchange {
    fn areas(&self) -> &[f64] {
        &self.areas
    }

    fn product(&self, x: &[Triple<f32>], triples: usize) -> Vec<Triple<f64>> {
        let mut above = Vec::with_capacity(x.len());
        let below = self
            .matrix
            .sweep(&mut x.to_vec(), triples, &mut |_, sums, _| {
                above.extend_from_slice(sums);
            });
        for (sum, below) in above.iter_mut().zip(below) {
            (0..3).for_each(|c| sum[c] += below[c]);
        }
        self.scaled(&mut above, triples);
        above
    }

    fn rows(&self) -> Option<&dyn Sweep> {
        Some(self)
    }
}

impl Sweep for DenseExchange {
    fn sweep(
        &self,
        x: &mut [Triple<f32>],
        triples: usize,
        update: &mut Update<'_>,
    ) -> Vec<Triple<f64>> {
        let mut scaled = vec![[0.0; 3]; triples];
        let mut below = self.matrix.sweep(x, triples, &mut |i, sums, x| {
            let scale = self.scale(i);
            for (scaled, sum) in scaled.iter_mut().zip(sums) {
                *scaled = sum.map(|sum| scale * sum);
            }
            update(i, &scaled, x);
        });
        self.scaled(&mut below, triples);
        below
    }
}
