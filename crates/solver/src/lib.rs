//! Turns form factors, emission and reflectance into the radiosities ([`Solution`]).
//!
//! The equation, per channel (Cohen & Wallace, "Radiosity and Realistic Image Synthesis",
//! 1993, eq. 3.19), all quantities radiant exitances in W/m^2:
//!
//! ```text
//! B_i = E_i + rho_i sum_j F_ij B_j
//! ```
//!
//! It is linear in the emission, so it is solved for each light by itself, all in the same passes
//! over the matrix, and a lamp that is dimmed afterwards needs no new solution
//! ([`superpose`]). Each method is one file: [`Method::GaussSeidel`], with over-relaxation,
//! and [`Method::ConjugateGradients`]; all share the operator
//! ([`radiosity_matrix::Exchange`]) and the report ([`Convergence`]).
//!
//! This crate knows nothing of geometry, names or files: errors carry patch indices.

mod channel;
mod conjugate_gradients;
mod convergence;
mod diagnosis;
mod gauss_seidel;
mod params;
mod power;
mod power_iteration;
mod scaled_system;
mod solution;
mod solve;
mod system;

#[cfg(test)]
mod tests;

pub use convergence::Convergence;
pub use diagnosis::{SolveError, check_radiosities};
pub use params::{Method, Params, Relaxation};
pub use power::Power;
pub use solution::{Solution, superpose};
pub use solve::{Solver, solve};
pub use system::System;

/// Raise it whenever the same input would give another solution: it is part of its key.
pub const VERSION: u32 = 9;

/// Red, green, blue.
pub type Rgb = [f64; 3];
