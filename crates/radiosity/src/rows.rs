//! Statistics of the rows of form factors.

use radiosity_form_factors::{Classes, ClosureFacts, FormFactors, RowFacts};
use serde::{Deserialize, Serialize};

/// Statistics of the row sums.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RowSummary {
    /// The mean row sum, patches weighted equally.
    pub mean: f64,
    /// The mean shares of what a patch sees that are backs, and nothing at all.
    pub backs: f64,
    /// See `backs`.
    pub background: f64,
    /// The largest distance of a row sum from 1. In open scenes that is no error: what is
    /// missing left the scene.
    pub max_error: f64,
    /// The mean of these distances.
    pub mean_error: f64,
    /// How many rows sum to more than 1.001.
    pub excessive: u64,
    /// The largest row sum, and its patch.
    pub largest: (f64, u64),
    /// The mean and the largest of the rows' estimated errors, if the estimator tells.
    pub estimated_error: Option<(f64, f64)>,
    /// Pairs by how much they see of each other, and their parts of that error, if the
    /// estimator tells.
    pub classes: Option<Classes>,
    /// How rows were made to sum to 1, if they were.
    pub closure: Option<ClosureFacts>,
}

/// Row sums above this are worth a warning.
const EXCESSIVE: f64 = 1.001;

impl RowSummary {
    pub(crate) fn of(form_factors: &FormFactors) -> RowSummary {
        let FormFactors {
            rows,
            classes,
            closure,
            ..
        } = form_factors;
        RowSummary::new(rows, *classes, *closure)
    }

    pub(crate) fn new(
        rows: &[RowFacts],
        classes: Option<Classes>,
        closure: Option<ClosureFacts>,
    ) -> RowSummary {
        let sums = || rows.iter().map(|row| row.fronts);
        let mean =
            |share: fn(&RowFacts) -> f64| rows.iter().map(share).sum::<f64>() / rows.len() as f64;
        let largest = sums().enumerate().fold((0.0, 0), |best, (patch, sum)| {
            if sum > best.0 {
                (sum, patch as u64)
            } else {
                best
            }
        });
        RowSummary {
            mean: mean(|row| row.fronts),
            backs: mean(|row| row.backs),
            background: mean(|row| row.background),
            max_error: sums().map(|sum| (sum - 1.0).abs()).fold(0.0, f64::max),
            mean_error: sums().map(|sum| (sum - 1.0).abs()).sum::<f64>() / rows.len() as f64,
            excessive: sums().filter(|&sum| sum > EXCESSIVE).count() as u64,
            largest,
            estimated_error: estimated_error(rows),
            classes,
            closure,
        }
    }
}

fn estimated_error(rows: &[RowFacts]) -> Option<(f64, f64)> {
    let errors: Option<Vec<f64>> = rows.iter().map(|row| row.error).collect();
    let errors = errors?;
    let sum: f64 = errors.iter().sum();
    Some((
        sum / errors.len() as f64,
        errors.into_iter().fold(0.0, f64::max),
    ))
}
