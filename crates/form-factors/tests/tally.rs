//! Errors by class of pair are those of the rows, counted otherwise.

use radiosity_form_factors::{Classes, Estimator, FormFactors, estimate};
use radiosity_geometry::{Divisions, Mesh, subdivide};
use radiosity_matrix::packed_len;
use radiosity_scene::load;
use std::path::Path;

fn estimated(scene: &str, divisions: u32) -> (Mesh, FormFactors, Classes) {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let scene = load(&scenes.join(scene)).unwrap();
    let mesh = subdivide(&scene.geometry, Divisions::uniform(divisions)).unwrap();
    let made = estimate(&mesh, Estimator::Accurate { tolerance: 1e-3 }, &|_| ());
    let classes = made.classes.unwrap();
    (mesh, made, classes)
}

#[test]
fn classes_share_the_errors_of_the_rows() {
    let (mesh, made, Classes { clear, partial }) = estimated("cornell.toml", 6);
    let error = |(row, area): (&radiosity_form_factors::RowFacts, &f64)| row.error.unwrap() * area;
    let rows = made.rows.iter().zip(&made.areas).map(error);
    let mean = rows.sum::<f64>() / mesh.total_area();
    // Each addition rounds up by at most 2^-40, relative to areas above a thousandth of the mean.
    assert!((clear.error + partial.error - mean).abs() < 1e-6 * mean + 1e-8);
    assert!(partial.error > clear.error && clear.error > 0.0);
    let pairs = packed_len(mesh.patches.len()) as u64;
    assert!(partial.pairs > 0 && clear.pairs > partial.pairs && clear.pairs < pairs);
}

#[test]
fn in_an_empty_room_all_pairs_on_different_walls_are_clear() {
    let (mesh, _, Classes { clear, partial }) = estimated("furnace.toml", 3);
    let of_a_wall = |face: &radiosity_geometry::Face| packed_len(face.grid.cells()) as u64;
    let on_same: u64 = mesh.faces.iter().map(of_a_wall).sum();
    assert_eq!(partial.pairs, 0);
    assert_eq!(clear.pairs, packed_len(mesh.patches.len()) as u64 - on_same);
}
