//! The statements of an OBJ file, and what is in them.

use crate::values::MOST_NAME;
use radiosity_geometry::DVec3;
use std::borrow::Cow;

/// A line, or several that are joined.
pub(super) struct Statement<'a> {
    /// Where it begins, counted from 1.
    pub(super) line: usize,
    text: Cow<'a, str>,
}

/// What is wrong with a statement, and how to mend it.
pub(super) struct Problem {
    pub(super) title: String,
    pub(super) help: String,
}

/// All statements of a file. A line that ends in `\` goes on in the next one.
pub(super) fn statements(text: &str) -> impl Iterator<Item = Statement<'_>> {
    let mut lines = text.lines().enumerate();
    std::iter::from_fn(move || {
        let (index, first) = lines.next()?;
        let line = index + 1;
        let Some(start) = continued(first) else {
            let text = Cow::Borrowed(first);
            return Some(Statement { line, text });
        };
        let mut whole = start.to_owned();
        for (_, next) in lines.by_ref() {
            let part = continued(next);
            whole.push(' ');
            whole.push_str(part.unwrap_or(next));
            if part.is_none() {
                break;
            }
        }
        let text = Cow::Owned(whole);
        Some(Statement { line, text })
    })
}

/// The line without the `\` at its end. One that ends a comment belongs to the comment.
fn continued(line: &str) -> Option<&str> {
    let start = line.trim_end().strip_suffix('\\')?;
    let is_comment = start.split_whitespace().any(|word| word.starts_with('#'));
    (!is_comment).then_some(start)
}

impl Statement<'_> {
    /// The first word, and what follows. Files that were joined have byte order marks in the
    /// middle.
    pub(super) fn parts(&self) -> (&str, &str) {
        let is_blank = |c: char| c.is_whitespace() || c == '\u{feff}';
        let text = self.text.trim_matches(is_blank);
        text.split_once(char::is_whitespace).unwrap_or((text, ""))
    }
}

impl Problem {
    fn new(title: String, help: &str) -> Problem {
        Problem {
            title,
            help: help.to_owned(),
        }
    }
}

/// The words before a comment.
pub(super) fn words(text: &str) -> impl Iterator<Item = &str> {
    let end = text.find('#').unwrap_or(text.len());
    text[..end].split_whitespace()
}

/// The name of a group or material, which may have blanks and `#` in it, if there is one.
pub(super) fn name(text: &str) -> Result<Option<&str>, Problem> {
    let name = text.trim();
    if name.len() > MOST_NAME {
        let title = format!("this name has {} bytes", name.len());
        let help = format!("give it one of at most {MOST_NAME}");
        return Err(Problem { title, help });
    }
    Ok((!name.is_empty()).then_some(name))
}

/// Three coordinates; a weight or a colour may follow.
pub(super) fn position(text: &str) -> Result<DVec3, Problem> {
    const LIKE: &str = "vertices are lines like: v 0 0.5 2";
    let mut words = words(text);
    let mut position = DVec3::ZERO;
    for axis in 0..3 {
        let Some(word) = words.next() else {
            let title = "this vertex has fewer than three coordinates";
            return Err(Problem::new(title.to_owned(), LIKE));
        };
        position[axis] = word.parse().map_err(|_| {
            let help = match word.contains(',') {
                true => "decimals take a point, and blanks stand between numbers: v 0 0.5 2",
                false => LIKE,
            };
            Problem::new(format!("`{word}` is no number"), help)
        })?;
    }
    Ok(position)
}

/// The number of a vertex of `VERTEX/TEXTURE/NORMAL`: counted from 1, or back from the newest by
/// -1.
pub(super) fn vertex_number(word: &str) -> Result<i64, Problem> {
    let number = word.split('/').next().unwrap_or_default();
    match number.parse() {
        Ok(0) => {
            let title = "there is no vertex 0".to_owned();
            Err(Problem::new(title, "vertices are counted from 1"))
        }
        Ok(number) => Ok(number),
        Err(_) => {
            let help = "faces are lines of numbers of vertices, like: f 1 2 3";
            Err(Problem::new(format!("`{word}` is no vertex"), help))
        }
    }
}
