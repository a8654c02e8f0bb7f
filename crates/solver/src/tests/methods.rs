//! What holds for every method.

use super::*;

#[test]
fn furnace_has_its_closed_form() {
    // In a closed enclosure of equal patches, B = E / (1 - rho). The residual bounds the error
    // by residual / (1 - rho); f32 storage of the row sums adds 1e-7 / (1 - rho).
    let case = Case::uniform_enclosure(50, [1.0, 2.0, 0.5], [0.5, 0.8, 0.0]);
    let expected = [2.0, 10.0, 0.5];
    for method in METHODS {
        for b in &case.solve(&with(method)).lights[0] {
            for c in 0..3 {
                let error = (f64::from(b[c]) / expected[c] - 1.0).abs();
                assert!(error < 1.1e-6 / (1.0 - 0.8), "{method:?}: {error}");
            }
        }
    }
}

#[test]
fn black_surfaces_keep_their_emission() {
    let case = Case::uniform_enclosure(5, [0.25, 1.0, 3.0], [0.0; 3]);
    for method in METHODS {
        let solution = case.solve(&with(method));
        assert_eq!(solution.lights, [vec![[0.25, 1.0, 3.0]; 5]]);
        assert!(solution.report.converged && solution.report.residuals.len() == 1);
    }
}

#[test]
fn darkness_needs_no_pass() {
    for method in METHODS {
        let solution = Case::uniform_enclosure(5, [0.0; 3], [0.5; 3]).solve(&with(method));
        assert_eq!(solution.lights, [vec![[0.0; 3]; 5]]);
        assert!(solution.report.converged && solution.report.residuals.is_empty());
    }
}

#[test]
fn running_out_of_passes_is_reported() {
    let mut case = Case::uniform_enclosure(5, [1.0; 3], [0.99; 3]);
    case.lights[0][0] = [0.0; 3];
    for method in METHODS {
        let params = Params {
            max_sweeps: 1,
            ..with(method)
        };
        let report = case.solve(&params).report;
        assert!(!report.converged && report.residual > 1e-6);
        assert_eq!(report.residuals.len(), 1);
    }
}

/// Single precision has no better solution than some 1e-7: passes beyond it are not taken, and
/// what is said of the error stays true there.
#[test]
fn passes_end_where_single_precision_does() {
    for rho in [0.3, 0.9] {
        let mut case = Case::uniform_enclosure(40, [1.0, 0.3, 0.7], [rho; 3]);
        case.lights[0][3] = [0.0; 3];
        let truth = exact(&case);
        for method in METHODS {
            let passes = case.solve(&with(method)).report.residuals.len();
            let params = Params {
                residual: 1e-12,
                ..with(method)
            };
            let solution = case.solve(&params);
            let report = &solution.report;
            assert!(!report.converged && report.stalled, "{method:?}");
            // Radiosities are so many times the emission, and rounded with their sums.
            assert!(report.residual < 2e-7 / (1.0 - rho), "{method:?}");
            assert!(report.residuals.len() <= 2 * passes + 10, "{method:?}");
            let error = distance(&case, &in_double(&solution.lights[0]), &truth);
            let estimate = report.error.unwrap();
            println!("{rho} {method:?}: {error:.1e}, estimated {estimate:.1e}");
            // Emission too is rounded to single precision.
            assert!(error <= 2.0 * estimate + 1e-7, "{method:?}");
        }
    }
}

proptest! {
    /// All methods find the same, within what their residuals allow: rows times reflectance sum to
    /// less than 0.9 / 2.
    #[test]
    fn methods_agree(case in random_case()) {
        let expected = case.solve(&with(GAUSS_SEIDEL));
        for method in METHODS {
            let found = case.solve(&with(method));
            prop_assert!(found.report.converged && found.report.residual <= 1e-6);
            for (found, (expected, emission)) in
                found.lights.iter().zip(expected.lights.iter().zip(&case.lights))
            {
                let (found, expected) = (in_double(found), in_double(expected));
                let differences = found.iter().zip(&expected);
                let difference: Vec<Rgb> = differences
                    .map(|(a, b)| std::array::from_fn(|c| a[c] - b[c]))
                    .collect();
                let bound = 2.0 * 1.2e-6 / (1.0 - 0.45) * norm(&case, emission);
                // In the norm in which rho F contracts, weights are A / rho instead of A.
                prop_assert!(norm(&case, &difference) <= 4.0 * bound);
            }
        }
    }

    /// Emitted = absorbed + escaped, up to the residual, where what escapes is what rows miss to 1.
    /// The residual's norm is over all channels, and bounds the sum of each (Cauchy & Schwarz).
    #[test]
    fn power_balances(case in random_case()) {
        let areas = case.exchange.areas();
        let sums = case.exchange.weighted_sums(&vec![1.0; areas.len()]);
        for method in METHODS {
            let solution = case.solve(&with(method));
            let total: f64 = areas.iter().sum();
            let lights = solution.report.powers.iter().zip(&solution.lights).zip(&case.lights);
            for ((power, radiosity), emission) in lights {
                let bound = 1.2e-6 * norm(&case, emission) * total.sqrt();
                for (c, (emitted, absorbed)) in
                    power.emitted.iter().zip(&power.absorbed).enumerate()
                {
                    let rows = areas.iter().zip(&sums).zip(radiosity);
                    let escaped = rows.map(|((area, sum), b)| (area - sum) * f64::from(b[c]));
                    let missing = emitted - absorbed - escaped.sum::<f64>();
                    prop_assert!(missing.abs() <= bound);
                }
            }
        }
    }

    /// Twice the emission, twice the radiosity; exact, since powers of two only move exponents.
    #[test]
    fn radiosity_is_linear_in_emission(case in random_case()) {
        for method in METHODS {
            let solution = case.solve(&with(method));
            let double = |light: &Vec<Rgb>| light.iter().map(|e| e.map(|c| 2.0 * c)).collect();
            let lights = case.lights.iter().map(double).collect();
            let doubled = solve(
                &System { lights: &Vec::from_iter::<Vec<Vec<Rgb>>>(lights), ..case.system() },
                &with(method),
            );
            let doubled = doubled.unwrap();
            for (one, two) in solution.lights.iter().zip(&doubled.lights) {
                let twice: Vec<[f32; 3]> = one.iter().map(|b| b.map(|c| 2.0 * c)).collect();
                prop_assert_eq!(&twice, two);
            }
        }
    }
}

/// The estimated error holds, within a factor, in rooms where light dies away slowly.
#[test]
fn errors_are_known() {
    for rho in [0.5, 0.9, 0.97] {
        let mut case = Case::uniform_enclosure(40, [0.0; 3], [rho; 3]);
        case.lights[0][0] = [1.0, 2.0, 3.0];
        let truth = exact(&case);
        for method in METHODS {
            let params = Params {
                residual: 1e-4,
                ..with(method)
            };
            let solution = case.solve(&params);
            let error = distance(&case, &in_double(&solution.lights[0]), &truth);
            let Some(estimate) = solution.report.error else {
                continue;
            };
            // Values are rounded to single precision.
            let is_known = error <= 2.0 * estimate + 1e-7;
            assert!(is_known, "{rho} {method:?}: {error} {estimate}");
        }
    }
}

/// In the room of equal patches, the first sweeps tell the reflectance, and with it the best
/// factor: one that is greater or smaller needs more sweeps.
#[test]
fn the_automatic_factor_is_the_best_in_a_uniform_room() {
    for rho in [0.5, 0.9, 0.95] {
        let mut case = Case::uniform_enclosure(300, [0.0; 3], [rho; 3]);
        case.lights[0][77] = [1.0; 3];
        let run =
            |relaxation: Relaxation| case.solve(&with((Method::GaussSeidel, relaxation))).report;
        let report = run(Relaxation::Automatic);
        let found = report.relaxation.unwrap();
        let sweeps = |factor: f64| run(Relaxation::Factor(factor)).residuals.len();
        println!("{rho}: {found}, {} sweeps", report.residuals.len());
        // The first sweeps, which only look, may cost two.
        let most = report.residuals.len() - 2;
        for other in [1.0, found - 0.1, found + 0.15] {
            assert!(sweeps(other) >= most, "{rho} {other}: {}", sweeps(other));
        }
        assert!(report.residuals.len() < sweeps(1.0));
    }
}

/// Large enough for several threads in a pass; every sum of a method is taken in one order.
#[test]
fn threads_have_no_part_in_a_solution() {
    let size = 4300;
    let mut case = Case::uniform_enclosure(size, [0.0; 3], [0.9, 0.7, 0.5]);
    case.lights[0][4000] = [1.0, 2.0, 3.0];
    case.lights.push(vec![[0.1; 3]; size]);
    // The other factors are the same code as the automatic one.
    for method in [
        (Method::GaussSeidel, Relaxation::Automatic),
        (Method::ConjugateGradients, Relaxation::Automatic),
    ] {
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.unwrap().install(|| case.solve(&with(method)))
        };
        let expected = run(1);
        for threads in [2, 5] {
            assert!(run(threads) == expected, "{method:?}, {threads} threads");
        }
    }
}
