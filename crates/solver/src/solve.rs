//! Stage 3: passes until the residual is small enough.

use crate::conjugate_gradients::ConjugateGradients;
use crate::convergence::Progress;
use crate::diagnosis::{self, SolveError};
use crate::gauss_seidel::{GaussSeidel, Relaxation};
use crate::problem::{Problem, Values};
use crate::{Convergence, Energy, Solution, System};
use serde::{Deserialize, Serialize};

/// How to solve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Method {
    /// Row after row, with the newest values of all others.
    GaussSeidel(Relaxation),
    /// The fewest passes where light is reflected often.
    ConjugateGradients,
}

impl Method {
    /// The reference and its rivals, with their names, for whoever sets them side by side.
    pub const RIVALS: [(&'static str, Method); 3] = [
        ("Gauss-Seidel", Method::GaussSeidel(Relaxation::Factor(1.0))),
        (
            "over-relaxation",
            Method::GaussSeidel(Relaxation::Automatic),
        ),
        ("conjugate gradients", Method::ConjugateGradients),
    ];
}

/// How to solve, and when to stop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Params {
    /// The method.
    pub method: Method,
    /// Relative residual `||E + rho F B - B|| / ||E||` to reach (area-weighted L2 norm over
    /// patches) in each channel of each light. Below some 1e-7, single precision has no better
    /// solution.
    pub tolerance: f64,
    /// Most passes over the matrix to take.
    pub max_passes: u32,
}

impl Default for Params {
    fn default() -> Params {
        Params {
            method: Method::GaussSeidel(Relaxation::Automatic),
            tolerance: 1e-6,
            max_passes: 200,
        }
    }
}

/// A method on its way.
pub(crate) trait Iteration {
    /// Takes one pass over the matrix (conjugate gradients take one more to be sure of the last).
    fn advance(&mut self) -> Progress;

    /// See [`Convergence::relaxation`].
    fn relaxation(&self) -> Option<f64>;

    /// The values, and their `sum_j S_ij x_j`.
    fn finish(self: Box<Self>) -> (Values<f32>, Values<f64>);
}

/// Solves the system for all lights, from `B = E` on. `progress` is told the residual after each
/// pass.
///
/// # Errors
///
/// If there is no solution, or one that single precision does not hold, or if the input has numbers
/// that are none.
pub fn solve(
    system: &System<'_>,
    params: &Params,
    progress: &mut dyn FnMut(f64),
) -> Result<Solution, SolveError> {
    diagnosis::check_materials(system)?;
    let problem = Problem::new(system);
    let mut x = problem.emission.clone();
    let sums = problem.sums(&mut x);
    let direct = problem.to_lights(&problem.reflected(&sums));
    let mut iteration: Box<dyn Iteration + '_> = match params.method {
        Method::GaussSeidel(relaxation) => {
            Box::new(GaussSeidel::new(&problem, (x, sums), relaxation))
        }
        Method::ConjugateGradients => Box::new(ConjugateGradients::new(
            &problem,
            (x, sums),
            params.tolerance,
        )),
    };
    let mut residuals: Vec<f64> = Vec::new();
    let (mut converged, mut stalled, mut error) = (problem.is_dark(), false, None);
    while !converged && !stalled && residuals.len() < params.max_passes as usize {
        let reached = iteration.advance();
        progress(reached.residual);
        residuals.push(reached.residual);
        converged = reached.residual <= params.tolerance;
        stalled = !converged && reached.stalled;
        error = reached.error;
        if reached.suspicious || diagnosis::is_growing(&residuals) {
            diagnosis::check_numbers(system)?;
            diagnosis::check_spectral_radius(system)?;
        }
    }
    let last = residuals.last().copied().unwrap_or(0.0);
    let is_lost = match stalled {
        true => last > diagnosis::FAR,
        false => !diagnosis::is_falling(&residuals),
    };
    if !converged && is_lost {
        diagnosis::check_spectral_radius(system)?;
    }
    let relaxation = iteration.relaxation();
    let (x, sums) = iteration.finish();
    let residual = problem.relative(|k| problem.residual_at(k, &sums[k], &x[k]));
    let lights = problem.to_lights(&x);
    diagnosis::check_radiosities(lights.iter().map(Vec::as_slice))?;
    if !converged && residual > diagnosis::WORTHLESS {
        return Err(SolveError::Worthless { residual });
    }
    diagnosis::check_radiosities(direct.iter().map(Vec::as_slice))?;
    Ok(Solution {
        report: Convergence {
            method: params.method,
            converged,
            stalled,
            residual,
            residuals,
            error,
            relaxation,
            energies: Energy::of_lights(system, &problem, &x, &sums),
        },
        lights,
        direct,
    })
}
