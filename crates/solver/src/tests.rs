//! Physics of small systems with known answers, and the textbook loop as the oracle.

use crate::*;
use proptest::prelude::*;
use radiosity_matrix::{SymmetricMatrix, packed_len};

#[derive(Debug)]
struct Case {
    exchange: SymmetricMatrix,
    areas: Vec<f64>,
    emission: Vec<Rgb>,
    reflectance: Vec<Rgb>,
}

impl Case {
    fn system(&self) -> System<'_> {
        System {
            exchange: &self.exchange,
            areas: &self.areas,
            emission: &self.emission,
            reflectance: &self.reflectance,
        }
    }

    /// A closed enclosure in which everything sees everything else equally.
    fn uniform_enclosure(size: usize, emission: Rgb, reflectance: Rgb) -> Case {
        let row_sum_one = 1.0 / (size * (size - 1)) as f32;
        Case {
            exchange: SymmetricMatrix::new(size, vec![row_sum_one; packed_len(size)]).unwrap(),
            areas: vec![2.0; size],
            emission: vec![emission; size],
            reflectance: vec![reflectance; size],
        }
    }

    fn solve(&self) -> Solution {
        solve(&self.system(), &Params::default(), &mut |_| ()).unwrap()
    }
}

fn random_case() -> impl Strategy<Value = Case> {
    (2usize..12).prop_flat_map(|size| {
        let exchange = prop::collection::vec(0.0f32..1.0, packed_len(size));
        let areas = prop::collection::vec(0.5f64..2.0, size);
        let emission = prop::collection::vec([0.0f64..1.0, 0.0f64..1.0, 0.0f64..1.0], size);
        let reflectance = prop::collection::vec([0.0f64..0.9, 0.0f64..0.9, 0.0f64..0.9], size);
        (exchange, areas, emission, reflectance).prop_map(
            move |(mut exchange, areas, emission, reflectance)| {
                // Row sums at most 1: S_ij <= smallest area / (n - 1), in units of the total.
                let total: f64 = areas.iter().sum();
                let scale = (0.5 / total / (size - 1) as f64) as f32;
                exchange.iter_mut().for_each(|s| *s *= scale);
                let exchange = SymmetricMatrix::new(size, exchange).unwrap();
                Case {
                    exchange,
                    areas,
                    emission,
                    reflectance,
                }
            },
        )
    })
}

/// The loop of the textbooks, on full rows.
fn textbook_sweep(case: &Case, x: &mut [Rgb]) {
    let total: f64 = case.areas.iter().sum();
    for i in 0..x.len() {
        for c in 0..3 {
            let factor = |j: usize| f64::from(case.exchange.get(i, j)) * total / case.areas[i];
            let incoming: f64 = (0..x.len()).map(|j| factor(j) * x[j][c]).sum();
            x[i][c] = case.emission[i][c] + case.reflectance[i][c] * incoming;
        }
    }
}

#[test]
fn furnace_has_its_closed_form() {
    // In a closed enclosure of equal patches, B = E / (1 - rho). The residual bounds the error
    // by tolerance / (1 - rho); f32 storage of the row sums adds 1e-7 / (1 - rho).
    let case = Case::uniform_enclosure(50, [1.0, 2.0, 0.5], [0.5, 0.8, 0.0]);
    let expected = [2.0, 10.0, 0.5];
    for b in case.solve().radiosity {
        for c in 0..3 {
            assert!((f64::from(b[c]) / expected[c] - 1.0).abs() < 1.1e-6 / (1.0 - 0.8));
        }
    }
}

#[test]
fn black_surfaces_keep_their_emission() {
    let case = Case::uniform_enclosure(5, [0.25, 1.0, 3.0], [0.0; 3]);
    let solution = case.solve();
    assert_eq!(solution.radiosity, vec![[0.25, 1.0, 3.0]; 5]);
    assert_eq!(solution.report.residuals, [0.0]);
}

#[test]
fn darkness_needs_no_sweep() {
    let solution = Case::uniform_enclosure(5, [0.0; 3], [0.5; 3]).solve();
    assert_eq!(solution.radiosity, vec![[0.0; 3]; 5]);
    assert!(solution.report.converged && solution.report.residuals.is_empty());
}

#[test]
fn running_out_of_sweeps_is_reported() {
    let case = Case::uniform_enclosure(5, [1.0; 3], [0.99; 3]);
    let params = Params {
        max_sweeps: 3,
        ..Params::default()
    };
    let report = solve(&case.system(), &params, &mut |_| ()).unwrap().report;
    assert!(!report.converged);
    assert_eq!(report.residuals.len(), 3);
}

#[test]
fn a_system_that_makes_light_names_its_worst_patches() {
    let mut case = Case::uniform_enclosure(5, [1.0; 3], [0.9; 3]);
    let mut values = case.exchange.values().to_vec();
    values[packed_len(3) + 1] *= 10.0;
    case.exchange = SymmetricMatrix::new(5, values).unwrap();
    let error = solve(&case.system(), &Params::default(), &mut |_| ()).unwrap_err();
    let SolveError::Diverges {
        spectral_radius,
        worst_patches,
    } = error
    else {
        panic!("expected divergence, got {error}");
    };
    assert!(spectral_radius > 1.0);
    let mut worst = worst_patches[..2].to_vec();
    worst.sort_unstable();
    assert_eq!(worst, [1, 3]);
}

#[test]
fn barely_diverging_systems_are_caught_at_the_sweep_limit() {
    // rho = 1 in a closed room: light never goes away.
    let case = Case::uniform_enclosure(5, [1.0; 3], [1.0; 3]);
    let error = solve(&case.system(), &Params::default(), &mut |_| ());
    // f32 row sums lie within 1e-7 of 1, so either side of the threshold is honest.
    match error {
        Err(SolveError::Diverges {
            spectral_radius, ..
        }) => {
            assert!((spectral_radius - 1.0).abs() < 1e-6);
        }
        Ok(solution) => assert!(!solution.report.converged),
        Err(other) => panic!("{other}"),
    }
}

/// Two plates that see each other alone: the eigenvalues come in pairs of either sign.
fn plates(factor: f32, reflectances: [f64; 2]) -> Case {
    Case {
        exchange: SymmetricMatrix::new(2, vec![0.5 * factor]).unwrap(),
        areas: vec![1.0; 2],
        emission: vec![[1.0; 3]; 2],
        reflectance: reflectances.map(|rho| [rho; 3]).to_vec(),
    }
}

/// The spectral radius is F sqrt(rho_1 rho_2), whatever its sign does.
#[test]
fn plates_diverge_exactly_when_they_must() {
    let error = solve(
        &plates(11.0, [1.0, 0.01]).system(),
        &Params::default(),
        &mut |_| (),
    );
    let Err(SolveError::Diverges {
        spectral_radius,
        worst_patches,
    }) = error
    else {
        panic!("a radius of 1.1 diverges");
    };
    assert!((spectral_radius - 1.1).abs() < 1e-6);
    assert_eq!(worst_patches, [0, 1]);
    let stopped_early = Params {
        max_sweeps: 2,
        ..Params::default()
    };
    let fine = plates(6.3, [1.0, 0.01]);
    let report = solve(&fine.system(), &stopped_early, &mut |_| ())
        .unwrap()
        .report;
    assert!(!report.converged);
    assert!(fine.solve().report.converged);
}

#[test]
fn a_quick_explosion_is_explained_too() {
    let error = solve(
        &plates(1e9, [1.0, 1.0]).system(),
        &Params::default(),
        &mut |_| (),
    );
    assert!(
        matches!(error, Err(SolveError::Diverges { .. })),
        "{error:?}"
    );
}

/// Powers far from 1, whose squares a double cannot hold.
#[test]
fn units_do_not_matter() {
    for unit in [1e-170, 1e30, 1e200] {
        let mut case = Case::uniform_enclosure(5, [unit; 3], [0.5; 3]);
        case.emission[0] = [0.0; 3];
        let report = case.solve().report;
        assert!(report.converged && report.residuals.len() > 3, "{unit}");
        assert!(report.energy.imbalance() < 1e-5);
    }
}

#[test]
fn numbers_that_are_not_finite_are_traced_to_their_patch() {
    let mut case = Case::uniform_enclosure(5, [1.0; 3], [0.5; 3]);
    case.emission[3][1] = f64::NAN;
    let error = solve(&case.system(), &Params::default(), &mut |_| ()).unwrap_err();
    assert_eq!(error, SolveError::NotFinite { patch: 3 });
}

proptest! {
    /// Same iterates as the textbook loop. The two differ in the order of f64 sums of at most
    /// 12 terms and in nothing else, so 1e-14 per operation is generous.
    #[test]
    fn iterates_are_those_of_the_textbook(case in random_case(), sweeps in 1u32..6) {
        let params = Params { tolerance: 0.0, max_sweeps: sweeps };
        let solution = solve(&case.system(), &params, &mut |_| ()).unwrap();
        let mut x = case.emission.clone();
        // A residual of exactly zero ends the iteration early; the textbook is then done too.
        for _ in 0..sweeps {
            textbook_sweep(&case, &mut x);
        }
        for (b, x) in solution.radiosity.iter().zip(&x) {
            for c in 0..3 {
                prop_assert!((f64::from(b[c]) - x[c]).abs() <= 1.2e-7 * x[c] + 1e-12);
            }
        }
    }

    /// The residual that falls out of a sweep is the one computed from its definition.
    #[test]
    fn residuals_are_true(case in random_case(), sweeps in 1u32..4) {
        let system = case.system();
        let params = Params { tolerance: 0.0, max_sweeps: sweeps };
        let report = solve(&system, &params, &mut |_| ()).unwrap().report;
        let mut x = case.emission.clone();
        for _ in 0..report.residuals.len() {
            textbook_sweep(&case, &mut x);
        }
        let irradiance = system.irradiance(&x);
        let defect = (0..x.len()).map(|i| std::array::from_fn(|c| {
            case.emission[i][c] + case.reflectance[i][c] * irradiance[i][c] - x[i][c]
        }));
        let direct = system.norm(defect) / system.norm(case.emission.iter().copied());
        prop_assert!((direct - report.residual()).abs() < 1e-13);
    }

    /// Emitted = absorbed + escaped, up to the residual.
    #[test]
    fn energy_balances(case in random_case()) {
        let report = case.solve().report;
        prop_assert!(report.converged);
        prop_assert!(report.energy.imbalance() < 1e-5);
    }

    /// Twice the emission, twice the radiosity; exact, since powers of two only move exponents.
    #[test]
    fn radiosity_is_linear_in_emission(case in random_case()) {
        let solution = case.solve();
        let emission = case.emission.iter().map(|e| e.map(|c| 2.0 * c)).collect();
        let doubled = Case { emission, ..case }.solve();
        for (one, two) in solution.radiosity.iter().zip(&doubled.radiosity) {
            prop_assert_eq!(one.map(|c| 2.0 * c), *two);
        }
    }
}
