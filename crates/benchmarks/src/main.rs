//! `cargo xtask bench`: what is claimed, measured anew.

mod baseline;
mod course;
mod course_display;
mod display;
mod figure;
mod form_factors;
mod generated;
mod machine;
mod solver;
mod timing;
mod truth;
mod view_factors;
mod visibility;

use clap::{Parser, Subcommand};
use std::path::Path;
use std::process::ExitCode;

/// Whatever ends a bench before its figures.
type Error = Box<dyn std::error::Error + Send + Sync>;

/// Measure what is claimed
#[derive(Debug, Parser)]
#[command(name = "cargo xtask bench", bin_name = "cargo xtask bench")]
struct Cli {
    /// Print one JSON object per figure: name, value, unit, target, holds
    #[arg(long, global = true)]
    json: bool,
    #[command(subcommand)]
    what: Bench,
}

/// Which claims.
#[derive(Clone, Copy, Debug, Subcommand)]
enum Bench {
    /// Form factors: speed beside a transcription of the course's program, growth, and what the
    /// accurate mode costs
    FormFactors,
    /// View factors of a closed box, at four sizes, beside View3D (minutes)
    ViewFactors,
    /// Segments among 70,000 triangles, beside Embree if it is installed (Debian: libembree-dev)
    Visibility,
    /// The solver: passes beside the bandwidth of memory, what each method takes, and the course's
    /// loop (a minute)
    Solver,
    /// Pictures: speed beside the course's loop, error and time with exact direct light, beside the
    /// path tracer (a minute)
    Display,
    /// Every mode of the form factors against the oracle, on every shipped scene (minutes)
    Truth,
    /// Prints the seconds that the regular rule takes on this process's instruction set
    #[command(hide = true)]
    Regular {
        /// Patches along each edge
        divisions: u32,
    },
}

fn main() -> ExitCode {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let root = root.canonicalize().unwrap_or(root);
    let Cli { json, what } = Cli::parse();
    match run(what, &root, json) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(what: Bench, root: &Path, json: bool) -> Result<(), Error> {
    match what {
        Bench::Display => display::run(root, json),
        Bench::FormFactors => form_factors::run(root, json),
        Bench::Solver => solver::run(root, json),
        Bench::Truth => truth::run(root, json),
        Bench::ViewFactors => view_factors::run(root, json),
        Bench::Visibility => visibility::run(root, json),
        Bench::Regular { divisions } => machine::print_regular_seconds(root, divisions),
    }
}
