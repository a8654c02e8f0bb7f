//! `cargo xtask bench`: what is claimed, measured anew.

mod baseline;
mod course;
mod course_display;
mod display;
mod form_factors;
mod machine;
mod solver;
mod truth;
mod view_factors;
mod visibility;

use clap::Subcommand;
use radiosity::Error;
use radiosity::geometry::{Mesh, subdivide};
use radiosity::scene::{Scene, parse};
use serde::Serialize;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

#[derive(Clone, Copy, Debug, Subcommand)]
pub(crate) enum Bench {
    /// Form factors: speed beside a transcription of the course's program, growth, and what the
    /// accurate mode costs
    FormFactors {
        /// Print one JSON object per figure: name, value, unit, target, holds
        #[arg(long)]
        json: bool,
    },
    /// View factors of a closed box, at four sizes, beside View3D (minutes)
    ViewFactors {
        /// Print one JSON object per figure: name, value, unit, target, holds
        #[arg(long)]
        json: bool,
    },
    /// Segments among 70,000 triangles, beside Embree if it is installed (Debian: libembree-dev)
    Visibility {
        /// Print one JSON object per figure: name, value, unit, target, holds
        #[arg(long)]
        json: bool,
    },
    /// The solver: passes beside the bandwidth of memory, what each method takes, and the course's
    /// loop (a minute)
    Solver {
        /// Print one JSON object per figure: name, value, unit, target, holds
        #[arg(long)]
        json: bool,
    },
    /// Pictures: speed beside the course's loop, error and time with exact direct light, beside the
    /// path tracer (a minute)
    Display {
        /// Print one JSON object per figure: name, value, unit, target, holds
        #[arg(long)]
        json: bool,
    },
    /// Every mode of the form factors against the oracle, on every shipped scene (minutes)
    Truth {
        /// Print one JSON object per figure: name, value, unit, target, holds
        #[arg(long)]
        json: bool,
    },
}

/// A measured number and what is promised of it.
#[derive(Clone, Debug, Serialize)]
struct Figure {
    name: String,
    /// `null` where there is nothing to measure.
    value: Option<f64>,
    unit: &'static str,
    /// What is promised, if anything is.
    target: Option<Target>,
    /// Whether the promise is kept.
    holds: Option<bool>,
}

#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
enum Target {
    AtLeast(f64),
    Between(f64, f64),
}

impl std::fmt::Display for Target {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Target::AtLeast(least) => write!(f, "target: at least {least}"),
            Target::Between(least, most) => write!(f, "target: {least} to {most}"),
        }
    }
}

impl Figure {
    fn new(name: String, value: Option<f64>, unit: &'static str, target: Option<Target>) -> Figure {
        let keeps = |target: Target| {
            value.is_some_and(|value| match target {
                Target::AtLeast(least) => value >= least,
                Target::Between(least, most) => (least..=most).contains(&value),
            })
        };
        Figure {
            name,
            value,
            unit,
            target,
            holds: target.map(keeps),
        }
    }

    /// For people.
    fn say(&self) {
        let value = self.value.unwrap_or(f64::NAN);
        let promise = self.target.map_or_else(String::new, |target| {
            let kept = if self.holds == Some(true) {
                "kept"
            } else {
                "missed"
            };
            format!(" ({target}: {kept})")
        });
        let (name, unit) = (&self.name, self.unit);
        line(&format!("{name:<44}{value:>10.3} {unit}{promise}"));
    }

    /// As one line of JSON.
    fn print(&self) {
        line(&serde_json::to_string(self).expect("plain data always encodes"));
    }
}

/// A scene that was generated, cut as it says.
fn generated(name: &str, text: &str) -> Result<(Scene, Mesh), Error> {
    let scene = parse(Path::new(name), text)?;
    let mesh = subdivide(&scene.geometry, scene.divisions);
    Ok((scene, mesh.map_err(|error| Error::Mesh(error.to_string()))?))
}

/// The best of several runs, in seconds.
fn best_seconds(runs: u32, mut run: impl FnMut()) -> f64 {
    let once = |_| {
        let start = Instant::now();
        run();
        start.elapsed().as_secs_f64()
    };
    (0..runs).map(once).fold(f64::INFINITY, f64::min)
}

/// The middle one; of two the larger.
fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

/// Prints figures, for people or as JSON.
fn show(figures: &[Figure], json: bool) {
    let show = if json { Figure::print } else { Figure::say };
    figures.iter().for_each(show);
}

/// Prints a line; that nobody reads it any more (`| head`) is no error.
fn line(text: &str) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

pub(crate) fn run(bench: Bench, root: &Path) -> ExitCode {
    let result = match bench {
        Bench::Display { json } => display::run(root, json),
        Bench::FormFactors { json } => form_factors::run(root, json),
        Bench::Solver { json } => solver::run(root, json),
        Bench::Truth { json } => truth::run(root, json),
        Bench::ViewFactors { json } => view_factors::run(root, json),
        Bench::Visibility { json } => visibility::run(root, json),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
