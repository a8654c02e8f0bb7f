//! Where the power of lights goes.

use radiosity_form_factors::FormFactors;
use radiosity_matrix::Exchange;
use radiosity_solver::{Power, Solution};
use serde::{Deserialize, Serialize};

/// A power balance per channel, in W (exitance times square scene units).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Emitted by all patches.
    pub emitted: [f64; 3],
    /// Absorbed by the fronts of all patches.
    pub absorbed: [f64; 3],
    /// Arrived at backs, by what patches see of them.
    pub to_backs: [f64; 3],
    /// Left the scene, by what patches see of nothing.
    pub to_background: [f64; 3],
}

impl Energy {
    /// The balance of each light, of which the emission is given. What is lost is known from rays,
    /// and so independent of the form factors.
    pub(crate) fn of_lights(
        form_factors: &FormFactors,
        solution: &Solution,
        emission: &[Vec<[f64; 3]>],
    ) -> Vec<Energy> {
        let powers = solution.report.powers.iter();
        let lights = powers.zip(&solution.lights).zip(emission);
        let balance = |((power, radiosity), emission): ((&Power, &Vec<[f32; 3]>), &Vec<_>)| {
            let [to_backs, to_background] = form_factors.lost(radiosity);
            // What of a patch is no element emits, too, and all of it meets backs.
            let hidden = emitted_by_hidden(form_factors, emission);
            let plus = |a: [f64; 3]| std::array::from_fn(|c| a[c] + hidden[c]);
            Energy {
                emitted: plus(power.emitted),
                absorbed: power.absorbed,
                to_backs: plus(to_backs),
                to_background,
            }
        };
        lights.map(balance).collect()
    }

    /// That of lights together, each dimmed by a factor per channel.
    pub(crate) fn sum(lights: &[Energy], dimming: &[[f64; 3]]) -> Energy {
        let lights = lights.iter().zip(dimming);
        lights.fold(Energy::default(), |sum, (light, factor)| {
            let plus = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|c| a[c] + factor[c] * b[c]);
            Energy {
                emitted: plus(sum.emitted, light.emitted),
                absorbed: plus(sum.absorbed, light.absorbed),
                to_backs: plus(sum.to_backs, light.to_backs),
                to_background: plus(sum.to_background, light.to_background),
            }
        })
    }

    /// What was emitted and is not accounted for, per channel: the residual, and the errors of the
    /// form factors and of what patches see besides fronts. Negative where light came from nowhere.
    pub fn missing(&self) -> [f64; 3] {
        std::array::from_fn(|c| {
            self.emitted[c] - self.absorbed[c] - self.to_backs[c] - self.to_background[c]
        })
    }

    /// The size of [`Energy::missing`] relative to what was emitted, of the worst channel; channels
    /// without emission count as balanced.
    pub fn imbalance(&self) -> f64 {
        let missing = self.missing();
        (0..3)
            .filter(|&c| self.emitted[c] > 0.0)
            .map(|c| missing[c].abs() / self.emitted[c])
            .fold(0.0, f64::max)
    }
}

/// The power that parts of patches emit that are no elements.
fn emitted_by_hidden(form_factors: &FormFactors, emission: &[[f64; 3]]) -> [f64; 3] {
    let elements = form_factors.exchange.areas();
    let hidden = form_factors
        .areas
        .iter()
        .zip(elements)
        .map(|(area, element)| area - element);
    let add = |sum: [f64; 3], (hidden, emission): (f64, &[f64; 3])| {
        std::array::from_fn(|c| sum[c] + hidden * emission[c])
    };
    hidden.zip(emission).fold([0.0; 3], add)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_dimmed_light_by_light() {
        let light = |scale: f64| Energy {
            emitted: [10.0 * scale; 3],
            absorbed: [7.0 * scale; 3],
            to_backs: [scale; 3],
            to_background: [2.0 * scale; 3],
        };
        let sum = Energy::sum(
            &[light(1.0), light(0.1)],
            &[[0.5, 1.0, 0.0], [2.0, 0.0, 1.0]],
        );
        let expected = |whole: f64| [0.5 * whole + 0.2 * whole, whole, 0.1 * whole];
        for (found, whole) in [
            (sum.emitted, 10.0),
            (sum.absorbed, 7.0),
            (sum.to_backs, 1.0),
            (sum.to_background, 2.0),
        ] {
            for (found, expected) in found.into_iter().zip(expected(whole)) {
                assert!((found - expected).abs() < 1e-12, "{sum:?}");
            }
        }
        assert!(sum.imbalance() < 1e-12);
        assert_eq!(Energy::sum(&[], &[]), Energy::default());
        assert_eq!(Energy::default().imbalance(), 0.0);
        let missing = Energy {
            absorbed: [6.0; 3],
            ..light(1.0)
        };
        assert!((missing.imbalance() - 0.1).abs() < 1e-12);
    }
}
