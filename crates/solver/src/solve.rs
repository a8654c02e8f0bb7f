//! Stage 3: passes until the residual is small enough.

use crate::conjugate_gradients::ConjugateGradients;
use crate::convergence::Progress;
use crate::diagnosis::{self, SolveError};
use crate::gauss_seidel::GaussSeidel;
use crate::params::{Method, Params};
use crate::scaled_system::{ScaledSystem, Values};
use crate::{Convergence, Power, Solution, System};
use std::rc::Rc;

/// A method on its way.
pub(crate) trait IterativeMethod {
    /// Takes one pass over the matrix (conjugate gradients take one more to be sure of the last).
    fn advance(&mut self) -> Progress;

    /// See [`Convergence::relaxation`].
    fn relaxation(&self) -> Option<f64>;

    /// The values, and what arrives where they leave.
    fn finish(self: Box<Self>) -> (Values<f32>, Values<f64>);
}

/// Solves the system for all lights, from `B = E` on.
///
/// ```
/// use radiosity_matrix::{DenseExchange, SymmetricMatrix};
/// use radiosity_solver::{Params, System, solve};
///
/// // Two patches of area 1 that see nothing but each other: A F / (total area) = 1/2.
/// let matrix = SymmetricMatrix::new(2, vec![0.5])?;
/// let system = System {
///     exchange: &DenseExchange::new(matrix, vec![1.0, 1.0]),
///     reflectance: &[[0.0; 3], [0.5; 3]],
///     lights: &[vec![[1.0; 3], [0.0; 3]]],
/// };
/// let solution = solve(&system, &Params::default())?;
/// assert_eq!(solution.lights[0], [[1.0; 3], [0.5; 3]]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If there is no solution, or one that single precision does not hold, or if the input has numbers
/// that are none.
pub fn solve(system: &System<'_>, params: &Params) -> Result<Solution, SolveError> {
    let mut solver = Solver::new(system, params)?;
    while solver.advance()?.is_some() {}
    solver.finish()
}

/// [`solve`] pass by pass, to show progress.
pub struct Solver<'a> {
    system: &'a System<'a>,
    params: Params,
    scaled: Rc<ScaledSystem<'a>>,
    iteration: Box<dyn IterativeMethod + 'a>,
    direct: Vec<Vec<[f32; 3]>>,
    residuals: Vec<f64>,
    error: Option<f64>,
    converged: bool,
    stalled: bool,
}

impl<'a> Solver<'a> {
    /// Begins at `B = E`.
    pub fn new(system: &'a System<'a>, params: &Params) -> Result<Solver<'a>, SolveError> {
        diagnosis::check_materials(system)?;
        let scaled = Rc::new(ScaledSystem::new(system));
        let shared = Rc::clone(&scaled);
        let (iteration, irradiance): (Box<dyn IterativeMethod + 'a>, Values<f64>) =
            match params.method {
                Method::GaussSeidel => {
                    let rows = system.exchange.rows().ok_or(SolveError::NoRows)?;
                    let start = GaussSeidel::new(shared, rows, params.relaxation);
                    let irradiance = start.irradiance();
                    (Box::new(start), irradiance)
                }
                Method::ConjugateGradients => {
                    let irradiance = scaled.irradiance(&scaled.emission);
                    let start = ConjugateGradients::new(shared, &irradiance, params.residual);
                    (Box::new(start), irradiance)
                }
            };
        let direct = scaled.to_lights(&scaled.reflected(&irradiance));
        Ok(Solver {
            system,
            params: *params,
            converged: scaled.is_dark(),
            scaled,
            iteration,
            direct,
            residuals: Vec::new(),
            error: None,
            stalled: false,
        })
    }

    /// Takes one pass over the matrix and tells the residual after it; `None` if there is nothing
    /// to be done any more.
    pub fn advance(&mut self) -> Result<Option<f64>, SolveError> {
        let is_over = self.residuals.len() >= self.params.max_sweeps as usize;
        if self.converged || self.stalled || is_over {
            return Ok(None);
        }
        let reached = self.iteration.advance();
        self.residuals.push(reached.residual);
        self.converged = reached.residual <= self.params.residual;
        self.stalled = !self.converged && reached.stalled;
        self.error = reached.error;
        if reached.suspicious || diagnosis::is_growing(&self.residuals) {
            diagnosis::check_numbers(self.system)?;
            diagnosis::check_spectral_radius(self.system)?;
        }
        Ok(Some(reached.residual))
    }

    /// The solution as far as it is.
    pub fn finish(self) -> Result<Solution, SolveError> {
        let (system, scaled) = (self.system, self.scaled);
        let last = self.residuals.last().copied().unwrap_or(0.0);
        let is_lost = match self.stalled {
            true => last > diagnosis::FAR,
            false => !diagnosis::is_falling(&self.residuals),
        };
        if !self.converged && is_lost {
            diagnosis::check_spectral_radius(system)?;
        }
        let relaxation = self.iteration.relaxation();
        let (x, irradiance) = self.iteration.finish();
        let residual = scaled.relative(|k| scaled.residual_at(k, &irradiance[k], &x[k]));
        let lights = scaled.to_lights(&x);
        diagnosis::check_radiosities(lights.iter().map(Vec::as_slice))?;
        if !self.converged && residual > diagnosis::WORTHLESS {
            return Err(SolveError::Worthless { residual });
        }
        diagnosis::check_radiosities(self.direct.iter().map(Vec::as_slice))?;
        Ok(Solution {
            report: Convergence {
                method: self.params.method,
                converged: self.converged,
                stalled: self.stalled,
                residual,
                residuals: self.residuals,
                error: self.error,
                relaxation,
                powers: Power::of_lights(system, &scaled, &irradiance),
            },
            lights,
            direct: self.direct,
        })
    }
}
