//! Text as a terminal shows it: broken at its width, with the words in colour that say what kind of
//! line it is. Files and pipes get text as it is.

use crate::lines::LABEL_WIDTH;
use console::{Style, Term};
use textwrap::{Options, WordSplitter};

/// Standard output, or standard error.
#[derive(Clone, Copy)]
pub(crate) enum Stream {
    Output,
    Error,
}

/// Narrower terminals get lines of this width: fewer words would be harder to read.
const NARROWEST: usize = 40;

impl Stream {
    /// Lines of safe text, for this stream.
    pub(crate) fn fit(self, text: &str) -> String {
        let term = match self {
            Stream::Output => Term::stdout(),
            Stream::Error => Term::stderr(),
        };
        let width = term.size_checked().map(|(_, columns)| usize::from(columns));
        let lines = text.split('\n').map(|line| {
            let broken = match width {
                Some(width) => broken(line, width.max(NARROWEST)),
                None => line.to_owned(),
            };
            self.colored(&broken)
        });
        lines.collect::<Vec<_>>().join("\n")
    }

    /// With the first word in colour, where it says what kind of line it is.
    fn colored(self, line: &str) -> String {
        let text = line.trim_start();
        let known = |(word, style): (&'static str, Style)| {
            let rest = text.strip_prefix(word)?;
            let style = match self {
                Stream::Output => style.for_stdout(),
                Stream::Error => style.for_stderr(),
            };
            let space = &line[..line.len() - text.len()];
            Some(format!("{space}{}{rest}", style.apply_to(word)))
        };
        let found = kinds().into_iter().find_map(known);
        found.unwrap_or_else(|| line.to_owned())
    }
}

/// The first words of lines.
fn kinds() -> [(&'static str, Style); 4] {
    [
        ("error:", Style::new().red().bold()),
        ("warning:", Style::new().yellow().bold()),
        ("note:", Style::new().cyan().bold()),
        ("= help:", Style::new().green().bold()),
    ]
}

/// A line broken at spaces; what follows is indented as the text of the first line is. Excerpts of
/// files, and what has no space, stay whole.
fn broken(line: &str, width: usize) -> String {
    if line.contains(" |") {
        return line.to_owned();
    }
    let text = line.trim_start();
    let indent = " ".repeat(indent_of(line));
    let options = Options::new(width)
        .initial_indent(&line[..line.len() - text.len()])
        .subsequent_indent(&indent)
        .break_words(false)
        .word_splitter(WordSplitter::NoHyphenation);
    textwrap::fill(text, options)
}

/// How far the text of a line is from the left: behind its label, or the word that says what kind
/// of line it is.
fn indent_of(line: &str) -> usize {
    let space = line.len() - line.trim_start().len();
    if let Some((word, _)) = kinds()
        .iter()
        .find(|(word, _)| space < LABEL_WIDTH && line[space..].starts_with(word))
    {
        return space + word.len() + 1;
    }
    let label = line.as_bytes().get(..LABEL_WIDTH);
    let is_labelled = label.is_some_and(|label| label.ends_with(b"  "));
    if is_labelled { LABEL_WIDTH } else { space }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::labelled;

    #[test]
    fn lines_are_broken_and_aligned() {
        let line = labelled("solution", "one two three four five");
        let expected = "solution      one two three\n              four five";
        assert_eq!(broken(&line, 28), expected);
        let expected = "warning: one two\n         three";
        assert_eq!(broken("warning: one two three", 17), expected);
        assert_eq!(
            broken("   = help: one two", 14),
            "   = help: one\n           two"
        );
        let excerpt = "16 | material = \"whit\" # a comment";
        assert_eq!(broken(excerpt, 10), excerpt);
        let path = "              a/very/long/path/without/spaces.png";
        assert_eq!(broken(path, 20), path);
    }
}
