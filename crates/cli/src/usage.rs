//! The command line as a whole: help, and what is wrong with it.

use super::help::with_help;
use super::terminal::tell;
use clap::Parser;
use clap::builder::Styles;
use std::io::ErrorKind;
use std::process::ExitCode;

/// Reads the command line. Help, or what is wrong with the command line, is printed instead, and
/// what comes back is the exit code.
pub fn parse_command_line<C: Parser>() -> Result<C, ExitCode> {
    C::try_parse().map_err(|message| {
        if message.use_stderr() {
            tell(&without_styles::<C>(&message));
            exit_code(&message)
        } else {
            print_help(&with_all_help::<C>().unwrap_or(message))
        }
    })
}

/// What is wrong, with arguments in it as they were given: escapes in it are theirs.
fn without_styles<C: Parser>(message: &clap::Error) -> String {
    let plain = C::command().styles(Styles::plain());
    let text = match plain.try_get_matches_from(std::env::args_os()) {
        Err(same) => same.render().ansi().to_string(),
        Ok(_) => message.render().to_string(),
    };
    text.trim_end().to_owned()
}

/// The help that was asked for, with all that is added to it: made for those alone who ask.
fn with_all_help<C: Parser>() -> Option<clap::Error> {
    let command = with_help(C::command());
    command.try_get_matches_from(std::env::args_os()).err()
}

fn print_help(message: &clap::Error) -> ExitCode {
    match message.print() {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            tell(&format!("error: cannot write standard output: {error}"));
            ExitCode::FAILURE
        }
        _ => exit_code(message),
    }
}

fn exit_code(message: &clap::Error) -> ExitCode {
    ExitCode::from(message.exit_code() as u8)
}
