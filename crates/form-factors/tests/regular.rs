//! The regular rule, eight pairs at a time in single precision, against the plain sum, on the
//! shipped scenes.

mod plain;

use plain::Plain;
use radiosity_form_factors::{Estimator, estimate};
use radiosity_geometry::subdivide;
use rayon::prelude::*;
use std::path::PathBuf;

/// Factors may differ by this; those whose segments graze an edge, which rounding decides, by more.
const ERROR: f64 = 1e-6;
const GRAZING: f64 = 1e-4;

fn check(name: &str) {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let scene = radiosity_scene::load(&root.join(name).with_extension("toml")).unwrap();
    let mesh = subdivide(&scene.geometry, scene.divisions).unwrap();
    let points = scene.form_factors.points;
    let factors = estimate(&mesh, Estimator::Regular { points }, &|_| ());
    let plain = Plain::new(&mesh, points);
    let size = mesh.patches.len();
    let errors: Vec<f64> = (0..size)
        .into_par_iter()
        .flat_map_iter(|i| {
            let error = |j| (factors.factor(i, j) - plain.factor(i, j)).abs();
            (0..i).map(error).collect::<Vec<f64>>()
        })
        .collect();
    let larger = errors.iter().filter(|&&error| error > ERROR).count();
    let worst = errors.iter().copied().fold(0.0, f64::max);
    println!(
        "{name}: {larger} of {} differ, by {worst:.1e} at most",
        errors.len()
    );
    assert!(larger as f64 <= GRAZING * errors.len() as f64);
}

#[test]
fn cornell() {
    check("cornell");
}

#[test]
fn cornell_closed() {
    check("cornell-closed");
}

#[test]
fn cornell_triangles() {
    check("cornell-triangles");
}
