//! What is said of scenes and artifacts, to people.

use radiosity::form_factors::Classes;
use radiosity::scene::Scene;
use radiosity::words::{PATCHES, ROWS, SURFACES, counted};
use radiosity::{RowSummary, Unbalanced};

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

/// Where the light of patches goes.
pub(crate) fn row_line(rows: &RowSummary) -> String {
    format!(
        "on average, {:.2} % of what leaves a patch reaches front faces by its form factors; by \
         rays, {:.2} % reaches back faces, {:.2} % leaves the scene",
        100.0 * rows.mean,
        100.0 * rows.backs,
        100.0 * rows.background
    )
}

/// How far the rows of a scene that says it is closed are from that.
pub(crate) fn closed_line(rows: &RowSummary) -> String {
    format!(
        "the scene is closed: row sums are off 1 by {:.1e} on average, {:.1e} at worst",
        rows.mean_error, rows.max_error
    )
}

/// A change of a factor, in relation to itself, that is a rounding.
const ROUNDING: f64 = 1e-12;
/// Rows that sum to 1 up to this are closed: single precision has no more digits.
const CLOSED: f64 = 1e-6;

/// How rows were made to sum to 1, if they were.
pub(crate) fn closure_line(rows: &RowSummary) -> Option<String> {
    let closure = rows.closure?;
    if closure.largest_change < ROUNDING {
        return Some(
            "note: closure changed nothing: it is for patches that see fronts alone, and there are \
             none, or their rows sum to 1 already"
                .to_owned(),
        );
    }
    if closure.residual > CLOSED {
        return Some(format!(
            "warning: rows that see fronts alone could not be scaled to sum to 1: they miss it by \
             up to {:.1e}",
            closure.residual
        ));
    }
    Some(format!(
        "rows that see fronts alone were scaled to sum to 1: no factor changed by more than {:.1e} \
         of its value",
        closure.largest_change
    ))
}

/// That nothing sees anything, but for the backs of surfaces.
pub(crate) fn blind_line(rows: &RowSummary) -> Option<String> {
    let is_blind = rows.mean == 0.0 && rows.max_error > 0.0 && rows.backs > 0.0;
    is_blind.then(|| {
        "warning: no patch sees a front, and all form factors are 0: reverse the order of the \
         corners of surfaces that should face each other"
            .to_owned()
    })
}

/// The estimated errors of rows, if the estimator tells.
pub(crate) fn error_line(rows: &RowSummary) -> Option<String> {
    let (mean, worst) = rows.estimated_error?;
    Some(format!(
        "the errors of a row sum to an estimated {mean:.1e} on average, {worst:.1e} at worst"
    ))
}

/// By how much the tolerance was missed, if samples were used up.
pub(crate) fn missed_line(rows: &RowSummary) -> Option<String> {
    let (count, worst) = rows.missed;
    (count > 0).then(|| {
        format!(
            "the tolerance is missed by up to {worst:.1e} in {}: pairs there have used up all \
             their samples, and a smaller tolerance does not help",
            counted(count as usize, ROWS)
        )
    })
}

/// So many surfaces whose rows do not add up are told.
const MOST_UNBALANCED: usize = 3;

/// The surfaces whose rows do not add up, by name.
pub(crate) fn unbalanced_lines(rows: &RowSummary, name: impl Fn(u32) -> String) -> Vec<String> {
    let line = |of: &Unbalanced| {
        let verb = if of.rows == 1 { "does" } else { "do" };
        format!(
            "warning: {} of `{}` {verb} not add up: what its patches see sums to {:.4} instead of \
             1 at worst, more than the errors explain; do not trust these form factors",
            counted(of.rows as usize, ROWS),
            name(of.surface),
            of.worst,
        )
    };
    let mut lines: Vec<String> = rows
        .unbalanced
        .iter()
        .take(MOST_UNBALANCED)
        .map(line)
        .collect();
    let more = rows.unbalanced.len().saturating_sub(MOST_UNBALANCED);
    if more > 0 {
        lines.push(format!("and the same of {}", counted(more, SURFACES)));
    }
    lines
}

/// Pairs by how much they see of each other.
pub(crate) fn class_line(Classes { clear, partial }: &Classes, patches: usize) -> String {
    let pairs = radiosity::matrix::packed_len(patches).max(1) as f64;
    let error = |error: f64| match error {
        0.0 => "0".to_owned(),
        error => format!("{error:.1e}"),
    };
    let percent = |pairs_of: u64| 100.0 * pairs_of as f64 / pairs;
    format!(
        "{:.1} % of the pairs are clear (error {}), {:.1} % partly hidden ({}), the others see \
         nothing of each other",
        percent(clear.pairs),
        error(clear.error),
        percent(partial.pairs),
        error(partial.error),
    )
}

pub(crate) fn indented(text: &str) -> String {
    labelled("", text)
}

/// Columns before the text of a line, in which its label stands.
pub(crate) const LABEL_WIDTH: usize = 14;

/// Text with a label in the first column.
pub(crate) fn labelled(label: &str, text: &str) -> String {
    format!("{label:<LABEL_WIDTH$}{text}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_do_not_add_up_are_told_by_surface() {
        let unbalanced = |surface| Unbalanced {
            surface,
            rows: u64::from(surface) + 1,
            worst: 1.25,
        };
        let rows = RowSummary {
            mean: 1.0,
            backs: 0.0,
            background: 0.0,
            exposed_backs: 0.0,
            max_error: 0.25,
            mean_error: 0.1,
            excessive: 0,
            largest: (1.25, 0),
            estimated_error: None,
            missed: (1200, 2e-3),
            unbalanced: (0..5).map(unbalanced).collect(),
            classes: None,
            closure: None,
        };
        let lines = unbalanced_lines(&rows, |surface| format!("wall {surface}"));
        let lines = lines.into_iter().chain(missed_line(&rows));
        let lines: Vec<String> = lines.collect();
        insta::assert_snapshot!(lines.join("\n"));
    }
}
