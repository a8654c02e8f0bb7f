//! The accurate estimator against the exact factors of a closed box of 313 rectangles with a cuboid
//! in it: see `tests/data/README.md`.

use crate::estimated::accurate;
use radiosity_form_factors::FormFactors;
use radiosity_geometry::Shape;
use radiosity_test_kit::box313::{self, ELEMENTS};
use radiosity_test_kit::mesh_of;

/// Row by row: factors, row sums, and the estimated errors of rows.
struct Found {
    factors: Vec<f64>,
    sums: Vec<f64>,
    errors: Vec<f64>,
}

/// Factors between elements that are made of `parts` patches each: areas of parts are equal, so a
/// factor is the mean over the parts of one of the sums over the parts of the other.
fn aggregated(found: &FormFactors, elements: usize, parts: usize) -> Found {
    let mean = |i: usize, of: &dyn Fn(usize) -> f64| {
        (parts * i..parts * (i + 1)).map(of).sum::<f64>() / parts as f64
    };
    let factor = |i: usize, j: usize| {
        let columns = parts * j..parts * (j + 1);
        mean(i, &|a| columns.clone().map(|b| found.factor(a, b)).sum())
    };
    let pairs = (0..elements).flat_map(|i| (0..elements).map(move |j| (i, j)));
    Found {
        factors: pairs.map(|(i, j)| factor(i, j)).collect(),
        sums: (0..elements)
            .map(|i| mean(i, &|a| found.rows[a].fronts))
            .collect(),
        errors: (0..elements)
            .map(|i| mean(i, &|a| found.rows[a].error.unwrap()))
            .collect(),
    }
}

/// Of a row of the reference: 3e-7 rms over all entries, nearly all of it in the tenth that is
/// partly hidden, 31 in a row.
const REFERENCE_ERROR: f64 = 2e-5;

/// How good the factors of the box are.
#[derive(Debug)]
struct Quality {
    rms: f64,
    mean_row_sum_error: f64,
    /// The share of rows whose summed errors are below twice their estimate.
    within: f64,
    /// The median of what rows are off over what they say.
    median_ratio: f64,
}

impl Quality {
    fn of(found: &Found, exact: &[f32]) -> Quality {
        let errors = found.factors.iter().zip(exact);
        let errors: Vec<f64> = errors
            .map(|(f, &exact)| (f - f64::from(exact)).abs())
            .collect();
        let of_rows = errors.chunks(ELEMENTS).map(|row| row.iter().sum::<f64>());
        let of_rows: Vec<(f64, f64)> = of_rows.zip(found.errors.iter().copied()).collect();
        let holds = |&&(error, estimate): &&(f64, f64)| error < 2.0 * estimate + REFERENCE_ERROR;
        let within = of_rows.iter().filter(holds).count() as f64;
        let mut ratios: Vec<f64> = of_rows
            .iter()
            .map(|(error, estimate)| error / estimate)
            .collect();
        ratios.sort_by(f64::total_cmp);
        let rows = ELEMENTS as f64;
        Quality {
            rms: errors.iter().map(|e| e * e).sum::<f64>().sqrt() / rows,
            mean_row_sum_error: found.sums.iter().map(|s| (s - 1.0).abs()).sum::<f64>() / rows,
            within: within / rows,
            median_ratio: ratios[ELEMENTS / 2],
        }
    }
}

/// The reference is exact to 3e-7. The limits are those of the best tool known: 3.7e-6 and 6e-5.
#[test]
fn a_box_with_a_cuboid() {
    let (mesh, exact) = (mesh_of(box313::shapes()), box313::exact_factors());
    for (tolerance, rms, row_sums) in [(5e-4, 3e-6, 4e-5), (3e-5, 1e-6, 1.5e-5)] {
        let found = aggregated(&accurate(&mesh, tolerance), ELEMENTS, 1);
        let quality = Quality::of(&found, &exact);
        println!("{tolerance:.0e}: {quality:?}");
        assert!(quality.rms < rms);
        assert!(quality.mean_row_sum_error < row_sums);
        assert!(quality.within > 0.95 && quality.median_ratio > 0.2);
        assert!(found.factors.iter().all(|f| (0.0..=1.0).contains(f)));
    }
}

/// The same box of triangles: errors of parts average out in their sums, and so they stay within
/// what the parts say.
#[test]
fn a_box_of_triangles() {
    let halves = box313::shapes().into_iter().flat_map(|shape| {
        let Shape::Quad([a, b, c, d]) = shape else {
            panic!("all are quads")
        };
        [Shape::Triangle([a, b, c]), Shape::Triangle([a, c, d])]
    });
    let found = accurate(&mesh_of(halves), 5e-4);
    let quality = Quality::of(&aggregated(&found, ELEMENTS, 2), &box313::exact_factors());
    println!("{quality:?}");
    assert!(quality.rms < 3e-6);
    assert!(quality.mean_row_sum_error < 4e-5);
    assert!(quality.within > 0.95 && quality.median_ratio > 0.2);
}
