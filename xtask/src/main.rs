//! `cargo xtask`: the command in a checkout, and its chores.

mod bench;
mod ci;
mod generate;

use bench::Bench;
use clap::{Parser, Subcommand};
use generate::Generated;
use radiosity::cli::{Command, EXIT_CODES, Site, run};
use std::path::Path;
use std::process::ExitCode;

/// Renders the scenes of this checkout, and does its chores
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    #[command(flatten)]
    Radiosity(Box<Command>),
    /// Run everything that a change must pass: format, lints, docs, tests, a render
    Ci,
    /// Measure what is claimed
    Bench {
        /// Which claims
        #[command(subcommand)]
        what: Bench,
    },
    /// Make a scene or a mesh that follows a rule
    Generate {
        /// Which one
        #[command(subcommand)]
        what: Generated,
    },
}

fn main() -> ExitCode {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let root = root.canonicalize().unwrap_or(root);
    // Shown paths are shorter, and mean the same, where one stands in it.
    let root = match std::env::current_dir() {
        Ok(here) if here == root => Path::new("").to_owned(),
        _ => root,
    };
    match Cli::parse().task {
        Task::Radiosity(command) => run(&command, &Site::checkout(&root)),
        Task::Bench { what } => bench::run(what, &root),
        Task::Ci => ci::run(&root),
        Task::Generate { what } => generate::run(&what, &root),
    }
}
