//! What help adds to the arguments: examples, and which options are short help.

use clap::{Arg, Command};

/// Three ways to call each command, without its program's name.
const EXAMPLES: [(&str, [&str; 3]); 10] = [
    (
        "render",
        [
            "render                              both pictures of the Cornell box, into out/",
            "render room.toml --shading exact    one picture with exact shadows",
            "render knot --turntable 36          a film: once around the knot",
        ],
    ),
    (
        "form-factors",
        [
            "form-factors room.vs3 --export f.csv --by surface    view factors between surfaces",
            "form-factors room.vs3 --export f.npy                 the matrix for NumPy",
            "form-factors cornell --mode regular --points 4 -v    the simpler rule, and its errors",
        ],
    ),
    (
        "solve",
        [
            "solve cornell --export light.csv                 radiosity and irradiance by patch",
            "solve cornell --export means.csv --by surface    means by surface",
            "solve cornell --plot residuals.svg               how each method converges",
        ],
    ),
    (
        "relight",
        [
            "relight cornell --dim lamp=0.3                       a dimmer lamp, nothing is solved",
            "relight cornell --tint lamp=1,0.8,0.6 --export w.csv    a warmer one, as a table",
            "relight house.toml --only kitchen                    one light alone",
        ],
    ),
    (
        "display",
        [
            "display cornell --exposure 20              brighter, with the cached solution",
            "display cornell --dim lamp=0.3             a dimmer lamp",
            "display cornell --show illuminance --isolines    lux in false colours",
        ],
    ),
    (
        "reference",
        [
            "reference cornell --spp 256          a path-traced picture, 256 walks a pixel",
            "reference cornell --error 2          until its error is 2 %",
            "reference cornell --cells --spp 1000    radiosities by patch, to compare with",
        ],
    ),
    (
        "compare",
        [
            "compare a.png b.exr --scene cornell --exposure 4     the error of picture a",
            "compare light.csv truth.csv --scene cornell          the error of radiosities",
            "compare a.pfm b.pfm --difference where.png           and where it is",
        ],
    ),
    (
        "check",
        [
            "check room.toml                   mistakes, lights, and what a run will take",
            "check room.toml --divisions 48    the same with more patches",
            "check room.toml --json            for scripts",
        ],
    ),
    (
        "cache",
        [
            "cache list                          what is cached, and for which scene",
            "cache clean --older 7d              what was not used for a week",
            "cache clean --keep 2GB              all but the newest two gigabytes",
        ],
    ),
    (
        "inspect",
        [
            "inspect cache/form-factors-0123456789abcdef.bin    what it holds, and how good it is",
            "inspect FILE.bin --scene room.toml                 with names of surfaces",
            "inspect FILE.bin --json                            for scripts",
        ],
    ),
];

/// Three commands for the help of the program.
const FIRST: [&str; 3] = [
    "render                                           pictures of the Cornell box",
    "check room.toml                                  mistakes, and what a run will take",
    "form-factors room.vs3 --export f.csv --by surface    view factors between surfaces",
];

/// Of commands with more options than a screen has lines, `-h` shows these.
const COMMON: [&str; 21] = [
    "scene",
    "divisions",
    "sparse",
    "max_patch_edge",
    "verbose",
    "json",
    "dim",
    "show",
    "views",
    "turntable",
    "size",
    "exposure",
    "shading",
    "output",
    "format",
    "export",
    "by",
    "spp",
    "error",
    "cells",
    "help",
];
/// So many options fit on a screen.
const ON_A_SCREEN: usize = 16;
/// Lines of help are no longer.
const WIDTH: usize = 100;

/// The command with examples, and `-h` on a screen.
pub(crate) fn with_help(command: Command) -> Command {
    let mut command = with_examples(command);
    for (name, _) in EXAMPLES {
        if command.find_subcommand(name).is_some() {
            command = command.mut_subcommand(name, short);
        }
    }
    command
}

/// The command with examples at the end of its help.
pub fn with_examples(command: Command) -> Command {
    let program = command.get_bin_name().unwrap_or(command.get_name());
    let program = program.to_owned();
    let told = |examples: [&str; 3]| {
        let lines = examples.map(|example| format!("  {program} {example}"));
        format!("Examples:\n{}", lines.join("\n"))
    };
    let end = match command.get_after_help() {
        Some(end) => format!("{}\n\n{end}", told(FIRST)),
        None => told(FIRST),
    };
    let mut command = command.max_term_width(WIDTH).after_help(end);
    for (name, examples) in EXAMPLES {
        if command.find_subcommand(name).is_some() {
            let examples = told(examples);
            command = command.mut_subcommand(name, |of_name| ended(of_name, &examples));
        }
    }
    command
}

/// Ends the help of a command, and of what it consists of, in examples.
fn ended(mut command: Command, examples: &str) -> Command {
    let parts = command.get_subcommands();
    let parts: Vec<String> = parts.map(|part| part.get_name().to_owned()).collect();
    for part in parts {
        command = command.mut_subcommand(part, |part| ended(part, examples));
    }
    command
        .max_term_width(WIDTH)
        .after_help(examples.to_owned())
}

/// Leaves what is rarely used to `--help`.
fn short(command: Command) -> Command {
    if command.get_arguments().count() <= ON_A_SCREEN {
        return command;
    }
    let is_common = |arg: &Arg| COMMON.contains(&arg.get_id().as_str());
    command.mut_args(|arg| {
        let is_rare = !is_common(&arg);
        arg.hide_short_help(is_rare)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Subcommand;

    fn command() -> Command {
        with_help(crate::Command::augment_subcommands(Command::new(
            "radiosity",
        )))
    }

    /// What stands before two spaces is what one types.
    #[test]
    fn examples_are_understood() {
        let first = ["render", "check", "form-factors"].into_iter().zip(FIRST);
        let others = EXAMPLES.into_iter();
        let others = others.flat_map(|(name, examples)| examples.map(|example| (name, example)));
        for (name, example) in first.chain(others) {
            let typed = example.split("  ").next().unwrap();
            assert!(typed.starts_with(name));
            let words = ["radiosity"].into_iter().chain(typed.split(' '));
            let result = command().try_get_matches_from(words);
            result.unwrap_or_else(|error| panic!("{example}: {error}"));
        }
    }

    #[test]
    fn every_command_has_examples_and_short_help_on_a_screen() {
        let command = command();
        for of_name in command.get_subcommands() {
            let name = of_name.get_name();
            assert!(EXAMPLES.iter().any(|(known, _)| *known == name), "{name}");
            let help = of_name.clone().render_help().to_string();
            assert!(help.lines().count() <= 48, "{name}\n{help}");
            assert!(
                help.lines().all(|line| line.chars().count() <= WIDTH),
                "{help}"
            );
        }
    }
}
