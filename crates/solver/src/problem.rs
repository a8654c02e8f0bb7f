//! A system as the methods see it: lights side by side, in units in which numbers are ordinary.

use crate::{Rgb, System};
use radiosity_matrix::{SymmetricMatrix, Triple};

/// Values of all lights at all patches: those of light `k` at patch `i` are at
/// `i * lights + k`.
pub(crate) type Values<T> = Vec<Triple<T>>;

/// Relative changes below this may change nothing, in single precision.
pub(crate) const LOST: f64 = 1.0 / (1 << 24) as f64;

/// `x_i = E_i + gain_i sum_j S_ij x_j`, for each channel of each light in units of its own largest
/// emission: channels know nothing of each other, and no square overflows or vanishes, however
/// bright or faint one of them is.
pub(crate) struct Problem<'a> {
    pub(crate) exchange: &'a SymmetricMatrix,
    /// Areas that exchange light, relative to the total of all.
    pub(crate) areas: Vec<f64>,
    /// `rho_i / A_i`, with those areas, per patch.
    pub(crate) gain: Vec<Rgb>,
    /// Rounded to what radiosities can be, so that black patches have no residual, and those that
    /// reflect next to nothing none but what they reflect: conjugate gradients weight residuals by
    /// `1 / gain`.
    pub(crate) emission: Values<f32>,
    /// What the numbers of each light are multiples of, in W/m^2.
    pub(crate) units: Vec<Rgb>,
    /// The norm of each light's emission.
    norms: Vec<Rgb>,
}

impl<'a> Problem<'a> {
    pub(crate) fn new(system: &System<'a>) -> Problem<'a> {
        let total = system.total_area();
        let area = |i: usize| system.visible_area(i) / total;
        let areas: Vec<f64> = (0..system.size()).map(area).collect();
        let gain = |(rho, &area): (&Rgb, &f64)| rho.map(|rho| ratio(rho, area));
        let gain = system.reflectance.iter().zip(&areas).map(gain).collect();
        let units: Vec<Rgb> = system.lights.iter().map(|light| units_of(light)).collect();
        let at = |i: usize| {
            let lights = system.lights.iter().zip(&units);
            lights.map(move |(light, unit)| std::array::from_fn(|c| (light[i][c] / unit[c]) as f32))
        };
        let emission: Values<f32> = (0..system.size()).flat_map(at).collect();
        let mut problem = Problem {
            exchange: system.exchange,
            areas,
            gain,
            emission,
            units,
            norms: Vec::new(),
        };
        problem.norms = problem.norms_of(|k| problem.emission[k].map(f64::from));
        problem
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

    /// What is reflected where sums arrive.
    pub(crate) fn reflected(&self, sums: &[Values<f64>; 2]) -> Values<f32> {
        let at = |k: usize| -> Triple<f32> {
            let (sum, gain) = (joined(sums, k), &self.gain[k / self.lights()]);
            std::array::from_fn(|c| (gain[c] * sum[c]) as f32)
        };
        (0..self.emission.len()).map(at).collect()
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

    /// `E_i + gain_i sum_j S_ij x_j - x_i` at one index, of which the sum is given.
    pub(crate) fn residual_at(&self, k: usize, sum: &Rgb, x: &Triple<f32>) -> Rgb {
        let (emission, gain) = (&self.emission[k], &self.gain[k / self.lights()]);
        let [emission, x] = [emission, x].map(|values| values.map(f64::from));
        std::array::from_fn(|c| emission[c] + gain[c] * sum[c] - x[c])
    }

    /// `sum_j S_ij x_j`, in two parts: over `j < i` and over `j > i`.
    pub(crate) fn sums(&self, x: &mut [Triple<f32>]) -> [Values<f64>; 2] {
        let lights = self.lights();
        let mut above = Values::with_capacity(x.len());
        let below = self.exchange.sweep(x, lights, &mut |_, sums, _| {
            above.extend_from_slice(sums);
        });
        [above, below]
    }
}

/// A sum of which both parts are known.
pub(crate) fn joined([above, below]: &[Values<f64>; 2], k: usize) -> Rgb {
    std::array::from_fn(|c| above[k][c] + below[k][c])
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
