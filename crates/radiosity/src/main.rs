//! The `radiosity` command.

use clap::Parser;
use radiosity::cli::{Command, Site, run};
use std::io::{ErrorKind, Write, stderr};
use std::process::ExitCode;

/// Diffuse global illumination by finite elements: form factors once, everything else at once
#[derive(Debug, Parser)]
#[command(version, after_help = radiosity::cli::EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

fn main() -> ExitCode {
    match Cli::try_parse() {
        Ok(cli) => run(&cli.command, &Site::installed()),
        Err(message) => print(&message),
    }
}

/// Prints help, or what is wrong with the command line.
fn print(message: &clap::Error) -> ExitCode {
    match message.print() {
        Err(error) if error.kind() != ErrorKind::BrokenPipe && !message.use_stderr() => {
            let _ = writeln!(stderr(), "error: cannot write standard output: {error}");
            ExitCode::FAILURE
        }
        _ => ExitCode::from(message.exit_code() as u8),
    }
}
