//! Rows that sum to 1, for those who need an enclosure that is closed to the last digit.
//!
//! Of all symmetric matrices `S'_ij = d_i S_ij d_j` the one is taken whose rows sum as they should:
//! reciprocity is kept, and no factor becomes negative. It is found by the iteration
//! `d_i <- sqrt(d_i t_i / sum_j S_ij d_j)` (P. Knight, D. Ruiz & B. Ucar, "A Symmetry Preserving
//! Algorithm for Matrix Scaling", 2014).

use crate::{FormFactors, RowFacts, quotient};
use radiosity_matrix::{SymmetricMatrix, packed_row};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// What makes the rows of form factors sum to 1.
#[derive(Clone, Debug)]
pub struct Closure {
    /// By patch.
    scale: Vec<f64>,
    facts: ClosureFacts,
}

/// How rows were closed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ClosureFacts {
    /// No factor has changed by more, in relation to itself.
    pub largest_change: f64,
    /// The largest distance of a row sum from what it should be, in relation to that.
    pub residual: f64,
}

/// Rows are closed to this, or the iteration has gone on for so long.
const RESIDUAL: f64 = 1e-9;
const MOST_ITERATIONS: usize = 1000;

impl Closure {
    /// Rows whose patches see nothing but fronts, as far as rays tell, are to sum to 1; all others
    /// keep their sums.
    pub fn of(form_factors: &FormFactors) -> Closure {
        let target = |(row, area): (&RowFacts, &f64)| {
            let is_closed = row.backs == 0.0 && row.background == 0.0 && row.fronts > 0.0;
            area * if is_closed { 1.0 } else { row.fronts }
        };
        let rows = form_factors.rows.iter().zip(&form_factors.areas);
        let targets: Vec<f64> = rows.map(target).collect();
        let mut scale = vec![1.0; targets.len()];
        let mut residual = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let sums = form_factors.exchange.weighted_sums(&scale);
            residual = 0.0;
            for ((d, sum), target) in scale.iter_mut().zip(&sums).zip(&targets) {
                // What sees nothing cannot be scaled.
                if *sum > 0.0 && *target > 0.0 {
                    residual = f64::max(residual, (*d * sum / target - 1.0).abs());
                    *d = (*d * target / sum).sqrt();
                }
            }
            if residual <= RESIDUAL {
                break;
            }
        }
        let largest_change = largest_change(&scale);
        Closure {
            scale,
            facts: ClosureFacts {
                largest_change,
                residual,
            },
        }
    }

    /// Scales form factors, in memory.
    pub fn close(&self, form_factors: &FormFactors) -> FormFactors {
        let size = form_factors.areas.len();
        let mut values = form_factors.exchange.matrix().values().to_vec();
        self.apply(0..size, &mut values);
        let matrix = SymmetricMatrix::new(size, values).expect("they are as many as before");
        self.complete(form_factors, matrix)
    }

    /// The form factors with all values scaled: `matrix` has those of [`Closure::apply`].
    pub fn complete(&self, form_factors: &FormFactors, matrix: SymmetricMatrix) -> FormFactors {
        let areas = form_factors.areas.clone();
        let exchange = form_factors.exchange.with_matrix(matrix);
        let sums = exchange.weighted_sums(&vec![1.0; areas.len()]);
        let off: Vec<f64> = self.scale.iter().map(|d| (d - 1.0).abs()).collect();
        let off = form_factors.exchange.weighted_sums(&off);
        let row = |(i, row): (usize, &RowFacts)| {
            let fronts = quotient(sums[i], areas[i]);
            // Rays may have missed what makes the sum less than 1, so that the change is an error:
            // sum_j |d_i F_ij d_j - F_ij| <= |d_i - 1| sum_j F_ij d_j + sum_j F_ij |d_j - 1|.
            let d = self.scale[i];
            let change = (d - 1.0).abs() * fronts / d + quotient(off[i], areas[i]);
            RowFacts {
                fronts,
                error: row.error.map(|error| error + change),
                ..*row
            }
        };
        FormFactors {
            exchange,
            rows: form_factors.rows.iter().enumerate().map(row).collect(),
            areas,
            // They are those of the factors before.
            classes: None,
            closure: Some(self.facts),
        }
    }

    /// Scales the packed values of some rows.
    pub fn apply(&self, rows: Range<usize>, values: &mut [f32]) {
        let start = packed_row(rows.start).start;
        for i in rows {
            let row = packed_row(i);
            let row = &mut values[row.start - start..row.end - start];
            for (value, d) in row.iter_mut().zip(&self.scale) {
                *value = (f64::from(*value) * self.scale[i] * d) as f32;
            }
        }
    }
}

fn largest_change(scale: &[f64]) -> f64 {
    let most = scale.iter().copied().fold(1.0, f64::max);
    let least = scale.iter().copied().fold(1.0, f64::min);
    (most * most - 1.0).max(1.0 - least * least)
}
