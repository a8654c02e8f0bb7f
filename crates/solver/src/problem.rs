//! A system as the methods see it: lights side by side, in units in which numbers are ordinary.

use crate::{Rgb, System};
use radiosity_matrix::{SymmetricMatrix, Triple};

/// Values of all lights at all patches: those of light `k` at patch `i` are at
/// `i * lights + k`.
pub(crate) type Values<T> = Vec<Triple<T>>;

/// `x_i = E_i + gain_i sum_j S_ij x_j`, for each light in units of its largest emission, so that
/// no square of an ordinary number overflows or vanishes.
pub(crate) struct Problem<'a> {
    pub(crate) exchange: &'a SymmetricMatrix,
    /// Areas that exchange light, relative to the total of all.
    pub(crate) areas: Vec<f64>,
    /// `rho_i / A_i`, with those areas, per patch.
    pub(crate) gain: Vec<Rgb>,
    pub(crate) emission: Values<f64>,
    /// What the numbers of each light are multiples of, in W/m^2.
    pub(crate) units: Vec<f64>,
    /// The norm of each light's emission.
    norms: Vec<f64>,
}

impl<'a> Problem<'a> {
    pub(crate) fn new(system: &System<'a>) -> Problem<'a> {
        let total = system.total_area();
        let area = |i: usize| system.visible_area(i) / total;
        let areas: Vec<f64> = (0..system.size()).map(area).collect();
        let gain = |(rho, &area): (&Rgb, &f64)| rho.map(|rho| rho / area);
        let gain = system.reflectance.iter().zip(&areas).map(gain).collect();
        let unit = |light: &Vec<Rgb>| {
            let largest = light.iter().flatten().copied().fold(0.0, f64::max);
            if largest > 0.0 { largest } else { 1.0 }
        };
        let units: Vec<f64> = system.lights.iter().map(unit).collect();
        let at = |i: usize| {
            let lights = system.lights.iter().zip(&units);
            lights.map(move |(light, unit)| light[i].map(|channel| channel / unit))
        };
        let emission: Values<f64> = (0..system.size()).flat_map(at).collect();
        let mut problem = Problem {
            exchange: system.exchange,
            areas,
            gain,
            emission,
            units,
            norms: Vec::new(),
        };
        problem.norms = problem.norms_of(|k| problem.emission[k]);
        problem
    }

    /// How many lights there are.
    pub(crate) fn lights(&self) -> usize {
        self.units.len()
    }

    /// Of each light, the area-weighted L2 norm over patches and channels of `values`, which is
    /// asked by index.
    pub(crate) fn norms_of(&self, values: impl Fn(usize) -> Rgb) -> Vec<f64> {
        let mut sums = vec![0.0; self.lights()];
        for (i, area) in self.areas.iter().enumerate() {
            for (light, sum) in sums.iter_mut().enumerate() {
                let value = values(i * self.lights() + light);
                *sum += area * value.iter().map(|c| c * c).sum::<f64>();
            }
        }
        sums.into_iter().map(f64::sqrt).collect()
    }

    /// The largest norm of a light's `values` relative to that of its emission; lights that are
    /// dark count as nothing.
    pub(crate) fn relative(&self, values: impl Fn(usize) -> Rgb) -> f64 {
        let ratios = self.norms_of(values).into_iter().zip(&self.norms);
        worst(ratios.map(|(norm, &of_emission)| (norm, of_emission)))
    }

    /// The radiosities of which the emission is known alone.
    pub(crate) fn emitted(&self) -> Values<f32> {
        let to_f32 = |e: &Rgb| e.map(|channel| channel as f32);
        self.emission.iter().map(to_f32).collect()
    }

    /// What is reflected where sums arrive.
    pub(crate) fn reflected(&self, sums: &[Values<f64>; 2]) -> Values<f32> {
        let at = |k: usize| -> Triple<f32> {
            let (sum, gain) = (joined(sums, k), &self.gain[k / self.lights()]);
            std::array::from_fn(|c| (gain[c] * sum[c]) as f32)
        };
        (0..self.emission.len()).map(at).collect()
    }

    /// Radiosities in W/m^2, light by light, as the methods see them.
    pub(crate) fn of_lights(&self, lights: &[Vec<Triple<f32>>]) -> Values<f32> {
        assert_eq!(lights.len(), self.lights(), "radiosities of each light");
        let at = |(k, emission): (usize, &Triple<f64>)| -> Triple<f32> {
            let (i, light) = (k / self.lights(), k % self.lights());
            let gain = &self.gain[i];
            std::array::from_fn(|c| {
                let start = (f64::from(lights[light][i][c]) / self.units[light]) as f32;
                // Dark lights stay dark, black patches are known, and the other solution may have
                // been in units out of reach.
                let is_usable = self.norms[light] > 0.0 && gain[c] > 0.0 && start.is_finite();
                if is_usable { start } else { emission[c] as f32 }
            })
        };
        self.emission.iter().enumerate().map(at).collect()
    }

    /// The same the other way round.
    pub(crate) fn to_lights(&self, x: &[Triple<f32>]) -> Vec<Vec<Triple<f32>>> {
        let in_watts = |x: &Triple<f32>, unit: f64| x.map(|x| (f64::from(x) * unit) as f32);
        let light = |(k, &unit): (usize, &f64)| {
            let values = x.iter().skip(k).step_by(self.lights());
            values.map(|x| in_watts(x, unit)).collect()
        };
        self.units.iter().enumerate().map(light).collect()
    }

    /// Whether nothing shines.
    pub(crate) fn is_dark(&self) -> bool {
        self.norms.iter().all(|&norm| norm == 0.0)
    }

    /// `E_i + gain_i sum_j S_ij x_j - x_i` at one index, of which the sum is given.
    pub(crate) fn residual_at(&self, k: usize, sum: &Rgb, x: &Triple<f32>) -> Rgb {
        let (emission, gain) = (&self.emission[k], &self.gain[k / self.lights()]);
        std::array::from_fn(|c| emission[c] + gain[c] * sum[c] - f64::from(x[c]))
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

/// The largest of some ratios, of which those to nothing do not count. What is not a number is the
/// worst.
pub(crate) fn worst(ratios: impl Iterator<Item = (f64, f64)>) -> f64 {
    let larger = |a: f64, b: f64| if a >= b || a.is_nan() { a } else { b };
    ratios
        .filter(|&(_, whole)| whole != 0.0)
        .map(|(part, whole)| part / whole)
        .fold(0.0, larger)
}
