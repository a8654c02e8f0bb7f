//! Where the power of a light goes, as far as fronts are concerned.

use crate::scaled_system::{ScaledSystem, Values};
use crate::{Rgb, System};
use serde::{Deserialize, Serialize};

/// Powers of a light per channel, in W (exitance times square scene units).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Power {
    /// Emitted by the areas that exchange light.
    pub emitted: Rgb,
    /// Absorbed by the fronts of all patches.
    pub absorbed: Rgb,
}

impl Power {
    /// Those of each light, from what arrives where its radiosities leave.
    pub(crate) fn of_lights(
        system: &System<'_>,
        scaled: &ScaledSystem<'_>,
        irradiance: &Values<f64>,
    ) -> Vec<Power> {
        let lights = scaled.lights();
        let mut powers = vec![Power::default(); lights];
        for (k, irradiance) in irradiance.iter().enumerate() {
            let (i, light) = (k / lights, k % lights);
            let (power, unit) = (&mut powers[light], &scaled.units[light]);
            let (area, reflectance) = (system.areas()[i], &system.reflectance[i]);
            for c in 0..3 {
                let emission = f64::from(scaled.emission[k][c]);
                power.emitted[c] += area * unit[c] * emission;
                power.absorbed[c] += area * unit[c] * (1.0 - reflectance[c]) * irradiance[c];
            }
        }
        powers
    }
}
