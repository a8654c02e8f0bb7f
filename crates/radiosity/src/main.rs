//! The `radiosity` command.

use clap::Parser;
use radiosity::cli::{Command, Site, run};
use std::process::ExitCode;

/// Diffuse global illumination by finite elements: form factors once, everything else at once
#[derive(Debug, Parser)]
#[command(version, after_help = radiosity::cli::EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

fn main() -> ExitCode {
    run(&Cli::parse().command, &Site::installed())
}
