//! No name of a type means two things: what one crate exports, no other declares.

use super::{File, Finding};

/// A type at the top level of a module.
struct Declared<'a> {
    file: &'a File,
    /// Counted from 1.
    line: usize,
    /// The folder of its crate.
    package: &'a str,
    name: &'a str,
    is_exported: bool,
}

/// Types of `crates/`, tests left out, whose name another crate exports.
pub(super) fn check(files: &[File]) -> Vec<Finding> {
    let declared: Vec<Declared<'_>> = files.iter().flat_map(types_of).collect();
    let clash = |one| clash(one, &declared);
    declared.iter().filter_map(clash).collect()
}

fn clash(one: &Declared<'_>, all: &[Declared<'_>]) -> Option<Finding> {
    let clashes = |other: &&Declared<'_>| {
        other.is_exported && other.name == one.name && other.package != one.package
    };
    let Declared { package, name, .. } = all.iter().find(clashes)?;
    let message = format!("type `{name}` is another one in `{package}`: choose another name");
    Some(one.file.finding("types", one.line, name, message))
}

fn types_of(file: &File) -> Vec<Declared<'_>> {
    let Some(package) = package(&file.path) else {
        return Vec::new();
    };
    let mut types = Vec::new();
    for (index, line) in file.text.lines().enumerate() {
        if let Some((is_exported, name)) = declaration(line) {
            types.push(Declared {
                file,
                line: index + 1,
                package,
                name,
                is_exported,
            });
        }
    }
    types
}

/// The crate of a source file that is no test.
fn package(path: &str) -> Option<&str> {
    let (package, source) = path.strip_prefix("crates/")?.split_once("/src/")?;
    let is_test = source.split(['/', '.']).any(|part| part == "tests");
    (source.ends_with(".rs") && !is_test).then_some(package)
}

/// The name of the type that a line declares, and whether it is exported: `pub` where nobody can
/// reach it is a warning of the compiler.
fn declaration(line: &str) -> Option<(bool, &str)> {
    let (is_exported, rest) = match line.strip_prefix("pub ") {
        Some(rest) => (true, rest),
        None if line.starts_with("pub(") => (false, line.split_once(") ")?.1),
        None => (false, line),
    };
    let (keyword, rest) = rest.split_once(' ')?;
    let is_type = ["struct", "enum", "trait", "type"].contains(&keyword);
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_');
    is_type.then_some((is_exported, &rest[..end.unwrap_or(rest.len())]))
}
