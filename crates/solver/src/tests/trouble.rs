//! Systems without a solution.

use super::*;
use crate::power_iteration::spectral_radius;
use radiosity_matrix::{Sweep, Triple};

#[test]
fn a_system_that_makes_light_names_its_worst_patches() {
    let case = Case::uniform_enclosure(5, [1.0; 3], [0.9; 3]);
    let mut values = case.values();
    values[packed_len(3) + 1] *= 10.0;
    let case = case.with_values(values);
    for method in METHODS {
        let error = solve(&case.system(), &with(method)).unwrap_err();
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
}

/// rho = 1 in a closed room: light never goes away. Row sums in single precision lie within 1e-7 of
/// 1, on either side.
#[test]
fn rooms_that_absorb_nothing_have_no_solution() {
    for (size, reflectance) in [(5, [1.0; 3]), (40, [1.0, 0.5, 0.01])] {
        let case = Case::uniform_enclosure(size, [1.0; 3], reflectance);
        for method in METHODS {
            let error = solve(&case.system(), &with(method)).unwrap_err();
            let SolveError::Diverges {
                spectral_radius, ..
            } = error
            else {
                panic!("expected divergence, got {error}");
            };
            assert!((spectral_radius - 1.0).abs() < 1e-6);
        }
    }
}

/// A covered patch has no area, exchanges nothing, and has its emission for radiosity.
#[test]
fn covered_patches_are_left_alone() {
    let case = Case::uniform_enclosure(5, [1.0; 3], [0.5; 3]);
    let mut values = case.values();
    values[..packed_len(3)][packed_len(2)..].fill(0.0);
    values[packed_len(3) + 2] = 0.0;
    values[packed_len(4) + 2] = 0.0;
    let mut case = case.with_values(values);
    let mut areas = case.exchange.areas().to_vec();
    areas[2] = 0.0;
    case.exchange = case.exchange.of_parts(areas);
    for method in METHODS {
        let solution = solve(&case.system(), &with(method)).unwrap();
        assert!(solution.report.converged);
        assert_eq!(solution.lights[0][2], [1.0; 3]);
        let power = solution.report.powers[0];
        assert!(power.emitted[0].is_finite() && power.absorbed[0].is_finite());
    }
    assert!(spectral_radius(&case.system()) < 1.0);
}

/// Two plates that see each other alone: the eigenvalues come in pairs of either sign.
fn plates(factor: f32, reflectances: [f64; 2]) -> Case {
    Case::new(
        SymmetricMatrix::new(2, vec![0.5 * factor]).unwrap(),
        vec![1.0; 2],
        vec![vec![[1.0; 3]; 2]],
        reflectances.map(|rho| [rho; 3]).to_vec(),
    )
}

/// Far from a solution after one pass, and much worse than the emission alone: the first plate
/// reflects 90 times what it is to have had from the second one by then.
#[test]
fn what_is_worse_than_no_light_is_no_solution() {
    let params = Params {
        max_sweeps: 1,
        ..with((Method::GaussSeidel, Relaxation::Factor(1.0)))
    };
    let case = plates(90.0, [1.0, 1e-4]);
    let error = solve(&case.system(), &params).unwrap_err();
    assert!(
        matches!(error, SolveError::Worthless { residual } if residual > 10.0),
        "{error}"
    );
}

/// The spectral radius is F sqrt(rho_1 rho_2), whatever its sign does.
#[test]
fn plates_diverge_exactly_when_they_must() {
    let system = plates(11.0, [1.0, 0.01]);
    let error = solve(&system.system(), &Params::default());
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
    assert!(!fine.solve(&stopped_early).report.converged);
    assert!(fine.solve(&Params::default()).report.converged);
}

#[test]
fn a_quick_explosion_is_explained_too() {
    let system = plates(1e9, [1.0, 1.0]);
    for method in METHODS {
        let error = solve(&system.system(), &with(method));
        assert!(
            matches!(error, Err(SolveError::Diverges { .. })),
            "{method:?} {error:?}"
        );
    }
}

#[test]
fn numbers_that_are_not_finite_are_traced_to_their_patch() {
    let mut case = Case::uniform_enclosure(5, [1.0; 3], [0.5; 3]);
    case.lights[0][3][1] = f64::NAN;
    let error = solve(&case.system(), &Params::default()).unwrap_err();
    assert_eq!(error, SolveError::NotFinite { patch: 3 });
    let case = Case::uniform_enclosure(5, [1.0; 3], [0.5; 3]);
    let mut values = case.values();
    values[packed_len(4) + 2] = f32::NAN;
    let case = case.with_values(values);
    for method in METHODS {
        let error = solve(&case.system(), &with(method)).unwrap_err();
        assert_eq!(error, SolveError::NotFinite { patch: 2 });
    }
}

/// An exchange that knows products alone.
#[derive(Debug)]
struct WithoutRows(DenseExchange);

impl Exchange for WithoutRows {
    fn areas(&self) -> &[f64] {
        self.0.areas()
    }

    fn product(&self, x: &[Triple<f32>], triples: usize) -> Vec<Triple<f64>> {
        self.0.product(x, triples)
    }

    fn rows(&self) -> Option<&dyn Sweep> {
        None
    }
}

/// Conjugate gradients need products alone.
#[test]
fn gauss_seidel_needs_rows() {
    let case = Case::uniform_enclosure(40, [1.0, 0.5, 0.0], [0.5, 0.7, 0.9]);
    let exchange = WithoutRows(case.exchange.clone());
    let system = System {
        exchange: &exchange,
        ..case.system()
    };
    for method in METHODS {
        let found = solve(&system, &with(method));
        match method.0 {
            Method::GaussSeidel => assert_eq!(found.unwrap_err(), SolveError::NoRows),
            Method::ConjugateGradients => {
                assert_eq!(found.unwrap(), case.solve(&with(method)));
            }
        }
    }
}
