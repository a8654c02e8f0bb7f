//! Light that is shot, against light that is solved.

use super::*;

fn row(case: &Case, i: usize) -> Vec<f32> {
    (0..case.areas.len())
        .map(|j| case.exchange.get(i, j))
        .collect()
}

/// Shooters know of no hidden parts.
fn uncovered_case() -> impl Strategy<Value = Case> {
    random_case().prop_map(|case| Case {
        visible: vec![1.0; case.areas.len()],
        ..case
    })
}

fn alone(case: &Case) -> Progressive<'_> {
    let clusters = (0..case.areas.len()).map(|i| vec![i]).collect();
    Progressive::new(&case.areas, &case.reflectance, &case.lights, clusters)
}

proptest! {
    /// Patches that shoot for themselves alone, for long enough, end at the solution.
    #[test]
    fn shooting_converges_to_the_solution(case in uncovered_case()) {
        let mut light = alone(&case);
        while light.unshot() > 1e-8 {
            let brightest = light.brightest(1)[0];
            light.shoot(brightest, &row(&case, brightest));
        }
        let solved = case.solve(&Params::default());
        for (shot, solved) in light.lights().iter().zip(&solved.lights) {
            let (shot, solved) = (in_double(shot), in_double(solved));
            let difference: Vec<Rgb> = shot
                .iter()
                .zip(&solved)
                .map(|(a, b)| std::array::from_fn(|c| a[c] - b[c]))
                .collect();
            // The residual of the solution, in the norm of methods_agree.
            prop_assert!(norm(&case, &difference) <= 1e-5 * norm(&case, &solved));
        }
    }

    /// What is shown is never less than what has arrived, and the ambient term fades.
    #[test]
    fn the_power_that_waits_shrinks(case in uncovered_case()) {
        let mut light = alone(&case);
        let mut before = light.unshot();
        for _ in 0..20 {
            let Some(&brightest) = light.brightest(1).first() else { break };
            light.shoot(brightest, &row(&case, brightest));
            prop_assert!(light.unshot() <= before * (1.0 + 1e-6));
            before = light.unshot();
        }
    }
}

/// In a room of equal patches the ambient term is right from the start, but for what a patch does
/// not get from itself: one part in as many as there are patches.
#[test]
fn the_ambient_term_is_exact_where_light_is_even() {
    let mut case = Case::uniform_enclosure(200, [0.0; 3], [0.5, 0.8, 0.2]);
    case.lights[0][9] = [1.0, 2.0, 3.0];
    let shown = &alone(&case).lights()[0];
    let solved = &case.solve(&Params::default()).lights[0];
    for (i, (shown, solved)) in shown.iter().zip(solved).enumerate() {
        for c in (0..3).filter(|_| i != 9) {
            assert!(
                (shown[c] / solved[c] - 1.0).abs() < 2.0 / 200.0,
                "{shown:?} {solved:?}"
            );
        }
    }
}

/// A cluster shoots all its light along the row of one of its patches.
#[test]
fn clusters_shoot_together() {
    let case = Case::uniform_enclosure(10, [1.0; 3], [0.5; 3]);
    let clusters = vec![(0..5).collect(), (5..10).collect()];
    let mut light = Progressive::new(&case.areas, &case.reflectance, &case.lights, clusters);
    assert_eq!(light.brightest(5), [0, 1]);
    let before = light.unshot();
    light.shoot(0, &row(&case, light.shooter(0)));
    // Half of the light has been shot, and half of that reflected.
    assert!((light.unshot() / before - 0.75).abs() < 1e-6);
    assert_eq!(light.brightest(1), [1]);
}
