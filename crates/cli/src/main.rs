//! The `radiosity` command.

use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;
use radiosity_cli::{Command, Folders, parse_command_line, run, with_examples};
use std::fs;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Diffuse global illumination by finite elements: form factors once, then all else is quick
#[derive(Debug, Parser)]
#[command(name = "radiosity", version, after_help = radiosity_cli::EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    #[command(flatten)]
    Radiosity(Box<Command>),
    /// Print a script that completes commands and options in a shell
    #[command(after_help = "Examples:
  radiosity completions bash > ~/.local/share/bash-completion/completions/radiosity
  radiosity completions zsh > ~/.zfunc/_radiosity
  radiosity completions fish > ~/.config/fish/completions/radiosity.fish")]
    Completions {
        /// Whose script
        shell: Shell,
    },
    /// Write man pages, one for each command
    #[command(after_help = "Examples:
  radiosity man                                  into this folder
  radiosity man ~/.local/share/man/man1          where `man radiosity` finds them
  radiosity man pages; man pages/radiosity.1     into a new folder, and the first one")]
    Man {
        /// Folder for the pages
        #[arg(default_value = ".")]
        folder: PathBuf,
    },
}

fn main() -> ExitCode {
    let task = match parse_command_line::<Cli>() {
        Ok(cli) => cli.task,
        Err(code) => return code,
    };
    let (what, written) = match task {
        Task::Radiosity(command) => return run(&command, &Folders::installed()),
        Task::Completions { shell } => ("standard output".into(), complete(shell)),
        Task::Man { folder } => {
            let made = fs::create_dir_all(&folder);
            let written = made.and_then(|()| clap_mangen::generate_to(described(), &folder));
            (folder, written)
        }
    };
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: cannot write {}: {error}", what.display());
            ExitCode::FAILURE
        }
    }
}

/// The command as its help describes it.
fn described() -> clap::Command {
    with_examples(Cli::command())
}

fn complete(shell: Shell) -> io::Result<()> {
    let script = &mut Vec::new();
    clap_complete::generate(shell, &mut described(), "radiosity", script);
    match io::stdout().write_all(script) {
        // That nobody reads all of it is no error.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}
