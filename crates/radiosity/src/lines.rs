//! What is said of scenes and artifacts, to people.

use crate::resources::{PATCHES, SURFACES, counted};
use crate::rows::RowSummary;
use radiosity_form_factors::Classes;
use radiosity_scene::Scene;

/// The scene, and into how many patches it is cut.
pub(crate) fn scene_line(scene: &Scene, patches: usize) -> String {
    format!(
        "{:<14}{}: {}, {}",
        "scene",
        scene.name,
        counted(scene.surfaces.len(), SURFACES),
        counted(patches, PATCHES),
    )
}

/// What rows sum to.
pub(crate) fn row_line(rows: &RowSummary) -> String {
    format!(
        "sum to {:.4} on average; backs are {:.4} of what patches see, nothing {:.4}",
        rows.mean, rows.backs, rows.background
    )
}

/// How far the rows of a scene that says it is closed are from that.
pub(crate) fn closed_line(rows: &RowSummary) -> String {
    format!(
        "the scene is closed: row sums are off 1 by {:.1e} on average, {:.1e} at worst",
        rows.mean_error, rows.max_error
    )
}

/// How rows were made to sum to 1, if they were.
pub(crate) fn closure_line(rows: &RowSummary) -> Option<String> {
    let closure = rows.closure?;
    Some(format!(
        "rows that see fronts alone were scaled to sum to 1: factors changed by {:.1e} of themselves at most",
        closure.largest_change
    ))
}

/// The estimated errors of rows, if the estimator tells.
pub(crate) fn error_line(rows: &RowSummary) -> Option<String> {
    let (mean, worst) = rows.estimated_error?;
    Some(format!(
        "the errors of a row sum to an estimated {mean:.1e} on average, {worst:.1e} at worst"
    ))
}

/// Pairs by how much they see of each other.
pub(crate) fn class_line(Classes { clear, partial }: &Classes, patches: usize) -> String {
    let pairs = radiosity_matrix::packed_len(patches).max(1) as f64;
    let error = |error: f64| match error {
        0.0 => "0".to_owned(),
        error => format!("{error:.1e}"),
    };
    let percent = |pairs_of: u64| 100.0 * pairs_of as f64 / pairs;
    format!(
        "{:.1} % of the pairs are clear (error {}), {:.1} % partly hidden ({}), the others see nothing of each other",
        percent(clear.pairs),
        error(clear.error),
        percent(partial.pairs),
        error(partial.error),
    )
}

pub(crate) fn indented(text: &str) -> String {
    labelled("", text)
}

/// Text with a label in the first column.
pub(crate) fn labelled(label: &str, text: &str) -> String {
    format!("{label:<14}{text}")
}
