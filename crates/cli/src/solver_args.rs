//! How to solve, on the command line.

use super::choices::SolverArg;
use super::parse::{parse_relaxation, parse_tolerance};
use clap::Args;
use radiosity::scene::{Relaxation, Scene, SolverMethod};

/// How to solve, and when to stop.
#[derive(Debug, Args)]
#[command(next_help_heading = "Solution")]
pub struct SolveArgs {
    /// How to solve [default: gauss-seidel]
    #[arg(long, value_enum)]
    pub solver: Option<SolverArg>,
    /// Factor by which Gauss-Seidel overdoes each change, between 0 and 2, or auto: by what the
    /// first sweeps suggest; 1 is plain Gauss-Seidel [default: auto]
    #[arg(long, value_name = "X|auto", value_parser = parse_relaxation, allow_negative_numbers = true)]
    pub relaxation: Option<Relaxation>,
    /// Relative residual at which the solver stops
    #[arg(long, value_name = "X", value_parser = parse_tolerance, allow_negative_numbers = true)]
    pub residual: Option<f64>,
    /// Most passes over the matrix to take
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub max_sweeps: Option<u32>,
}

impl SolveArgs {
    pub(crate) fn apply(&self, scene: &mut Scene) {
        let settings = &mut scene.solver;
        let method = self.solver.map(|solver| match solver {
            SolverArg::GaussSeidel => SolverMethod::GaussSeidel,
            SolverArg::Cg => SolverMethod::ConjugateGradients,
        });
        settings.method = method.unwrap_or(settings.method);
        settings.relaxation = self.relaxation.unwrap_or(settings.relaxation);
        settings.tolerance = self.residual.unwrap_or(settings.tolerance);
        settings.max_sweeps = self.max_sweeps.unwrap_or(settings.max_sweeps);
        if self.relaxation.is_some() && settings.method == SolverMethod::ConjugateGradients {
            super::terminal::tell("warning: --relaxation is for gauss-seidel, and changes nothing");
        }
    }
}
