//! Statistics of the rows of form factors, and whether they add up.

use radiosity_form_factors::{Classes, ClosureFacts, FormFactors, RowFacts, error_of_rays};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Statistics of the row sums, but for those of patches that are covered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RowSummary {
    /// The mean row sum, patches weighted equally.
    pub mean: f64,
    /// The mean shares of what a patch sees that are backs, and nothing at all.
    pub backs: f64,
    /// See `backs`.
    pub background: f64,
    /// The mean share of backs that are seen by what of patches is not hidden inside of something.
    pub exposed_backs: f64,
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
    /// Of how many rows the tolerance was missed, since their pairs had used up their samples, and
    /// by how much at worst.
    pub missed: (u64, f64),
    /// By surface, the rows that do not add up, the worst surface first.
    pub unbalanced: Vec<Unbalanced>,
    /// Pairs by how much they see of each other, and their parts of that error, if the
    /// estimator tells.
    pub classes: Option<Classes>,
    /// How rows were made to sum to 1, if they were.
    pub closure: Option<ClosureFacts>,
}

/// Rows of a surface of which fronts, backs and background do not sum to 1, by more than the errors
/// of all explain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unbalanced {
    /// The surface, by its number in the scene.
    pub surface: u32,
    /// How many rows.
    pub rows: u64,
    /// The sum that is farthest from 1.
    pub worst: f64,
}

/// Row sums above this are worth a warning.
const EXCESSIVE: f64 = 1.001;
/// What is off by more than so many errors is wrong. (Of some 9,000 rows of the scenes that are
/// shipped none is.)
const ERRORS: f64 = 5.0;
/// What single precision leaves of row sums.
const ROUNDING: f64 = 1e-6;

impl RowSummary {
    /// `surface_of` tells the surface of a patch, by its number in the scene.
    pub fn of(form_factors: &FormFactors, surface_of: impl Fn(usize) -> usize) -> RowSummary {
        let FormFactors {
            areas,
            rows,
            classes,
            closure,
            ..
        } = form_factors;
        RowSummary::new((areas, rows), surface_of, *classes, *closure)
    }

    pub(crate) fn new(
        (areas, rows): (&[f64], &[RowFacts]),
        surface_of: impl Fn(usize) -> usize,
        classes: Option<Classes>,
        closure: Option<ClosureFacts>,
    ) -> RowSummary {
        let patches = rows.iter().zip(areas).enumerate();
        let uncovered = patches.filter(|(_, (_, area))| **area > 0.0);
        let rows: Vec<(usize, &RowFacts)> =
            uncovered.map(|(patch, (row, _))| (patch, row)).collect();
        let count = rows.len().max(1) as f64;
        let mean = |of: &dyn Fn(&RowFacts) -> f64| {
            rows.iter().map(|(_, row)| of(row)).sum::<f64>() / count
        };
        let most =
            |of: &dyn Fn(&RowFacts) -> f64| rows.iter().map(|(_, row)| of(row)).fold(0.0, f64::max);
        let number =
            |is: &dyn Fn(&RowFacts) -> bool| rows.iter().filter(|(_, row)| is(row)).count() as u64;
        let distance = |row: &RowFacts| (row.fronts - 1.0).abs();
        let larger = |best: (f64, u64), &(patch, row): &(usize, &RowFacts)| {
            if row.fronts > best.0 {
                (row.fronts, patch as u64)
            } else {
                best
            }
        };
        let tells_errors = rows.iter().all(|(_, row)| row.error.is_some());
        let error = |row: &RowFacts| row.error.unwrap_or(0.0);
        RowSummary {
            mean: mean(&|row| row.fronts),
            backs: mean(&|row| row.backs),
            background: mean(&|row| row.background),
            exposed_backs: mean(&|row| (row.backs - (1.0 - row.visible)).max(0.0)),
            max_error: most(&distance),
            mean_error: mean(&distance),
            excessive: number(&|row| row.fronts > EXCESSIVE),
            largest: rows.iter().fold((0.0, 0), larger),
            estimated_error: tells_errors.then(|| (mean(&error), most(&error))),
            missed: (number(&|row| row.missed > 0.0), most(&|row| row.missed)),
            unbalanced: unbalanced(&rows, surface_of),
            classes,
            closure,
        }
    }
}

/// What a row sums to with all that its patch sees besides fronts.
fn balance(row: &RowFacts) -> f64 {
    row.fronts + row.backs + row.background
}

/// Whether a row does not add up. Fronts alone can be no more than all. Rays may miss a small face
/// all together; how often they do is known from what fronts are by the factors.
fn is_unbalanced(row: &RowFacts) -> bool {
    let Some(error) = row.error else {
        return false;
    };
    let errors = ERRORS * error + ROUNDING;
    let of_rays = row.rays_error.max(error_of_rays(row.fronts));
    let off = (balance(row) - 1.0).abs();
    // What is no number is wrong, too.
    !(row.fronts - 1.0 <= errors && off <= errors + ERRORS * of_rays)
}

fn unbalanced(rows: &[(usize, &RowFacts)], surface_of: impl Fn(usize) -> usize) -> Vec<Unbalanced> {
    let mut surfaces: BTreeMap<u32, Unbalanced> = BTreeMap::new();
    for &(patch, row) in rows.iter().filter(|(_, row)| is_unbalanced(row)) {
        let surface = surface_of(patch) as u32;
        let found = surfaces.entry(surface).or_insert(Unbalanced {
            surface,
            rows: 0,
            worst: balance(row),
        });
        found.rows += 1;
        if (balance(row) - 1.0).abs() > (found.worst - 1.0).abs() {
            found.worst = balance(row);
        }
    }
    let mut all: Vec<Unbalanced> = surfaces.into_values().collect();
    let distance = |of: &Unbalanced| (of.worst - 1.0).abs();
    all.sort_by(|a, b| distance(b).total_cmp(&distance(a)));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(fronts: f64, others: f64, [error, rays_error]: [f64; 2]) -> RowFacts {
        RowFacts {
            fronts,
            backs: 0.5 * others,
            background: 0.5 * others,
            rays_error,
            visible: 1.0,
            error: Some(error),
            missed: 0.0,
        }
    }

    fn summary(rows: &[RowFacts], areas: &[f64]) -> RowSummary {
        RowSummary::new((areas, rows), |patch| patch / 2, None, None)
    }

    #[test]
    fn rows_that_do_not_add_up_are_told_by_surface() {
        let rows = [
            row(0.7, 0.32, [1e-4, 0.01]),
            row(1.0 + 4e-4, 0.0, [1e-4, 0.01]),
            // More than all, whatever rays say.
            row(1.001, 0.0, [1e-4, 0.01]),
            row(22.6, 0.0, [1e-7, 0.01]),
            row(0.7, 0.1, [1e-4, 0.01]),
            row(f64::NAN, 0.0, [1e-4, 0.01]),
        ];
        let found = summary(&rows, &[1.0; 6]).unbalanced;
        let surfaces: Vec<(u32, u64)> = found.iter().map(|of| (of.surface, of.rows)).collect();
        assert_eq!(surfaces, [(1, 2), (2, 2)]);
        assert_eq!(found[0].worst, 22.6);
    }

    /// A lamp of 2 %, which 256 rays miss once in 200 rows.
    #[test]
    fn small_faces_that_rays_miss_are_no_fault() {
        let missed = row(0.021, 1.0, [1e-4, 1.0 / 256.0]);
        assert!(summary(&[missed], &[1.0]).unbalanced.is_empty());
    }

    #[test]
    fn covered_patches_and_estimators_without_errors_are_left_out() {
        let unknown = RowFacts {
            error: None,
            ..row(1.2, 0.0, [0.0, 0.01])
        };
        assert!(summary(&[unknown], &[1.0]).unbalanced.is_empty());
        let rows = [row(1.0, 0.0, [1e-4, 0.01]), row(0.0, 2.0, [0.0, 0.0])];
        let found = summary(&rows, &[2.0, 0.0]);
        assert_eq!(
            (found.mean, found.max_error, found.unbalanced.len()),
            (1.0, 0.0, 0)
        );
    }

    #[test]
    fn what_samples_leave_is_told() {
        let mut rows = [row(1.0, 0.0, [1e-4, 0.01]); 3];
        rows[1].missed = 2e-5;
        assert_eq!(summary(&rows, &[1.0; 3]).missed, (1, 2e-5));
    }
}
