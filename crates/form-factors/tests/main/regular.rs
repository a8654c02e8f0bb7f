//! The regular rule, eight pairs at a time in single precision, against the plain sum, on the
//! shipped scenes.

use crate::estimated::regular;
use crate::plain::Plain;
use radiosity_geometry::{DVec3, Divisions, PolygonMesh, Shape, Surface, subdivide};
use radiosity_test_kit::Facing::{Down, Up};
use radiosity_test_kit::{cut, cut_scene, shipped_scene, square};
use rayon::prelude::*;

/// Factors may differ by this; those whose segments graze an edge, which rounding decides, by more.
const ERROR: f64 = 1e-6;
const GRAZING: f64 = 1e-4;

/// One in so many rows of a shipped scene: the plain sum takes its time.
fn check(name: &str, stride: usize) {
    let scene = shipped_scene(name);
    let mesh = cut_scene(&scene, 12);
    let points = 3;
    let factors = regular(&mesh, points);
    let plain = Plain::new(&mesh, points);
    let rows: Vec<usize> = (0..mesh.patches.len()).step_by(stride).collect();
    let errors: Vec<f64> = rows
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
    let allowed = GRAZING * errors.len() as f64;
    // They crowd in some rows: of a part of all rows, chance may take four deviations more.
    let chance = 4.0 * (allowed * (1.0 - 1.0 / stride as f64)).sqrt();
    assert!(larger as f64 <= allowed + chance, "{name}: {larger}");
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
    let square = square([0.5; 2], 1.0, 1.0, Down);
    let surfaces = [(square, 4), (trough, 1)].map(|(shape, divisions)| Surface {
        shape,
        divisions: Some(Divisions::uniform(divisions)),
    });
    let mesh = subdivide(&surfaces, Divisions::uniform(1)).unwrap();
    let factors = regular(&mesh, 3);
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

const SCENES: [&str; 3] = ["cornell", "cornell-closed", "cornell-triangles"];

#[test]
fn some_rows_of_shipped_scenes_are_as_the_plain_sum_says() {
    for name in SCENES {
        check(name, 16);
    }
}

#[test]
#[ignore = "slow: a minute"]
fn all_rows_of_shipped_scenes_are_as_the_plain_sum_says() {
    for name in SCENES {
        check(name, 1);
    }
}

/// Two plates that face each other, and a third one far away: by which points count as one goes by
/// patches, not by the scene.
#[test]
fn what_is_far_away_changes_nothing() {
    let plate = |x: f64, z: f64, facing| square([x, 0.0], 1.0, z, facing);
    let near = [plate(0.0, 0.0, Up), plate(0.0, 1.0, Down)];
    let alone = regular(&cut(near.clone(), 2), 3);
    for away in [1e4, 2e6, 1e9] {
        let [low, high] = near.clone();
        let found = regular(&cut([low, high, plate(away, 2.0, Down)], 2), 3);
        for (i, j) in (0..4).flat_map(|i| (4..8).map(move |j| (i, j))) {
            let (found, expected) = (found.factor(i, j), alone.factor(i, j));
            assert!(
                (found / expected - 1.0).abs() < 1e-5,
                "{away} {found} {expected}"
            );
        }
    }
}
