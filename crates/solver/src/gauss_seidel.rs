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
    /// Relative residual after each sweep.
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
    let norm_of_emission = system.norm(system.emission.iter().copied());
    let mut iteration = Iteration::start(system);
    let mut residuals = Vec::new();
    let mut converged = norm_of_emission == 0.0;
    while !converged && residuals.len() < params.max_sweeps as usize {
        let residual = iteration.sweep() / norm_of_emission;
        progress(residual);
        residuals.push(residual);
        converged = residual <= params.tolerance;
        if !residual.is_finite() {
            return Err(explain_non_finite(system));
        }
        if is_growing(&residuals) {
            check_spectral_radius(system)?;
        }
    }
    if !converged {
        check_spectral_radius(system)?;
    }
    let radiosity: Vec<Rgb> = iteration.x.iter().copied().map(rgb).collect();
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
        let x: Vec<Lanes> = system.emission.iter().copied().map(lanes).collect();
        let mut below = vec![[0.0; 4]; system.size()];
        for (i, row) in system.exchange.rows() {
            scatter(row, &x[i], &mut below);
        }
        Iteration {
            system,
            x,
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
            let emission = lanes(self.system.emission[i]);
            for (c, x_i) in self.x[i].iter_mut().enumerate() {
                *x_i = emission[c] + self.gain[i][c] * sum[c];
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
}

/// Adds `S_ij x_i` to the sums of all rows `j` above row `i`.
fn scatter(row: &[f32], x_i: &Lanes, below: &mut [Lanes]) {
    for (&s, sum) in row.iter().zip(below) {
        add_scaled(sum, f64::from(s), x_i);
    }
}

fn is_growing(residuals: &[f64]) -> bool {
    residuals.len().is_multiple_of(SUSPICIOUS_GROWTH)
        && residuals
            .last_chunk::<SUSPICIOUS_GROWTH>()
            .is_some_and(|last| last.is_sorted() && last[0] < last[SUSPICIOUS_GROWTH - 1])
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

fn explain_non_finite(system: &System<'_>) -> SolveError {
    let sums = system.exchange.row_sums();
    let is_bad = |&i: &usize| {
        let finite = |rgb: Rgb| rgb.iter().all(|c| c.is_finite());
        !(sums[i].is_finite() && finite(system.emission[i]) && finite(system.reflectance[i]))
    };
    match (0..system.size()).find(is_bad) {
        Some(patch) => SolveError::NotFinite { patch },
        None => SolveError::Diverges {
            spectral_radius: f64::INFINITY,
            worst_patches: Vec::new(),
        },
    }
}
