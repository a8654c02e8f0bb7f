//! Where the power goes.

use crate::problem::{Problem, Values, ratio};
use crate::{Rgb, System};
use serde::{Deserialize, Serialize};

/// A power balance per channel, in W (exitance times square scene units).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Emitted by all patches.
    pub emitted: Rgb,
    /// Absorbed by the fronts of all patches.
    pub absorbed: Rgb,
    /// Arrived at backs, by what patches see of them.
    pub to_backs: Rgb,
    /// Left the scene, by what patches see of nothing.
    pub to_background: Rgb,
}

impl Energy {
    /// The balance of each light, from its radiosities and their sums.
    pub(crate) fn of_lights(
        system: &System<'_>,
        problem: &Problem<'_>,
        radiosity: &Values<f32>,
        sums: &Values<f64>,
    ) -> Vec<Energy> {
        let lights = problem.lights();
        let mut energies = vec![Energy::default(); lights];
        for (k, (x, sum)) in radiosity.iter().zip(sums).enumerate() {
            let (i, light) = (k / lights, k % lights);
            let (energy, unit) = (&mut energies[light], &problem.units[light]);
            let area = system.areas[i];
            let hidden = 1.0 - system.visible[i];
            // The hidden part sees nothing else.
            let backs = (system.backs[i] - hidden).max(0.0);
            let arrived = ratio(system.visible_area(i), problem.areas[i]);
            for c in 0..3 {
                let left = area * unit[c] * f64::from(x[c]);
                let emitted = area * unit[c] * f64::from(problem.emission[k][c]);
                energy.emitted[c] += emitted;
                energy.absorbed[c] += (1.0 - system.reflectance[i][c]) * arrived * unit[c] * sum[c];
                energy.to_backs[c] += backs * left + hidden * emitted;
                energy.to_background[c] += system.background[i] * left;
            }
        }
        energies
    }

    /// With another balance times a factor per channel.
    pub(crate) fn plus(&self, other: &Energy, factor: &Rgb) -> Energy {
        let sum = |a: &Rgb, b: &Rgb| std::array::from_fn(|c| a[c] + factor[c] * b[c]);
        Energy {
            emitted: sum(&self.emitted, &other.emitted),
            absorbed: sum(&self.absorbed, &other.absorbed),
            to_backs: sum(&self.to_backs, &other.to_backs),
            to_background: sum(&self.to_background, &other.to_background),
        }
    }

    /// What was emitted and is not accounted for, per channel: the residual, and the errors of the
    /// form factors and of what patches see besides fronts. Negative where light came from nowhere.
    pub fn missing(&self) -> Rgb {
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
