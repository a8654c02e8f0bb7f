//! Turns form factors, emission and reflectance into the radiosities ([`Solution`]) by
//! Gauss-Seidel iteration.
//!
//! The equation, per channel (Cohen & Wallace, "Radiosity and Realistic Image Synthesis",
//! 1993, eq. 3.19), all quantities radiant exitances in W/m^2:
//!
//! ```text
//! B_i = E_i + rho_i sum_j F_ij B_j ,   F_ij = S_ij / A_i
//! ```
//!
//! This crate knows nothing of geometry, names or files: errors carry patch indices.

mod energy;
mod gauss_seidel;
mod power_iteration;
mod system;

#[cfg(test)]
mod tests;

pub use energy::Energy;
pub use gauss_seidel::{Convergence, Params, Solution, SolveError, solve};
pub use system::System;

/// Raise it whenever the same input would give another solution: it is part of its key.
pub const VERSION: u32 = 1;

/// Red, green, blue.
pub type Rgb = [f64; 3];
