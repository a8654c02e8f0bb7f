//! Gauss-Seidel, sweep by sweep, against the loop of the textbooks.

use super::*;

/// On full rows, in double precision.
fn textbook_sweep(case: &Case, light: usize, factor: f64, x: &mut [Rgb]) {
    for i in 0..x.len() {
        let incoming = irradiance(case, i, x);
        for c in 0..3 {
            let new = case.lights[light][i][c] + case.reflectance[i][c] * incoming[c];
            x[i][c] += factor * (new - x[i][c]);
        }
    }
}

/// The largest difference after some sweeps, relative to the largest radiosity.
fn distance(case: &Case, factor: f64, sweeps: u32) -> f64 {
    let params = Params {
        method: Method::GaussSeidel,
        relaxation: Relaxation::Factor(factor),
        residual: 0.0,
        max_sweeps: sweeps,
    };
    let solution = case.solve(&params);
    let mut worst: f64 = 0.0;
    for (light, found) in solution.lights.iter().enumerate() {
        let mut x = case.lights[light].clone();
        (0..sweeps).for_each(|_| textbook_sweep(case, light, factor, &mut x));
        let largest = x.as_flattened().iter().copied().fold(0.0, f64::max);
        for (found, x) in found.as_flattened().iter().zip(x.as_flattened()) {
            worst = worst.max((f64::from(*found) - x).abs() / largest);
        }
    }
    worst
}

/// Values are kept in single precision, so a sweep errs by 2^-24 of each value at most, and by as
/// much for each operation behind a sum; errors are passed on multiplied by a row sum times a
/// reflectance, at most 0.9, and by what over-relaxation adds.
const ROUNDING: f64 = 1.0 / (1 << 24) as f64;

proptest! {
    /// Over at most 11 other rows in one block, sums are in double precision.
    #[test]
    fn iterates_are_those_of_the_textbook(case in random_case(), sweeps in 1u32..6) {
        prop_assert!(distance(&case, 1.0, sweeps) <= 2.0 * ROUNDING / (1.0 - 0.9));
    }

    #[test]
    fn iterates_are_relaxed_by_the_factor(
        case in random_case(),
        sweeps in 1u32..6,
        factor in 0.5f64..1.5,
    ) {
        // Each sweep multiplies errors by |1 - factor| + 0.9 factor, less than 2.
        let growth = 2.0f64.powi(sweeps as i32);
        prop_assert!(distance(&case, factor, sweeps) <= 2.0 * ROUNDING * growth);
    }
}

/// Many blocks, three bands, and several threads where there are any.
#[test]
fn iterates_are_those_of_the_textbook_in_large_systems_too() {
    let size = 2100;
    let entry = |k: usize| {
        let random = (k as u32).wrapping_mul(2_654_435_761).rotate_left(16) as f32;
        random / u32::MAX as f32 / (size * size) as f32
    };
    let values = (0..packed_len(size)).map(entry).collect();
    let case = Case::uniform_enclosure(size, [0.0; 3], [0.9, 0.5, 0.1]);
    let mut case = case.with_values(values);
    case.lights[0][7] = [1.0, 2.0, 3.0];
    case.lights[0][1500] = [3.0, 2.0, 1.0];
    // Sums are in single precision over 64 numbers in a lane; rows sum to a half.
    assert!(distance(&case, 1.0, 4) <= 66.0 * ROUNDING / (1.0 - 0.45));
}

proptest! {
    /// The residual that falls out of a sweep is the one computed from its definition.
    #[test]
    fn residuals_are_true(case in random_case(), passes in 1u32..6) {
        for method in METHODS {
            let params = Params { residual: 0.0, max_sweeps: passes, ..with(method) };
            let solution = case.solve(&params);
            let mut direct: f64 = 0.0;
            for (found, emission) in solution.lights.iter().zip(&case.lights) {
                let x = in_double(found);
                let defect = |i: usize| -> Rgb {
                    let incoming = irradiance(&case, i, &x);
                    std::array::from_fn(|c| {
                        emission[i][c] + case.reflectance[i][c] * incoming[c] - x[i][c]
                    })
                };
                let defects: Vec<Rgb> = (0..x.len()).map(defect).collect();
                for c in (0..3).filter(|&c| emission.iter().any(|e| e[c] > 0.0)) {
                    let [defect, emission] = [&defects, emission].map(|of| channel(of, c));
                    direct = direct.max(norm(&case, &defect) / norm(&case, &emission));
                }
            }
            // Radiosities are at most ten times the emission, and rounded once more when they are
            // put back into watts.
            let rounding = 10.0 * ROUNDING * 2.0;
            prop_assert!((direct - solution.report.residual).abs() <= rounding, "{method:?}");
        }
    }
}
