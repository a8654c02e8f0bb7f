//! Closed rows sum to 1, and nothing else changes much.

use crate::estimated::run;
use radiosity_form_factors::{Closure, Estimator, FormFactors};
use radiosity_matrix::SymmetricMatrix;
use radiosity_test_kit::{Facing, cut, cut_scene, shipped_scene, square};

fn estimated(scene: &str, estimator: Estimator) -> FormFactors {
    let scene = shipped_scene(scene);
    let mesh = cut_scene(&scene, 6);
    run(&mesh, estimator)
}

fn closed(raw: &FormFactors) -> FormFactors {
    let closure = Closure::of(raw);
    let mut values = raw.exchange.matrix().values().to_vec();
    // In two runs of rows, as the file is written.
    let size = raw.areas.len();
    let middle = radiosity_matrix::packed_len(size / 2);
    closure.apply(0..size / 2, &mut values[..middle]);
    closure.apply(size / 2..size, &mut values[middle..]);
    closure.complete(raw, SymmetricMatrix::new(size, values).unwrap())
}

const ESTIMATORS: [Estimator; 2] = [
    Estimator::Accurate { tolerance: 1e-2 },
    Estimator::Regular { points: 3 },
];

#[test]
fn closed_rows_sum_to_one_and_others_keep_their_sums() {
    for estimator in ESTIMATORS {
        let raw = estimated("cornell-closed", estimator);
        let made = closed(&raw);
        let facts = made.closure.unwrap();
        assert!(facts.residual < 1e-8, "{facts:?}");
        let (mut ones, mut others) = (0, 0);
        for (before, after) in raw.rows.iter().zip(&made.rows) {
            let sees_fronts_alone = before.backs == 0.0 && before.background == 0.0;
            let expected = if sees_fronts_alone {
                1.0
            } else {
                before.fronts
            };
            // The residual, and values of 24 bits.
            assert!(
                (after.fronts - expected).abs() < 2e-7 * expected.max(0.01),
                "{after:?}"
            );
            assert_eq!(before.backs, after.backs);
            // What was changed may have been right.
            let change = (after.fronts - before.fronts).abs();
            let least = before.error.map(|error| error + (1.0 - 1e-6) * change);
            assert!(after.error >= least, "{before:?} {after:?}");
            *(if sees_fronts_alone {
                &mut ones
            } else {
                &mut others
            }) += 1;
        }
        assert!(ones > 300 && others > 5, "{ones} {others}");
        let values = raw
            .exchange
            .matrix()
            .values()
            .iter()
            .zip(made.exchange.matrix().values());
        for (&before, &after) in values {
            let change = (f64::from(after) - f64::from(before)).abs();
            let most = (facts.largest_change + 1e-6) * f64::from(before);
            assert!(after >= 0.0 && change <= most, "{before} {after}");
        }
        // The better the factors, the less there is to change.
        let accurate = matches!(estimator, Estimator::Accurate { .. });
        assert_eq!(facts.largest_change < 0.01, accurate, "{facts:?}");
    }
}

#[test]
fn closing_twice_changes_nothing_more() {
    let once = closed(&estimated("cornell-closed", ESTIMATORS[0]));
    let again = Closure::of(&once);
    let twice = closed(&once);
    assert!(twice.closure.unwrap().largest_change < 1e-6, "{again:?}");
}

#[test]
fn what_is_open_stays_as_it_is() {
    // Two plates that see each other, and the sky.
    let plates = [
        square([0.0; 2], 1.0, 0.0, Facing::Up),
        square([0.0; 2], 1.0, 1.0, Facing::Down),
    ];
    let raw = run(&cut(plates, 2), ESTIMATORS[0]);
    let made = closed(&raw);
    assert_eq!(
        made.exchange.matrix().values(),
        raw.exchange.matrix().values()
    );
    assert!(made.closure.unwrap().largest_change < 1e-12);
}
