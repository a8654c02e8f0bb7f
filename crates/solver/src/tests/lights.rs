//! Several lights, and lights that are dimmed.

use super::*;

fn two_lights() -> Case {
    let mut case = Case::uniform_enclosure(30, [0.0; 3], [0.8, 0.6, 0.4]);
    case.lights.push(case.lights[0].clone());
    case.lights[0][3] = [10.0, 5.0, 1.0];
    case.lights[1][20] = [0.1, 0.2, 0.4];
    case
}

/// What a fresh solution of the dimmed lights gives, to the residuals and to single precision.
#[test]
fn relit_is_solved_anew() {
    let case = two_lights();
    let dimming = [[0.3, 0.2, 1.0], [7.0, 0.0, 2.0]];
    let superposed = superpose(&case.solve(&Params::default()).lights, &dimming);
    let mut dimmed = two_lights();
    let mut sum = vec![[0.0; 3]; 30];
    for (light, dim) in case.lights.iter().zip(&dimming) {
        for (sum, emission) in sum.iter_mut().zip(light) {
            *sum = std::array::from_fn(|c| sum[c] + emission[c] * dim[c]);
        }
    }
    dimmed.lights = vec![sum];
    let fresh = &dimmed.solve(&Params::default()).lights[0];
    for (superposed, fresh) in superposed.as_flattened().iter().zip(fresh.as_flattened()) {
        // Residuals of 1e-6 of emissions that are at most 40 times the radiosity of the others.
        assert!(
            (superposed - fresh).abs() <= 1e-5 * fresh,
            "{superposed} {fresh}"
        );
    }
}

/// The worst light decides, however dark it is.
#[test]
fn every_light_converges() {
    let mut case = two_lights();
    for channel in case.lights[1].as_flattened_mut() {
        *channel *= 1e-20;
    }
    let solution = case.solve(&with(GAUSS_SEIDEL));
    let alone = Case {
        lights: vec![case.lights[1].clone()],
        ..two_lights()
    };
    let alone = alone.solve(&Params {
        residual: 0.0,
        max_sweeps: solution.report.residuals.len() as u32,
        ..with(GAUSS_SEIDEL)
    });
    assert_eq!(solution.lights[1], alone.lights[0]);
    assert!(solution.report.residual <= 1e-6);
}

#[test]
fn a_dark_light_is_dark() {
    let mut case = two_lights();
    case.lights[1] = vec![[0.0; 3]; 30];
    let solution = case.solve(&Params::default());
    assert!(solution.report.converged);
    assert_eq!(solution.lights[1], vec![[0.0; 3]; 30]);
}

/// Light is reflected once by `rho F E`.
#[test]
fn direct_light_is_reflected_once() {
    let mut case = two_lights();
    case.lights[0][3] = [0.0; 3];
    let solution = case.solve(&Params::default());
    assert_eq!(solution.direct.len(), case.lights.len());
    for (direct, light) in solution.direct.iter().zip(&case.lights) {
        for (i, found) in direct.iter().enumerate() {
            let irradiance = irradiance(&case, i, light);
            for c in 0..3 {
                let expected = case.reflectance[i][c] * irradiance[c];
                // Single precision, and that of sums.
                assert!((f64::from(found[c]) - expected).abs() <= 1e-6 * expected);
            }
        }
    }
}

#[test]
fn no_light_is_dark() {
    let mut case = two_lights();
    case.lights.clear();
    for method in METHODS {
        let solution = case.solve(&with(method));
        assert!(solution.report.converged && solution.lights.is_empty());
        assert!(superpose(&solution.lights, &[]).is_empty());
    }
}

/// Powers far from 1, whose squares a double cannot hold.
#[test]
fn units_do_not_matter() {
    for unit in [1e-30, 1e30] {
        let mut case = Case::uniform_enclosure(5, [unit; 3], [0.5; 3]);
        case.lights[0][0] = [0.0; 3];
        for method in METHODS {
            let report = case.solve(&with(method)).report;
            assert!(report.converged && report.residuals.len() > 1, "{unit}");
            let power = report.powers[0];
            assert!((power.absorbed[0] / power.emitted[0] - 1.0).abs() < 1e-5);
        }
    }
}
