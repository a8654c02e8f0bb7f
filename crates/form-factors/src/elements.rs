//! Which part of a patch exchanges light: the finite element.

use crate::RowFacts;

/// Of patches of which less can be seen, that part is too little to be told apart: all of the patch
/// is its element.
const LEAST_VISIBLE: f64 = 0.2;

/// The share of a patch that can be seen, or 0 if it is too little to be told apart. A row that
/// sums to more than the rays have found knows better.
pub(crate) fn visible_share(row: &RowFacts) -> f64 {
    match row.visible < LEAST_VISIBLE {
        true => 0.0,
        false => row.visible.max(row.fronts).min(1.0),
    }
}

/// By patch, the area of its element: what can be seen of an area.
pub(crate) fn visible_areas(areas: &[f64], rows: &[RowFacts]) -> Vec<f64> {
    let visible = |(area, row): (&f64, &RowFacts)| match visible_share(row) {
        0.0 => *area,
        share => share * area,
    };
    areas.iter().zip(rows).map(visible).collect()
}
