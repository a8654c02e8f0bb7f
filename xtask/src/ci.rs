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

/// Programs that show how the library is used. What they write is left in `target/ci`.
const EXAMPLES: [&str; 4] = ["cornell", "own_mesh", "view_factors", "relight"];

/// Runs all steps and stops at the first that fails.
pub(crate) fn run(root: &Path) -> ExitCode {
    let folder = crate::folder(root);
    let passed = STEPS
        .iter()
        .all(|(name, arguments)| passes(name, arguments, folder))
        && examples_pass(&folder.join("target/ci"));
    if passed {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

fn examples_pass(folder: &Path) -> bool {
    if let Err(error) = std::fs::create_dir_all(folder) {
        eprintln!("ci: cannot create {}: {error}", folder.display());
        return false;
    }
    EXAMPLES.iter().all(|example| {
        // Without `--package`, which would compile all with other features than the tests do.
        let arguments = ["run", "--example", example];
        passes(&format!("example {example}"), &arguments, folder)
    })
}

/// Runs cargo, and says whether it succeeded.
fn passes(name: &str, arguments: &[&str], folder: &Path) -> bool {
    let start = Instant::now();
    eprintln!("ci: {name}: cargo {}", arguments.join(" "));
    let status = Command::new("cargo")
        .args(arguments)
        .env("RUSTDOCFLAGS", "-D warnings")
        .current_dir(folder)
        .status();
    let passed = status.is_ok_and(|status| status.success());
    if passed {
        let seconds = start.elapsed().as_secs_f64();
        eprintln!("ci: {name} passed in {seconds:.0} s");
    } else {
        eprintln!("ci: {name} failed");
    }
    passed
}
