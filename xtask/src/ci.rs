//! `cargo xtask ci`.

use std::path::Path;
use std::process::{Command, ExitCode};
use std::time::Instant;

/// What a change must pass, in the order of what fails fastest.
const STEPS: [(&str, &[&str]); 7] = [
    ("format", &["fmt", "--all", "--check"]),
    ("tidy", &["xtask", "tidy"]),
    (
        "lints",
        &[
            "clippy",
            "--workspace",
            "--all-targets",
            "--",
            "-D",
            "warnings",
        ],
    ),
    (
        "docs",
        &[
            "doc",
            "--workspace",
            "--no-deps",
            "--document-private-items",
        ],
    ),
    (
        "no features",
        &[
            "check",
            "--package",
            "radiosity-cli",
            "--no-default-features",
        ],
    ),
    (
        "tests, slow ones too",
        &["test", "--workspace", "--", "--include-ignored"],
    ),
    (
        "render",
        &["xtask", "render", "--no-cache", "--output", "target/ci"],
    ),
];

/// Runs all steps and stops at the first that fails.
pub(crate) fn run(root: &Path) -> ExitCode {
    let folder = crate::folder(root);
    for (name, arguments) in STEPS {
        let start = Instant::now();
        eprintln!("ci: {name}: cargo {}", arguments.join(" "));
        let status = Command::new("cargo")
            .args(arguments)
            .env("RUSTDOCFLAGS", "-D warnings")
            .current_dir(folder)
            .status();
        if !status.is_ok_and(|status| status.success()) {
            eprintln!("ci: {name} failed");
            return ExitCode::FAILURE;
        }
        eprintln!(
            "ci: {name} passed in {:.0} s",
            start.elapsed().as_secs_f64()
        );
    }
    ExitCode::SUCCESS
}
