//! Where the power goes.

use crate::{Rgb, System};
use serde::{Deserialize, Serialize};

/// The power balance of a solution, per channel, in W (exitance times square scene units).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Emitted by all patches.
    pub emitted: Rgb,
    /// Absorbed by all patches.
    pub absorbed: Rgb,
    /// Left without arriving at any front: into the background or onto backs. An estimator
    /// whose row sums exceed 1 lets it come out too small, or negative.
    pub escaped: Rgb,
}

impl Energy {
    /// Adds up the solution's power; `fronts` are the row sums of the form factors.
    pub(crate) fn of(system: &System<'_>, radiosity: &[Rgb]) -> Energy {
        let irradiance = system.irradiance(radiosity);
        let total = system.total_area();
        let row_sums = system.exchange.row_sums();
        let mut energy = Energy {
            emitted: [0.0; 3],
            absorbed: [0.0; 3],
            escaped: [0.0; 3],
        };
        for (i, &area) in system.areas.iter().enumerate() {
            // What leaves patch i and arrives nowhere: A_i - sum_j S_ij.
            let open_area = area - row_sums[i] * total;
            for c in 0..3 {
                energy.emitted[c] += area * system.emission[i][c];
                energy.absorbed[c] += area * (1.0 - system.reflectance[i][c]) * irradiance[i][c];
                energy.escaped[c] += open_area * radiosity[i][c];
            }
        }
        energy
    }

    /// `|emitted - absorbed - escaped| / emitted` of the worst channel; channels without
    /// emission count as balanced.
    pub fn imbalance(&self) -> f64 {
        (0..3)
            .filter(|&c| self.emitted[c] > 0.0)
            .map(|c| {
                let missing = self.emitted[c] - self.absorbed[c] - self.escaped[c];
                missing.abs() / self.emitted[c]
            })
            .fold(0.0, f64::max)
    }
}
