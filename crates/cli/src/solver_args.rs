//! How to solve, on the command line.

use super::choices::{METHODS, choice};
use super::parse::number_or_word;
use super::parse::parse_number;
use super::scene_args::set;
use super::terminal::tell;
use clap::Args;
use radiosity::solver::{Method, Params, Relaxation};

/// How to solve, and when to stop.
#[derive(Debug, Args)]
#[command(next_help_heading = "Solution")]
pub struct SolveArgs {
    /// How to solve [default: the scene's, or gauss-seidel]
    #[arg(long, value_parser = choice::<Method>(&METHODS))]
    pub solver: Option<Method>,
    /// Factor on each change of Gauss-Seidel, between 0 and 2, or auto: what the convergence of the
    /// first sweeps suggests; 1 is plain Gauss-Seidel [default: the
    /// scene's, or auto]
    #[arg(
        long,
        value_name = "X|auto",
        value_parser = number_or_word::<Relaxation>,
        allow_negative_numbers = true,
    )]
    pub relaxation: Option<Relaxation>,
    /// Relative residual at which the solver stops [default: the scene's, or 1e-6]
    #[arg(long, value_name = "X", value_parser = parse_number, allow_negative_numbers = true)]
    pub residual: Option<f64>,
    /// Most passes over the matrix to take [default: the scene's, or 200]
    #[arg(long, value_name = "N")]
    pub max_sweeps: Option<u32>,
}

impl SolveArgs {
    pub(super) fn apply(&self, params: &mut Params) {
        set(&mut params.method, self.solver);
        set(&mut params.relaxation, self.relaxation);
        set(&mut params.residual, self.residual);
        set(&mut params.max_sweeps, self.max_sweeps);
        if self.relaxation.is_some() && params.method == Method::ConjugateGradients {
            tell("warning: --relaxation is for gauss-seidel, and changes nothing");
        }
    }
}
