//! Statistics of the rows of form factors.

use radiosity_form_factors::RowFacts;
use serde::{Deserialize, Serialize};

/// Statistics of the row sums.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RowSummary {
    /// The mean row sum, patches weighted equally.
    pub mean: f64,
    /// The largest distance of a row sum from 1. In open scenes that is no error: what is
    /// missing left the scene.
    pub max_error: f64,
    /// How many rows sum to more than 1, beyond the rounding of storage.
    pub over_one: u64,
    /// The largest row sum, and its patch.
    pub largest: (f64, u64),
}

/// Row sums above this exceed 1 by more than the `f32` of their terms explains.
const ONE_IN_STORAGE: f64 = 1.0 + 1e-6;

impl RowSummary {
    pub(crate) fn of(rows: &[RowFacts]) -> RowSummary {
        let sums = || rows.iter().map(|row| row.fronts);
        let largest = sums().enumerate().fold((0.0, 0), |best, (patch, sum)| {
            if sum > best.0 {
                (sum, patch as u64)
            } else {
                best
            }
        });
        RowSummary {
            mean: sums().sum::<f64>() / rows.len() as f64,
            max_error: sums().map(|sum| (sum - 1.0).abs()).fold(0.0, f64::max),
            over_one: sums().filter(|&sum| sum > ONE_IN_STORAGE).count() as u64,
            largest,
        }
    }
}
