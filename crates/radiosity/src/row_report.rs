//! What is known of the rows of form factors, for scripts.

use crate::row_statistics::RowSummary;
use radiosity_form_factors::{Classes, ClosureFacts};
use serde::Serialize;

/// What is known of the rows.
#[derive(Debug, Serialize)]
pub struct RowReport {
    row_sum_mean: f64,
    /// The mean shares of what a patch sees that are backs, and nothing at all: by rays.
    row_backs_mean: f64,
    row_background_mean: f64,
    /// The largest |row sum - 1|, and their mean; in open scenes no error.
    row_sum_max_error: f64,
    row_sum_mean_error: f64,
    /// Of all rows, the mean estimated sum of the absolute errors of their factors, if the
    /// estimator tells.
    #[serde(skip_serializing_if = "Option::is_none")]
    row_error_mean: Option<f64>,
    /// The largest of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    row_error_max: Option<f64>,
    /// How many rows miss the tolerance since samples are used up, and by how much at worst; absent
    /// where none does.
    #[serde(skip_serializing_if = "Option::is_none")]
    rows_missed: Option<(u64, f64)>,
    /// How many rows do not add up: fronts, backs and background do not sum to 1 within the errors.
    rows_unbalanced: u64,
    /// Pairs by how much they see of each other, and what each class adds to the mean error of
    /// rows, weighted by area.
    #[serde(skip_serializing_if = "Option::is_none")]
    classes: Option<Classes>,
    /// How rows were made to sum to 1, if they were.
    #[serde(skip_serializing_if = "Option::is_none")]
    closure: Option<ClosureFacts>,
}

impl RowReport {
    /// The same, under the names of reports.
    pub fn of(rows: &RowSummary) -> RowReport {
        RowReport {
            row_sum_mean: rows.mean,
            row_backs_mean: rows.backs,
            row_background_mean: rows.background,
            row_sum_max_error: rows.max_error,
            row_sum_mean_error: rows.mean_error,
            row_error_mean: rows.estimated_error.map(|(mean, _)| mean),
            row_error_max: rows.estimated_error.map(|(_, worst)| worst),
            rows_missed: (rows.missed.0 > 0).then_some(rows.missed),
            rows_unbalanced: rows.unbalanced.iter().map(|of| of.rows).sum(),
            classes: rows.classes,
            closure: rows.closure,
        }
    }
}
