//! Errors by class of pair are those of the rows, counted otherwise.

use crate::estimated::accurate;
use radiosity_form_factors::{Classes, FormFactors};
use radiosity_geometry::Mesh;
use radiosity_matrix::packed_len;
use radiosity_test_kit::{cut_scene, shipped_scene};

fn estimated(scene: &str, divisions: u32) -> (Mesh, FormFactors, Classes) {
    let scene = shipped_scene(scene);
    let mesh = cut_scene(&scene, divisions);
    let made = accurate(&mesh, 1e-3);
    let classes = made.classes.unwrap();
    (mesh, made, classes)
}

#[test]
fn classes_share_the_errors_of_the_rows() {
    let (mesh, made, Classes { clear, partial }) = estimated("cornell", 6);
    let error = |(row, area): (&radiosity_form_factors::RowFacts, &f64)| row.error.unwrap() * area;
    let rows = made.rows.iter().zip(&made.areas).map(error);
    let mean = rows.sum::<f64>() / mesh.total_area();
    // Each addition rounds up by at most 2^-40, relative to areas above a thousandth of the mean.
    // Rows have the rounding of their values, too: 2^-24 of a sum of at most 1.
    let rounding = 1e-6 * mean + 1e-8 + 1.0 / f64::from(1 << 24);
    assert!((clear.error + partial.error - mean).abs() < rounding);
    assert!(partial.error > clear.error && clear.error > 0.0);
    let pairs = packed_len(mesh.patches.len()) as u64;
    assert!(partial.pairs > 0 && clear.pairs > partial.pairs && clear.pairs < pairs);
}

#[test]
fn in_an_empty_room_all_pairs_on_different_walls_are_clear() {
    let (mesh, _, Classes { clear, partial }) = estimated("furnace", 3);
    let of_a_wall = |face: &radiosity_geometry::Face| packed_len(face.grid.cells()) as u64;
    let on_same: u64 = mesh.faces.iter().map(of_a_wall).sum();
    assert_eq!(partial.pairs, 0);
    assert_eq!(clear.pairs, packed_len(mesh.patches.len()) as u64 - on_same);
}
