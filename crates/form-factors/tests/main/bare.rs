//! Faces without patches stand in the way, and do nothing else.

use crate::estimated::run;
use radiosity_form_factors::{Estimator, FormFactors};
use radiosity_geometry::{Divisions, MeshError, Surface, subdivide};
use radiosity_test_kit as kit;
use radiosity_test_kit::Facing::{self, Down, Up};

fn square(size: f64, height: f64, facing: Facing, divisions: Divisions) -> Surface {
    Surface {
        divisions: Some(divisions),
        ..kit::surface(kit::square([0.0; 2], size, height, facing))
    }
}

const ESTIMATORS: [Estimator; 2] = [
    Estimator::Accurate { tolerance: 1e-4 },
    Estimator::Regular { points: 3 },
];

/// Two squares that face each other, with something halfway between them.
fn estimated(between: Surface, estimator: Estimator) -> FormFactors {
    let one = Divisions::uniform(1);
    let surfaces = [
        square(1.0, 0.0, Up, one),
        square(1.0, 1.0, Down, one),
        between,
    ];
    let mesh = subdivide(&surfaces, one).unwrap();
    run(&mesh, estimator)
}

#[test]
fn they_hide_as_others_do_and_are_no_fronts() {
    for (facing, estimator) in [Up, Down]
        .into_iter()
        .flat_map(|f| ESTIMATORS.map(|e| (f, e)))
    {
        let with = |divisions| estimated(square(0.4, 0.5, facing, divisions), estimator);
        let (bare, patched) = (with(Divisions::Uncut), with(Divisions::uniform(1)));
        assert_eq!((bare.areas.len(), patched.areas.len()), (2, 3));
        // Both are rounded to 24 bits, in units of other total areas.
        assert!((bare.factor(0, 1) - patched.factor(0, 1)).abs() < 1e-7);
        assert!(bare.factor(0, 1) < 0.19, "in part hidden");
        if estimator != ESTIMATORS[0] {
            continue;
        }
        // What was a front or a back of the plate is now a back from either side.
        let plate = patched.factor(0, 2).max(patched.factor(1, 2));
        for row in &bare.rows {
            assert!((row.backs - plate).abs() < 4.0 * row.rays_error, "{row:?}");
            let sum = row.fronts + row.backs + row.background;
            assert!((sum - 1.0).abs() < 4.0 * row.rays_error, "{row:?}");
        }
    }
}

#[test]
fn among_many_walls_they_are_backs_too() {
    for facing in [Up, Down] {
        // More walls than are tried in turn, all of them out of the way.
        let one = Divisions::uniform(1);
        let mut surfaces = vec![
            square(1.0, 0.0, Up, one),
            square(9.0, 0.1, facing, Divisions::Uncut),
        ];
        surfaces.extend((0..40).map(|k| square(1.0, -2.0 - f64::from(k), Up, one)));
        let mesh = subdivide(&surfaces, one).unwrap();
        let made = run(&mesh, ESTIMATORS[0]);
        // By the factor of parallel squares, less than a thousandth passes by.
        assert!(made.rows[0].backs > 0.99, "{:?}", made.rows[0]);
    }
}

#[test]
fn what_lies_in_its_plane_is_not_in_sight() {
    for others in [0, 40] {
        let one = Divisions::uniform(1);
        let mut surfaces = vec![
            square(1.0, 0.1, Up, one),
            // Less than what counts as in the plane where coordinates reach 4.5.
            square(9.0, 0.1 + 4e-12, Down, Divisions::Uncut),
        ];
        let others = (0..others).map(|k| square(1.0, -2.0 - 0.01 * f64::from(k), Up, one));
        surfaces.extend(others);
        let mesh = subdivide(&surfaces, one).unwrap();
        let made = run(&mesh, ESTIMATORS[0]);
        assert_eq!(made.rows[0].background, 1.0, "{:?}", made.rows[0]);
    }
}

#[test]
fn a_scene_needs_a_patch() {
    let surfaces = [square(1.0, 0.0, Up, Divisions::Uncut)];
    let error = subdivide(&surfaces, Divisions::uniform(1)).unwrap_err();
    assert_eq!(error, MeshError::Empty);
}
