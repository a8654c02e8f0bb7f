//! `cargo xtask tidy`: rules of the house that neither the compiler nor clippy knows.
//!
//! A rule is a function from files to findings: [`text`] has those on one file, [`types`] and
//! [`links`] those on all. What may break a rule, and why, is in [`exceptions`].

mod exceptions;
mod links;
mod text;
mod types;

#[cfg(test)]
mod tests;

use std::fmt;
use std::path::Path;
use std::process::{Command, ExitCode, Output};

/// A source file or document of the checkout; of others nothing but the path is known.
struct File {
    /// From the root of the checkout, with `/`.
    path: String,
    text: String,
}

/// A place where a rule is broken.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Finding {
    path: String,
    /// Counted from 1.
    line: usize,
    /// By this name exceptions are made.
    rule: &'static str,
    /// The word, type or link that it is about, if it is about one.
    what: String,
    /// What is wrong and what to do.
    message: String,
}

impl File {
    fn is_source(&self) -> bool {
        self.path.ends_with(".rs")
    }

    fn is_document(&self) -> bool {
        self.path.ends_with(".md")
    }

    fn finding(&self, rule: &'static str, line: usize, what: &str, message: String) -> Finding {
        Finding {
            path: self.path.clone(),
            line,
            rule,
            what: what.to_owned(),
            message,
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Finding {
            path,
            line,
            message,
            ..
        } = self;
        write!(f, "{path}:{line}: {message} [{}]", self.rule)
    }
}

/// Prints one line for each finding; fails if there is one.
pub(crate) fn run(root: &Path) -> ExitCode {
    let files = match files(root) {
        Ok(files) => files,
        Err(problem) => {
            eprintln!("error: {problem}");
            return ExitCode::FAILURE;
        }
    };
    let mut findings = exceptions::without_excepted(check(&files));
    findings.extend(denied(root));
    for finding in &findings {
        println!("{finding}");
    }
    if findings.is_empty() {
        ExitCode::SUCCESS
    } else {
        eprintln!("tidy: {} findings", findings.len());
        ExitCode::FAILURE
    }
}

/// All rules on all files, by path and line.
fn check(files: &[File]) -> Vec<Finding> {
    let mut findings: Vec<Finding> = files.iter().flat_map(text::check).collect();
    findings.extend(types::check(files));
    findings.extend(links::check(files));
    findings.sort();
    findings
}

/// The files of the checkout that git has, or would take.
fn files(root: &Path) -> Result<Vec<File>, String> {
    // -c: those it has; -o: new ones, unless they are ignored.
    let listed = output("git", &["ls-files", "-zco", "--exclude-standard"], root)?;
    if !listed.status.success() {
        let problem = String::from_utf8_lossy(&listed.stderr);
        return Err(format!("git cannot list the files: {}", problem.trim_end()));
    }
    let paths = String::from_utf8_lossy(&listed.stdout);
    let paths = paths.split_terminator('\0').map(str::to_owned);
    // Git lists what is deleted until that is committed.
    let there = paths.filter(|path| root.join(path).exists());
    there.map(|path| read(root, path)).collect()
}

fn read(root: &Path, path: String) -> Result<File, String> {
    let mut file = File {
        path,
        text: String::new(),
    };
    if file.is_source() || file.is_document() {
        file.text = std::fs::read_to_string(root.join(&file.path))
            .map_err(|error| format!("cannot read {}: {error}", file.path))?;
    }
    Ok(file)
}

/// What cargo-deny says, where it is installed: its report, and a finding if it is not content.
fn denied(root: &Path) -> Option<Finding> {
    let is_installed =
        output("cargo", &["deny", "--version"], root).is_ok_and(|version| version.status.success());
    if !is_installed {
        eprintln!("tidy: licenses and advisories are not checked: cargo-deny is not installed");
        return None;
    }
    let report = output("cargo", &["deny", "check"], root).ok()?;
    if report.status.success() {
        return None;
    }
    eprint!("{}", String::from_utf8_lossy(&report.stderr));
    Some(Finding {
        path: "deny.toml".to_owned(),
        line: 1,
        rule: "deny",
        what: String::new(),
        message: "`cargo deny check` fails: mend what it reports above".to_owned(),
    })
}

fn output(program: &str, arguments: &[&str], root: &Path) -> Result<Output, String> {
    Command::new(program)
        .args(arguments)
        .current_dir(crate::folder(root))
        .output()
        .map_err(|error| format!("cannot start {program}: {error}"))
}
