//! What holds for any scene: symmetries, sums, threads.

use crate::estimated::{regular, run};
use crate::occlusion::cluttered;
use crate::plain::SINGLE;
use proptest::prelude::*;
use radiosity_form_factors::Estimator;
use radiosity_geometry::{DVec3, Patch, Shape};
use radiosity_test_kit::{cut, on_threads};

/// Only one number is stored per pair, computed from the later patch's side. With the surfaces
/// in reverse order it is computed from the other side, and must be the same.
#[test]
fn exchange_is_the_same_from_either_side() {
    let shapes = cluttered();
    let reversed: Vec<Shape> = shapes.iter().rev().cloned().collect();
    let (here, there) = (cut(shapes, 3), cut(reversed, 3));
    let (a, b) = (regular(&here, 3), regular(&there, 3));
    let find = |patch: usize| {
        let is_it = |p: &Patch| p.polygon == here.patches[patch].polygon;
        there.patches.iter().position(is_it).unwrap()
    };
    let places: Vec<usize> = (0..here.patches.len()).map(find).collect();
    for i in 0..places.len() {
        for j in 0..i {
            let (forth, back) = (a.factor(i, j), b.factor(places[i], places[j]));
            assert!(
                (forth - back).abs() <= SINGLE * forth,
                "{i} {j}: {forth} {back}"
            );
        }
    }
}

#[test]
fn row_sums_are_sums_of_rows() {
    let mesh = cut(cluttered(), 2);
    let factors = regular(&mesh, 2);
    for i in 0..mesh.patches.len() {
        let sum: f64 = (0..mesh.patches.len()).map(|j| factors.factor(i, j)).sum();
        assert!((factors.rows[i].fronts - sum).abs() < 1e-13);
    }
}

#[test]
fn thread_counts_leave_no_trace() {
    let mesh = cut(cluttered(), 5);
    let monte_carlo = Estimator::MonteCarlo {
        points: 2,
        pairs: 6,
        seed: 3,
    };
    let accurate = Estimator::Accurate { tolerance: 1e-3 };
    for estimator in [Estimator::Regular { points: 2 }, monte_carlo, accurate] {
        let with = |threads| {
            let found = on_threads(threads, || run(&mesh, estimator));
            (found.exchange.matrix().values().to_vec(), found.rows)
        };
        let one = with(1);
        assert_eq!(one, with(2));
        assert_eq!(one, with(7));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Form factors are pure numbers: turning, moving and scaling a scene changes none of them.
    /// Coordinates up to 100 keep 14 digits; segments that graze an edge could flip, and there are
    /// none in this scene.
    #[test]
    fn rigid_motions_and_scale_change_nothing(
        axis in [-1.0f64..1.0, -1.0f64..1.0, 0.1f64..1.0], angle in 0.0f64..6.3,
        shift in [-50.0f64..50.0, -50.0f64..50.0, -50.0f64..50.0], scale in 0.01f64..20.0
    ) {
        let rotation = |v: DVec3| {
            let k = DVec3::from(axis).normalize();
            let (sin, cos) = angle.sin_cos();
            cos * v + sin * k.cross(v) + (1.0 - cos) * k.dot(v) * k
        };
        let moved = |v: DVec3| scale * rotation(v) + DVec3::from(shift);
        let move_shape = |shape: &Shape| match shape {
            Shape::Parallelogram { corner, edge_a, edge_b } => Shape::Parallelogram {
                corner: moved(*corner),
                edge_a: scale * rotation(*edge_a),
                edge_b: scale * rotation(*edge_b),
            },
            Shape::Triangle(corners) => Shape::Triangle(corners.map(moved)),
            Shape::Quad(corners) => Shape::Quad(corners.map(moved)),
            Shape::Mesh(_) => unreachable!("the room has none"),
        };
        let there: Vec<Shape> = cluttered().iter().map(move_shape).collect();
        let (here, there) = (cut(cluttered(), 2), cut(there, 2));
        let (a, b) = (regular(&here, 2), regular(&there, 2));
        for (x, y) in a.exchange.matrix().values().iter().zip(b.exchange.matrix().values()) {
            let rounding = SINGLE * f64::from(x.max(*y)) + 1e-9;
            prop_assert!(f64::from((x - y).abs()) <= rounding, "{} {}", x, y);
        }
    }
}
