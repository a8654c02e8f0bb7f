//! `cargo xtask`: the command in a checkout, and its chores.

mod ci;
mod generate;
mod tidy;

use clap::{Parser, Subcommand};
use generate::Generated;
use radiosity_cli::{Command, EXIT_CODES, Folders, parse_command_line, run};
use std::ffi::OsString;
use std::path::Path;
use std::process::{self, ExitCode};

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
    /// Check what no compiler does: lengths, first lines, words, names of types, links, licenses
    Tidy,
    /// Measure what is claimed
    #[command(disable_help_flag = true)]
    Bench {
        /// Which claims, and how to print them: `--help` tells
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<OsString>,
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
    let task = match parse_command_line::<Cli>() {
        Ok(cli) => cli.task,
        Err(code) => return code,
    };
    match task {
        Task::Radiosity(command) => run(&command, &Folders::checkout(&root)),
        Task::Bench { arguments } => bench(&arguments, &root),
        Task::Ci => ci::run(&root),
        Task::Tidy => tidy::run(&root),
        Task::Generate { what } => generate::run(&what, &root),
    }
}

/// The checkout as a folder to run programs in.
fn folder(root: &Path) -> &Path {
    if root.as_os_str().is_empty() {
        Path::new(".")
    } else {
        root
    }
}

/// Runs the package of benches: a program of its own, so that nothing else waits for it to compile.
fn bench(arguments: &[OsString], root: &Path) -> ExitCode {
    let status = process::Command::new("cargo")
        .args(["run", "--quiet", "--release", "--manifest-path"])
        .arg(root.join("Cargo.toml"))
        .args(["--package", "radiosity-benchmarks", "--"])
        .args(arguments)
        .status();
    match status {
        Ok(status) => {
            let code = status.code().and_then(|code| u8::try_from(code).ok());
            code.map_or(ExitCode::FAILURE, ExitCode::from)
        }
        Err(error) => {
            eprintln!("error: cannot start cargo: {error}");
            ExitCode::FAILURE
        }
    }
}
