//! A system as the methods see it: lights side by side, in units in which numbers are ordinary.

use crate::{Rgb, System};
use radiosity_matrix::{Exchange, Triple};

/// Values of all lights at all patches: those of light `k` at patch `i` are at
/// `i * lights + k`.
pub(crate) type Values<T> = Vec<Triple<T>>;

/// Relative changes below this may change nothing, in single precision.
pub(crate) const UNIT_ROUNDOFF: f64 = 1.0 / (1 << 24) as f64;

/// `x_i = E_i + rho_i sum_j F_ij x_j`, for each channel of each light in units of its own largest
/// emission: channels know nothing of each other, and no square overflows or vanishes, however
/// bright or faint one of them is.
pub(crate) struct ScaledSystem<'a> {
    pub(crate) exchange: &'a dyn Exchange,
    /// Areas that exchange light, relative to the total of all.
    pub(crate) areas: Vec<f64>,
    /// `rho_i` per patch; 0 where no area exchanges light.
    pub(crate) reflectance: Vec<Rgb>,
    /// Rounded to what radiosities can be, so that black patches have no residual, and those that
    /// reflect next to nothing none but what they reflect: conjugate gradients weight residuals by
    /// `1 / rho`.
    pub(crate) emission: Values<f32>,
    /// What the numbers of each light are multiples of, in W/m^2.
    pub(crate) units: Vec<Rgb>,
    /// The norm of each light's emission.
    norms: Vec<Rgb>,
}

impl<'a> ScaledSystem<'a> {
    pub(crate) fn new(system: &System<'a>) -> ScaledSystem<'a> {
        let total: f64 = system.areas().iter().sum();
        let areas: Vec<f64> = system
            .areas()
            .iter()
            .map(|&area| ratio(area, total))
            .collect();
        let reflectance = system.reflectance.iter().zip(&areas);
        let reflectance = reflectance.map(|(rho, &area)| if area > 0.0 { *rho } else { [0.0; 3] });
        let reflectance = reflectance.collect();
        let units: Vec<Rgb> = system.lights.iter().map(|light| units_of(light)).collect();
        let at = |i: usize| {
            let lights = system.lights.iter().zip(&units);
            lights.map(move |(light, unit)| std::array::from_fn(|c| (light[i][c] / unit[c]) as f32))
        };
        let emission: Values<f32> = (0..system.size()).flat_map(at).collect();
        let mut scaled = ScaledSystem {
            exchange: system.exchange,
            areas,
            reflectance,
            emission,
            units,
            norms: Vec::new(),
        };
        scaled.norms = scaled.norms_of(|k| scaled.emission[k].map(f64::from));
        scaled
    }

    /// How many lights there are.
    pub(crate) fn lights(&self) -> usize {
        self.units.len()
    }

    /// Of each channel of each light, the area-weighted L2 norm over patches of `values`, which is
    /// asked by index.
    pub(crate) fn norms_of(&self, values: impl Fn(usize) -> Rgb) -> Vec<Rgb> {
        let mut sums = vec![[0.0; 3]; self.lights()];
        for (i, area) in self.areas.iter().enumerate() {
            for (light, sum) in sums.iter_mut().enumerate() {
                let value = values(i * self.lights() + light);
                (0..3).for_each(|c| sum[c] += area * value[c] * value[c]);
            }
        }
        sums.into_iter().map(|sum| sum.map(f64::sqrt)).collect()
    }

    /// The norms of `values` relative to those of the emission, channel by channel; 0 where it is
    /// dark.
    pub(crate) fn ratios(&self, values: impl Fn(usize) -> Rgb) -> Vec<f64> {
        let norms = self.norms_of(values).into_flattened().into_iter();
        let ratios = norms.zip(self.norms.as_flattened());
        ratios
            .map(|(norm, &of_emission)| ratio(norm, of_emission))
            .collect()
    }

    /// The largest of them.
    pub(crate) fn relative(&self, values: impl Fn(usize) -> Rgb) -> f64 {
        worst(self.ratios(values))
    }

    /// What is reflected of what arrives.
    pub(crate) fn reflected(&self, irradiance: &Values<f64>) -> Values<f32> {
        let at = |(k, arrives): (usize, &Rgb)| -> Triple<f32> {
            let rho = &self.reflectance[k / self.lights()];
            std::array::from_fn(|c| (rho[c] * arrives[c]) as f32)
        };
        irradiance.iter().enumerate().map(at).collect()
    }

    /// Radiosities in W/m^2, light by light.
    pub(crate) fn to_lights(&self, x: &[Triple<f32>]) -> Vec<Vec<Triple<f32>>> {
        let in_watts = |x: &Triple<f32>, unit: &Rgb| -> Triple<f32> {
            std::array::from_fn(|c| (f64::from(x[c]) * unit[c]) as f32)
        };
        let light = |(k, unit): (usize, &Rgb)| {
            let values = x.iter().skip(k).step_by(self.lights());
            values.map(|x| in_watts(x, unit)).collect()
        };
        self.units.iter().enumerate().map(light).collect()
    }

    /// Whether nothing shines.
    pub(crate) fn is_dark(&self) -> bool {
        self.norms.as_flattened().iter().all(|&norm| norm == 0.0)
    }

    /// `E_i + rho_i H_i - x_i` at one index, where `H` arrives.
    pub(crate) fn residual_at(&self, k: usize, irradiance: &Rgb, x: &Triple<f32>) -> Rgb {
        let (emission, rho) = (&self.emission[k], &self.reflectance[k / self.lights()]);
        let [emission, x] = [emission, x].map(|values| values.map(f64::from));
        std::array::from_fn(|c| emission[c] + rho[c] * irradiance[c] - x[c])
    }

    /// `H_i = sum_j F_ij x_j`: what arrives where `x` leaves.
    pub(crate) fn irradiance(&self, x: &[Triple<f32>]) -> Values<f64> {
        self.exchange.product(x, self.lights())
    }
}

/// A part relative to the whole, of which nothing is worth nothing.
pub(crate) fn ratio(part: f64, whole: f64) -> f64 {
    if whole == 0.0 { 0.0 } else { part / whole }
}

/// The largest of some numbers. What is not a number is the worst.
pub(crate) fn worst(numbers: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |a: f64, b: f64| if a >= b || a.is_nan() { a } else { b };
    numbers.into_iter().fold(0.0, larger)
}

/// The largest emission of each channel, or 1.
fn units_of(light: &[Rgb]) -> Rgb {
    let largest = |c: usize| light.iter().map(|e| e[c]).fold(0.0, f64::max);
    [0, 1, 2]
        .map(largest)
        .map(|unit| if unit > 0.0 { unit } else { 1.0 })
}
