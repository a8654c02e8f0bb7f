//! Stage 3: Gauss-Seidel on the stored half of the matrix.
//!
//! A sweep solves row after row for its own unknown, with the newest values of all others.
//! Each stored number `S_ij` (`j < i`) is read once per sweep and used for both of its rows:
//! in row `i` with the new `x_j`, and for row `j` of the *next* sweep with the new `x_i`. What
//! row `i` gets from the rows below it is thus known before the sweep begins. When the sweep
//! ends, the same sums with the new values are known, and their difference is the exact
//! residual: `r_i = rho_i / A_i * (below_new - below_old)`.

use crate::Rgb;
use crate::energy::Energy;
use crate::power_iteration::spectral_radius;
use crate::system::{Lanes, System, add_scaled, lanes, rgb};
use serde::{Deserialize, Serialize};

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Params {
    /// Relative residual `||E + rho F B - B|| / ||E||` to reach (area-weighted L2 norm over
    /// patches and channels).
    pub tolerance: f64,
    /// Most sweeps to take.
    pub max_sweeps: u32,
}

impl Default for Params {
    fn default() -> Params {
        Params {
            tolerance: 1e-6,
            max_sweeps: 200,
        }
    }
}

/// The radiosities, and how they were reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Radiosity `B` of each patch, radiant exitance in W/m^2.
    pub radiosity: Vec<[f32; 3]>,
    /// The course of the iteration.
    pub report: Convergence,
}

/// The course of an iteration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Convergence {
    /// Whether the tolerance was reached within the allowed sweeps.
    pub converged: bool,
    /// Relative residual after each sweep, in `f64`. Storing radiosities as `f32` rounds the last
    /// of them by up to 6e-8 of their size.
    pub residuals: Vec<f64>,
    /// The power balance of the solution.
    pub energy: Energy,
}

impl Convergence {
    /// The residual of the solution.
    pub fn residual(&self) -> f64 {
        self.residuals.last().copied().unwrap_or(0.0)
    }
}

/// Why there is no solution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// Every bounce makes more light than it received.
    #[error(
        "the system has no solution: each bounce multiplies the light by {spectral_radius:.3} \
         (spectral radius of reflectance times form factors; it must be below 1)"
    )]
    Diverges {
        /// The factor by which light grows per bounce.
        spectral_radius: f64,
        /// The patches whose row sum times reflectance is largest, the worst first.
        worst_patches: Vec<usize>,
    },
    /// A number in the input is NaN or infinite.
    #[error("patch {patch} has a form factor, emission or reflectance that is not finite")]
    NotFinite {
        /// The first such patch.
        patch: usize,
    },
}

/// Sweeps over which the residual must grow before divergence is suspected.
const SUSPICIOUS_GROWTH: usize = 4;
/// How many of the worst patches an error names.
const NAMED_PATCHES: usize = 8;

/// Solves the system from `B = E`. `progress` is told the residual after each sweep.
pub fn solve(
    system: &System<'_>,
    params: &Params,
    progress: &mut dyn FnMut(f64),
) -> Result<Solution, SolveError> {
    check_finite(system)?;
    let mut iteration = Iteration::start(system);
    let norm_of_emission = system.norm(iteration.emission.iter().copied().map(rgb));
    let mut residuals: Vec<f64> = Vec::new();
    let mut converged = norm_of_emission == 0.0;
    while !converged && residuals.len() < params.max_sweeps as usize {
        let residual = iteration.sweep() / norm_of_emission;
        progress(residual);
        residuals.push(residual);
        converged = residual <= params.tolerance;
        if is_growing(&residuals) {
            check_spectral_radius(system)?;
        }
    }
    if !converged {
        check_spectral_radius(system)?;
    }
    let radiosity: Vec<Rgb> = iteration.radiosity();
    let report = Convergence {
        converged,
        residuals,
        energy: Energy::of(system, &radiosity),
    };
    let to_f32 = |b: Rgb| b.map(|channel| channel as f32);
    Ok(Solution {
        radiosity: radiosity.into_iter().map(to_f32).collect(),
        report,
    })
}

struct Iteration<'a> {
    system: &'a System<'a>,
    /// The largest emission. Everything here is in units of it, so that no square of an
    /// ordinary number overflows or vanishes.
    unit: f64,
    emission: Vec<Lanes>,
    /// The current radiosities.
    x: Vec<Lanes>,
    /// `sum_{j > i} S_ij x_j` for the values of the last sweep.
    below: Vec<Lanes>,
    /// What a row's exchange sums are multiplied by: `rho_i / A_i`, areas relative to the total.
    gain: Vec<Lanes>,
}

impl<'a> Iteration<'a> {
    fn start(system: &'a System<'a>) -> Iteration<'a> {
        let total = system.total_area();
        let gain = |(&rho, &area): (&Rgb, &f64)| lanes(rho.map(|rho| rho * total / area));
        let largest = system
            .emission
            .iter()
            .flatten()
            .copied()
            .fold(0.0, f64::max);
        let unit = if largest > 0.0 { largest } else { 1.0 };
        let in_units = |e: &Rgb| lanes(e.map(|channel| channel / unit));
        let emission: Vec<Lanes> = system.emission.iter().map(in_units).collect();
        let mut below = vec![[0.0; 4]; system.size()];
        for (i, row) in system.exchange.rows() {
            scatter(row, &emission[i], &mut below);
        }
        Iteration {
            system,
            unit,
            x: emission.clone(),
            emission,
            below,
            gain: system
                .reflectance
                .iter()
                .zip(system.areas)
                .map(gain)
                .collect(),
        }
    }

    /// One sweep; returns the norm of the residual of the new values.
    fn sweep(&mut self) -> f64 {
        let mut below_new = vec![[0.0; 4]; self.x.len()];
        for (i, row) in self.system.exchange.rows() {
            let mut sum = self.below[i];
            for (&s, x_j) in row.iter().zip(&self.x) {
                add_scaled(&mut sum, f64::from(s), x_j);
            }
            for (c, x_i) in self.x[i].iter_mut().enumerate() {
                *x_i = self.emission[i][c] + self.gain[i][c] * sum[c];
            }
            scatter(row, &self.x[i], &mut below_new);
        }
        let residual = |i: usize| {
            let change = |c: usize| self.gain[i][c] * (below_new[i][c] - self.below[i][c]);
            [change(0), change(1), change(2)]
        };
        let norm = self.system.norm((0..self.x.len()).map(residual));
        self.below = below_new;
        norm
    }

    fn radiosity(&self) -> Vec<Rgb> {
        let in_watts = |&x: &Lanes| rgb(x).map(|channel| channel * self.unit);
        self.x.iter().map(in_watts).collect()
    }
}

/// Adds `S_ij x_i` to the sums of all rows `j` above row `i`.
fn scatter(row: &[f32], x_i: &Lanes, below: &mut [Lanes]) {
    for (&s, sum) in row.iter().zip(below) {
        add_scaled(sum, f64::from(s), x_i);
    }
}

/// Whether the residual grew over several sweeps, looked at once every few of them, or is so
/// large that it is no number any more.
fn is_growing(residuals: &[f64]) -> bool {
    let Some(last) = residuals.last_chunk::<SUSPICIOUS_GROWTH>() else {
        return false;
    };
    let grew = last.is_sorted() && last[0] < last[SUSPICIOUS_GROWTH - 1];
    let looked_at = residuals.len().is_multiple_of(SUSPICIOUS_GROWTH);
    looked_at && grew || !last[SUSPICIOUS_GROWTH - 1].is_finite()
}

fn check_spectral_radius(system: &System<'_>) -> Result<(), SolveError> {
    let spectral_radius = spectral_radius(system);
    if spectral_radius < 1.0 {
        return Ok(());
    }
    let total = system.total_area();
    let sums = system.exchange.row_sums();
    let reflected = |i: usize| {
        let strongest = system.reflectance[i].into_iter().fold(0.0, f64::max);
        strongest * sums[i] * total / system.areas[i]
    };
    let mut worst_patches: Vec<usize> = (0..system.size()).collect();
    worst_patches.sort_by(|&a, &b| reflected(b).total_cmp(&reflected(a)));
    worst_patches.truncate(NAMED_PATCHES);
    Err(SolveError::Diverges {
        spectral_radius,
        worst_patches,
    })
}

fn check_finite(system: &System<'_>) -> Result<(), SolveError> {
    let sums = system.exchange.row_sums();
    let is_bad = |&i: &usize| {
        let finite = |rgb: Rgb| rgb.iter().all(|c| c.is_finite());
        !(sums[i].is_finite() && finite(system.emission[i]) && finite(system.reflectance[i]))
    };
    match (0..system.size()).find(is_bad) {
        Some(patch) => Err(SolveError::NotFinite { patch }),
        None => Ok(()),
    }
}
