//! The text of a file, and errors that point into it.

pub(crate) use crate::error::SceneError;

use crate::error::{FilePlace, Help, Parts};
use std::borrow::Cow;
use std::ops::Range;
use std::path::Path;

/// A file's text with the path that errors name.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub(crate) path: &'a Path,
    pub(crate) text: &'a str,
}

/// What an error says, apart from where.
pub(crate) struct Complaint {
    /// What is wrong.
    pub(crate) title: String,
    /// What stands under the caret.
    pub(crate) label: String,
    /// How to mend it.
    pub(crate) help: Option<Help>,
}

/// Bytes of text that are printed at once; names in files may have millions.
const MOST_TEXT: usize = 1000;

/// A text without its middle, if it is too long to be printed.
pub(crate) fn shortened(text: &str) -> Cow<'_, str> {
    if text.len() <= MOST_TEXT {
        return Cow::Borrowed(text);
    }
    let start = text.floor_char_boundary(MOST_TEXT / 2);
    let end = text.ceil_char_boundary(text.len() - MOST_TEXT / 4);
    Cow::Owned(format!("{} … {}", &text[..start], &text[end..]))
}

impl Complaint {
    pub(crate) fn new(title: impl Into<String>, label: impl Into<String>) -> Complaint {
        Complaint {
            title: title.into(),
            label: label.into(),
            help: None,
        }
    }

    pub(crate) fn help(self, help: impl Into<String>) -> Complaint {
        self.typed_help(Help::Words(help.into()))
    }

    pub(crate) fn typed_help(mut self, help: Help) -> Complaint {
        self.help = Some(help);
        self
    }

    /// Adds "did you mean" where one of the candidates is similar, or else lists them.
    pub(crate) fn suggest<'n>(
        self,
        wanted: &str,
        candidates: impl Iterator<Item = &'n str> + Clone,
    ) -> Complaint {
        match suggestion(wanted, candidates) {
            Some(help) => self.help(help),
            None => self,
        }
    }
}

/// "Did you mean" where one of the candidates is similar to what was wanted, or else what there is;
/// nothing where there is none.
pub fn suggestion<'n>(
    wanted: &str,
    candidates: impl Iterator<Item = &'n str> + Clone,
) -> Option<String> {
    let similarity = |name: &&str| strsim::jaro_winkler(wanted, name);
    let nearest = candidates
        .clone()
        .max_by(|a, b| similarity(a).total_cmp(&similarity(b)))?;
    if similarity(&nearest) > 0.7 {
        return Some(format!("did you mean `{nearest}`?"));
    }
    let names: Vec<&str> = candidates.take(12).collect();
    Some(format!("there are: {}", names.join(", ")))
}

impl Source<'_> {
    /// An error at a range of bytes of the text.
    pub(crate) fn error(&self, span: Range<usize>, complaint: &Complaint) -> SceneError {
        let span = span.start
            ..span
                .end
                .min(self.text.floor_char_boundary(span.start + MOST_TEXT));
        // The lines of the span alone: the renderer goes through all that it is given.
        let (before, after) = (&self.text[..span.start], &self.text[span.end..]);
        let start = before.rfind('\n').map_or(0, |at| at + 1);
        let after = &after[..after.floor_char_boundary(MOST_TEXT)];
        let end = span.end + after.find('\n').unwrap_or(after.len());
        let place = FilePlace {
            line: 1 + before.matches('\n').count(),
            column: 1 + before[start..].chars().count(),
            text: self.text[start..end].to_owned(),
            marked: span.start - start..span.end - start,
        };
        SceneError::from(Parts {
            title: shortened(&complaint.title).into_owned(),
            label: shortened(&complaint.label).into_owned(),
            path: self.path.to_owned(),
            place: Some(place),
            help: complaint.help.clone().map(|help| match help {
                Help::Words(words) => Help::Words(shortened(&words).into_owned()),
                Help::MeshFolder => help,
            }),
        })
    }

    /// An error in a whole line, counted from 1.
    pub(crate) fn error_in_line(&self, line: usize, complaint: &Complaint) -> SceneError {
        let start: usize = self
            .text
            .split_inclusive('\n')
            .take(line.saturating_sub(1))
            .map(str::len)
            .sum();
        let length = self.text[start..].lines().next().map_or(0, str::len);
        self.error(start..start + length, complaint)
    }
}

impl SceneError {
    /// An error of a whole file.
    pub(crate) fn of_file(path: &Path, title: &str, help: &str) -> SceneError {
        SceneError::from(Parts {
            title: shortened(title).into_owned(),
            label: String::new(),
            path: path.to_owned(),
            place: None,
            help: Some(Help::Words(help.to_owned())),
        })
    }
}
