//! Numbers of any size: channels know nothing of each other, and rounding has no say in steps.

use super::*;

/// The same with the emission of each channel of each light times a factor.
fn scaled(case: &Case, factors: &[Rgb]) -> Vec<Vec<Rgb>> {
    let lights = case.lights.iter().zip(factors.iter().cycle());
    let light = |(light, factor): (&Vec<Rgb>, &Rgb)| {
        let times = |e: &Rgb| std::array::from_fn(|c| e[c] * factor[c]);
        light.iter().map(times).collect()
    };
    lights.map(light).collect()
}

fn solve_lights(case: &Case, lights: &[Vec<Rgb>], params: &Params) -> Solution {
    let system = System {
        lights,
        ..case.system()
    };
    solve(&system, params).unwrap()
}

/// Powers of two, which change no digit.
fn factor() -> impl Strategy<Value = f64> {
    (-80i32..80).prop_map(|power| 2.0f64.powi(power))
}

/// Any power of ten that single precision holds.
fn decimal_factor() -> impl Strategy<Value = f64> {
    (-30.0f64..30.0).prop_map(|power| 10.0f64.powf(power))
}

/// From 1 down to what doubles hardly hold, or black.
fn faint() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => (-300.0f64..0.0).prop_map(|power| 0.9 * 10.0f64.powf(power)),
        1 => Just(0.0),
        1 => 0.0f64..0.9,
    ]
}

fn rgb<T: Strategy<Value = f64>>(channel: impl Fn() -> T) -> [T; 3] {
    [channel(), channel(), channel()]
}

proptest! {
    /// However bright or faint each channel of each light is: the same digits.
    #[test]
    fn the_scale_of_emission_is_that_of_the_solution(
        case in random_case(),
        factors in [rgb(factor), rgb(factor)],
    ) {
        for method in METHODS {
            let plain = case.solve(&with(method));
            let found = solve_lights(&case, &scaled(&case, &factors), &with(method));
            let expected = plain.lights.iter().zip(&factors).map(|(light, factor)| {
                let times = |b: &[f32; 3]| std::array::from_fn(|c| b[c] * factor[c] as f32);
                light.iter().map(times).collect::<Vec<[f32; 3]>>()
            });
            prop_assert_eq!(expected.collect::<Vec<_>>(), found.lights, "{:?}", method);
            prop_assert_eq!(plain.report.residuals, found.report.residuals, "{:?}", method);
        }
    }

    /// Factors that change digits move the solution by what rounding and the residual allow; the
    /// latter's bound is that of `methods_agree`.
    #[test]
    fn every_channel_converges_at_any_scale(
        case in random_case(),
        factors in [rgb(decimal_factor), rgb(decimal_factor)],
    ) {
        let lights = scaled(&case, &factors);
        for method in METHODS {
            let expected = case.solve(&with(method));
            let found = solve_lights(&case, &lights, &with(method));
            prop_assert!(found.report.converged);
            for (light, factor) in factors.iter().take(case.lights.len()).enumerate() {
                for (c, factor) in factor.iter().enumerate() {
                    let emission = channel(&case.lights[light], c);
                    let [plain, other] = [&expected, &found]
                        .map(|of| channel(&in_double(&of.lights[light]), c));
                    let difference: Vec<Rgb> = plain
                        .iter()
                        .zip(&other)
                        .map(|(plain, other)| [other[0] / factor - plain[0], 0.0, 0.0])
                        .collect();
                    let bound = 4.0 * 2.0 * 1.2e-6 / (1.0 - 0.45) * norm(&case, &emission);
                    prop_assert!(norm(&case, &difference) <= bound, "{:?}", method);
                }
            }
        }
    }

    /// Reflectances of any size side by side, from 0.9 to next to nothing.
    #[test]
    fn faint_reflections_are_solved(
        case in random_case(),
        reflectance in prop::collection::vec(rgb(faint), 12),
    ) {
        let size = case.exchange.size();
        let case = Case { reflectance: reflectance[..size].to_vec(), ..case };
        let truth = exact(&case);
        for method in METHODS {
            let found = case.solve(&with(method));
            prop_assert!(found.report.converged, "{:?}", method);
            let found = in_double(&found.lights[0]);
            for c in 0..3 {
                let [found, truth, emission] =
                    [&found, &truth, &case.lights[0]].map(|of| channel(of, c));
                let difference: Vec<Rgb> =
                    found.iter().zip(&truth).map(|(a, b)| [a[0] - b[0], 0.0, 0.0]).collect();
                // The bound of `methods_agree`, of one solution.
                let bound = 4.0 * 1.2e-6 / (1.0 - 0.45) * norm(&case, &emission);
                prop_assert!(norm(&case, &difference) <= bound, "{:?}", method);
            }
        }
    }
}

/// Along a corridor in which patches see their neighbours alone, one channel is reflected on and
/// on, and the others die away at once: the many steps that the first one needs leave them alone.
#[test]
fn channels_that_have_converged_rest() {
    check_resting_channels(0.99);
}

#[test]
#[ignore = "slow: some seconds"]
fn channels_that_have_converged_rest_for_long() {
    check_resting_channels(0.999);
}

/// By the reflectance of the channel that converges last.
fn check_resting_channels(largest: f64) {
    let (size, reflectance) = (100, [largest, 0.1, 1e-4]);
    let case = Case::uniform_enclosure(size, [0.0; 3], reflectance);
    let half = 0.5 / size as f32;
    let row = |i: usize| (0..i).map(move |j| if i - j == 1 { half } else { 0.0 });
    let values: Vec<f32> = (0..size).flat_map(row).collect();
    let mut case = case.with_values(values);
    case.lights[0][7] = [1.0; 3];
    let truth = exact(&case);
    for method in METHODS {
        let params = Params {
            max_sweeps: 20_000,
            ..with(method)
        };
        let solution = case.solve(&params);
        let found = in_double(&solution.lights[0]);
        for (c, rho) in reflectance.into_iter().enumerate() {
            let [found, truth] = [&found, &truth].map(|of| channel(of, c));
            // A residual of 1e-6 of the emission, and single precision.
            let bound = 2e-6 / (1.0 - rho);
            assert!(distance(&case, &found, &truth) <= bound, "{method:?} {c}");
        }
    }
}

/// No residual is out of the question: what cannot be reached is said.
#[test]
fn unreachable_residuals_end_at_single_precision() {
    let mut case = Case::uniform_enclosure(40, [1.0, 0.0, 1e-25], [0.7, 0.5, 1e-30]);
    case.lights[0][3] = [0.0; 3];
    for method in METHODS {
        let params = Params {
            residual: 1e-300,
            ..with(method)
        };
        let report = case.solve(&params).report;
        assert!(report.stalled && !report.converged, "{method:?}");
        assert!(report.residual < 1e-6, "{method:?}");
    }
}

/// What a number of single precision cannot say is no solution.
#[test]
fn radiosities_out_of_range_are_refused() {
    for (emission, rho) in [(3e37, 0.99), (1e-39, 0.5), (1e39, 0.5), (1e-300, 0.5)] {
        let mut case = Case::uniform_enclosure(5, [1.0, 1.0, emission], [rho; 3]);
        case.lights[0][0] = [0.0; 3];
        for method in METHODS {
            let error = solve(&case.system(), &with(method)).unwrap_err();
            let is_known = matches!(error, SolveError::OutOfRange { .. });
            assert!(is_known, "{method:?}, {emission:e}: {error}");
        }
    }
}
