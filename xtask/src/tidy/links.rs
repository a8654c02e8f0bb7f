//! Relative links of documents lead to files and headings that are there.

use super::text::prose;
use super::{File, Finding};

/// Links to what is not there.
pub(super) fn check(files: &[File]) -> Vec<Finding> {
    let documents = files.iter().filter(|file| file.is_document());
    documents
        .flat_map(|file| of_document(file, files))
        .collect()
}

fn of_document(file: &File, files: &[File]) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (number, line) in prose(file) {
        for link in links(line) {
            if let Some(message) = fault(file, link, files) {
                findings.push(file.finding("links", number, link, message));
            }
        }
    }
    findings
}

/// The targets of a line: `[text](target)`.
fn links(line: &str) -> impl Iterator<Item = &str> {
    line.match_indices("](").filter_map(|(start, found)| {
        let (target, _) = line[start + found.len()..].split_once(')')?;
        Some(target)
    })
}

/// What is wrong with a link, and what to do.
fn fault(file: &File, link: &str, files: &[File]) -> Option<String> {
    if link.contains("://") || link.starts_with("mailto:") {
        return None;
    }
    let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
    let path = if path.is_empty() {
        file.path.clone()
    } else {
        resolved(&file.path, path)
    };
    let folder = format!("{path}/");
    let mut paths = files.iter().map(|file| &file.path);
    if !paths.any(|other| *other == path || other.starts_with(&folder)) {
        return Some(format!("no file is at `{path}`: mend the link"));
    }
    let is_target = |other: &&File| other.path == path && other.is_document();
    let target = files.iter().find(is_target)?;
    let is_lost = !anchor.is_empty() && !has_heading(target, anchor);
    is_lost.then(|| format!("`{path}` has no heading `#{anchor}`: mend the link"))
}

/// A path from a document, as one from the root of the checkout.
fn resolved(document: &str, path: &str) -> String {
    let mut parts: Vec<&str> = document.split('/').collect();
    parts.pop();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// Whether a heading has an anchor: its letters, digits, `_` and `-` in lower case, with spaces as
/// `-`. (GitHub numbers headings of one name, which no document should have.)
fn has_heading(document: &File, anchor: &str) -> bool {
    let is_kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '_' | '-');
    let is_it = |(_, line): (usize, &str)| {
        let title = line
            .strip_prefix('#')
            .map(|rest| rest.trim_start_matches('#').trim());
        let name = title.map(|title| title.to_lowercase().chars().filter(is_kept).collect());
        name.is_some_and(|name: String| name.replace(' ', "-") == anchor)
    };
    prose(document).any(is_it)
}
