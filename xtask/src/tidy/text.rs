//! Rules on one file: how it opens, how long it and its lines are, and its words.

use super::{File, Finding};

/// A longer file has two ideas in it, or says why not.
const MOST_LINES: usize = 250;

/// How the reason begins, in the comment that opens the file.
const REASON: &str = "//! Long because: ";

/// The widest lines of source files and of documents.
const MOST_COLUMNS: (usize, usize) = (100, 120);

/// Words that the field has others for, which stand beside them.
pub(super) const WORDS: [(&str, &str); 13] = [
    ("overdoes", "over-relaxes"),
    ("overdone", "relaxation factor"),
    ("unaccounted for", "energy balance"),
    ("ends on backs", "reaches back faces"),
    ("rehearse", "time_sample"),
    ("rehearsal", "timed sample"),
    ("stand-ins", "reduced points"),
    ("stand_ins", "reduced_points"),
    ("lettering", "text"),
    ("RIVALS", "ALL"),
    ("is_at_rest", "has_stagnated"),
    ("Stretch", "BlockInBand"),
    ("Told", "TileBlock"),
];

/// All of these rules.
pub(super) fn check(file: &File) -> Vec<Finding> {
    let mut findings = words(file);
    if file.is_source() {
        findings.extend(opening(file));
        findings.extend(length(file));
    }
    if file.is_source() || file.is_document() {
        findings.extend(columns(file));
    }
    findings
}

/// The lines outside of code blocks, with their numbers; in source files, all lines.
pub(super) fn prose(file: &File) -> impl Iterator<Item = (usize, &str)> {
    let mut is_code = false;
    let numbered = file.text.lines().enumerate();
    numbered.filter_map(move |(index, line)| {
        let is_fence = file.is_document() && line.trim_start().starts_with("```");
        is_code ^= is_fence;
        (!is_code && !is_fence).then_some((index + 1, line))
    })
}

fn opening(file: &File) -> Option<Finding> {
    let is_missing = !file.text.starts_with("//! ");
    let message = "open the file with `//!`: what it holds".to_owned();
    is_missing.then(|| file.finding("opening", 1, "", message))
}

fn length(file: &File) -> Option<Finding> {
    let lines = file.text.lines().count();
    let mut head = file.text.lines().take_while(|line| line.starts_with("//!"));
    let has_reason = head.any(|line| line.starts_with(REASON));
    let message = match (lines > MOST_LINES, has_reason) {
        (true, false) => format!(
            "{lines} lines, more than {MOST_LINES}: move one of its ideas to a file of its own, or \
             say `{REASON}...` at its top"
        ),
        (false, true) => {
            format!("no more than {MOST_LINES} lines: take the reason for its length away")
        }
        _ => return None,
    };
    Some(file.finding("length", 1, "", message))
}

fn columns(file: &File) -> Vec<Finding> {
    let (source, document) = MOST_COLUMNS;
    let most = if file.is_source() { source } else { document };
    let wide = prose(file).filter_map(|(number, line)| {
        let columns = columns_of(line);
        let message = format!("{columns} columns, more than {most}: break the line");
        (columns > most).then(|| file.finding("columns", number, "", message))
    });
    wide.collect()
}

/// The width of a line without addresses, which cannot be broken. Rows of tables have none.
fn columns_of(line: &str) -> usize {
    let text = line.trim_start_matches(['/', '!', ' ']);
    if text.starts_with('|') {
        return 0;
    }
    let mut columns = line.chars().count();
    for (start, _) in line.match_indices("](") {
        let address = &line[start + 1..];
        let end = address.find(')').map_or(address.len(), |end| end + 1);
        columns = columns.saturating_sub(address[..end].chars().count());
    }
    let is_url = |word: &&str| word.contains("://") && !word.contains("](");
    let urls = line.split_whitespace().filter(is_url);
    columns.saturating_sub(urls.map(|url| url.chars().count()).sum())
}

fn words(file: &File) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (index, line) in file.text.lines().enumerate() {
        for (word, better) in WORDS {
            if has_word(line, word) {
                let message = format!("`{word}` is no word of the field: say `{better}`");
                findings.push(file.finding("words", index + 1, word, message));
            }
        }
    }
    findings
}

/// Whether it stands there by itself and not as a part of a longer word.
fn has_word(line: &str, word: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    line.match_indices(word).any(|(start, _)| {
        let before = line[..start].chars().next_back();
        let after = line[start + word.len()..].chars().next();
        !before.is_some_and(is_part) && !after.is_some_and(is_part)
    })
}
