//! Where the power of lights goes.

use radiosity_form_factors::FormFactors;
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
    /// The balance of each light. What is lost is known from rays, and so independent of the form
    /// factors.
    pub(crate) fn of_lights(form_factors: &FormFactors, solution: &Solution) -> Vec<Energy> {
        let lights = solution.report.powers.iter().zip(&solution.lights);
        let balance = |(power, radiosity): (&Power, &Vec<[f32; 3]>)| {
            let [to_backs, to_background] = form_factors.lost(radiosity);
            Energy {
                emitted: power.emitted,
                absorbed: power.absorbed,
                to_backs,
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
