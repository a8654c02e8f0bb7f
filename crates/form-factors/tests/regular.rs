//! The regular rule, eight pairs at a time in single precision, against the plain sum, on the
//! shipped scenes.

mod plain;

use plain::Plain;
use radiosity_form_factors::{Estimator, estimate};
use radiosity_geometry::{DVec3, Divisions, PolygonMesh, Shape, Surface, subdivide};
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

/// Of the eight quads of a trough, the factors to a square over it; every other corner is moved up
/// by so much and the others down, so that quads are almost planar.
fn from_trough(uneven: f64) -> Vec<f64> {
    let corner = |k: u32| {
        let (x, y) = (f64::from(k / 3) * 0.25, f64::from(k % 3) * 0.5);
        let sign = if (k / 3 + k % 3).is_multiple_of(2) {
            1.0
        } else {
            -1.0
        };
        DVec3::new(x, y, 0.3 * (x - 0.5).powi(2) + uneven * sign)
    };
    let quad = |k: u32| {
        let at = 3 * (k / 2) + k % 2;
        vec![at, at + 3, at + 4, at + 1]
    };
    let trough = Shape::Mesh(PolygonMesh {
        positions: (0..15).map(corner).collect(),
        faces: (0..8).map(quad).collect(),
    });
    let square = Shape::Parallelogram {
        corner: DVec3::Z,
        edge_a: DVec3::Y,
        edge_b: DVec3::X,
    };
    let surfaces = [(square, 4), (trough, 1)].map(|(shape, divisions)| Surface {
        shape,
        divisions: Some(Divisions::uniform(divisions)),
    });
    let mesh = subdivide(&surfaces, Divisions::uniform(1)).unwrap();
    let factors = estimate(&mesh, Estimator::Regular { points: 3 }, &|_| ());
    let to_square = |i| (0..16).map(|j| factors.factor(i, j)).sum();
    (16..24).map(to_square).collect()
}

#[test]
fn almost_planar_quads_do_not_hide_themselves() {
    let even = from_trough(0.0);
    assert!(even.iter().all(|&factor| factor > 0.2));
    for uneven in [1e-9, 1e-7, 1e-6] {
        for (even, uneven) in even.iter().zip(from_trough(uneven)) {
            assert!((even - uneven).abs() < 1e-5, "{even} {uneven}");
        }
    }
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

/// Two plates that face each other, and a third one far away: by which points count as one goes by
/// patches, not by the scene.
#[test]
fn what_is_far_away_changes_nothing() {
    let plate = |x: f64, z: f64, up: bool| Surface {
        shape: Shape::Parallelogram {
            corner: DVec3::new(x, 0.0, z),
            edge_a: if up { DVec3::X } else { DVec3::Y },
            edge_b: if up { DVec3::Y } else { DVec3::X },
        },
        divisions: None,
    };
    let near = [plate(0.0, 0.0, true), plate(0.0, 1.0, false)];
    let factors = |surfaces: &[Surface]| {
        let mesh = subdivide(surfaces, Divisions::uniform(2)).unwrap();
        estimate(&mesh, Estimator::Regular { points: 3 }, &|_| ())
    };
    let alone = factors(&near);
    for away in [1e4, 2e6, 1e9] {
        let [low, high] = near.clone();
        let found = factors(&[low, high, plate(away, 2.0, false)]);
        for (i, j) in (0..4).flat_map(|i| (4..8).map(move |j| (i, j))) {
            let (found, expected) = (found.factor(i, j), alone.factor(i, j));
            assert!(
                (found / expected - 1.0).abs() < 1e-5,
                "{away} {found} {expected}"
            );
        }
    }
}
