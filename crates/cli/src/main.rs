//! The `radiosity` command.

use clap::Parser;
use radiosity_cli::{Command, Site, parse_command_line, run};
use std::process::ExitCode;

/// Diffuse global illumination by finite elements: form factors once, everything else at once
#[derive(Debug, Parser)]
#[command(version, after_help = radiosity_cli::EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

fn main() -> ExitCode {
    match parse_command_line::<Cli>() {
        Ok(cli) => run(&cli.command, &Site::installed()),
        Err(code) => code,
    }
}
