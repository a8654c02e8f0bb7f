//! Rows estimated a few at a time are those estimated at once.

use radiosity_form_factors::{Estimation, Estimator, FormFactors, Tally};
use radiosity_geometry::Mesh;
use radiosity_matrix::{SymmetricMatrix, packed_len};
use radiosity_test_kit::{cut_scene, shipped_scene};

fn mesh() -> Mesh {
    let scene = shipped_scene("cornell");
    cut_scene(&scene, 5)
}

/// Rows a few at a time, each stopped after as many parts as its turn says.
fn in_pieces(estimation: &Estimation<'_>, size: usize, pairs: u64) -> (FormFactors, usize) {
    let mut values: Vec<f32> = Vec::new();
    let tally = Tally::new(size);
    let (mut done, mut pieces) = (0, 0);
    while let Some(rows) = estimation.next_rows(done, pairs) {
        done = rows.end;
        pieces += 1;
        let mut begun = estimation.begin(rows);
        let mut of_rows = 0;
        while !estimation.is_finished(&begun) {
            of_rows += estimation.go_on(&mut begun, &tally);
        }
        assert_eq!(of_rows as usize, begun.values.len());
        values.extend(begun.values);
    }
    assert_eq!(done, size);
    assert_eq!(values.len(), packed_len(size));
    let exchange = SymmetricMatrix::new(size, values).unwrap();
    (estimation.complete(exchange, &tally), pieces)
}

#[test]
fn pieces_make_the_whole() {
    let mesh = mesh();
    let size = mesh.patches.len();
    let (points, pairs, seed) = (2, 4, 0);
    for estimator in [
        Estimator::Regular { points },
        Estimator::MonteCarlo {
            points,
            pairs,
            seed,
        },
        Estimator::Accurate { tolerance: 0.01 },
    ] {
        let estimation = Estimation::new(&mesh, estimator);
        let whole = estimation.run();
        for (pairs, least) in [(1, 20), (9_999, 4)] {
            let (made, pieces) = in_pieces(&estimation, size, pairs);
            assert!(pieces >= least, "{pieces} pieces");
            assert!(made.exchange.matrix().values() == whole.exchange.matrix().values());
            assert_eq!(made.rows, whole.rows);
            assert_eq!(made.classes, whole.classes);
        }
    }
}

#[test]
fn rows_begin_where_others_end() {
    let mesh = mesh();
    let estimation = Estimation::new(&mesh, Estimator::Regular { points: 1 });
    assert_eq!(estimation.next_rows(3, 1), None, "within a tile");
    assert_eq!(estimation.next_rows(mesh.patches.len(), 1), None);
    let all = estimation.next_rows(0, u64::MAX);
    assert_eq!(all, Some(0..mesh.patches.len()));
}
