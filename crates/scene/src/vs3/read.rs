//! The lines of a `.vs3` file.
//!
//! Long because: one function for each kind of line.

use crate::source::{Complaint, SceneError, Source, shortened};
use crate::values::MOST_NAME;
use arrayvec::ArrayVec;
use radiosity_geometry::DVec3;
use std::collections::HashMap;
use std::str::FromStr;

/// Whether a surface has factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Surface,
    Obstruction,
}

/// A surface as its line says.
#[derive(Debug)]
pub(super) struct Entry {
    /// Counted from 1.
    pub(super) line: usize,
    pub(super) number: u32,
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) corners: ArrayVec<DVec3, 4>,
    /// The number of what it lies on, or 0.
    base_number: u32,
    /// The entry that it lies on.
    pub(super) base: Option<usize>,
    /// The entry that it is combined with.
    pub(super) combined: Option<usize>,
    pub(super) emittance: f64,
}

/// Everything that a file says.
#[derive(Debug, Default)]
pub(super) struct File {
    pub(super) entries: Vec<Entry>,
    /// Whether all that a surface sees are fronts.
    pub(super) closed: bool,
    /// What was read and is not used.
    pub(super) notes: Vec<String>,
    vertices: HashMap<u32, DVec3>,
    by_number: HashMap<u32, usize>,
}

/// The words of a line that are left.
struct Words<'a> {
    source: &'a Source<'a>,
    /// Counted from 1.
    line: usize,
    words: std::vec::IntoIter<&'a str>,
}

pub(super) fn read(source: &Source<'_>) -> Result<File, SceneError> {
    let mut file = File::default();
    let text = source.text.trim_start_matches('\u{feff}');
    for (index, line) in text.lines().enumerate() {
        let mut words = Words::of(source, index + 1, line);
        let Some(first) = words.words.next() else {
            continue;
        };
        // View3D looks at the first letter alone.
        match first
            .chars()
            .next()
            .unwrap_or_default()
            .to_ascii_uppercase()
        {
            'T' | 'X' => {}
            'C' => file.controls(words),
            'F' => format(&mut words)?,
            'V' => file.vertex(words)?,
            'S' => file.surface(words, Kind::Surface)?,
            'O' => file.surface(words, Kind::Obstruction)?,
            // The last is how DOS ends a file.
            '*' | 'E' | '\u{1a}' => break,
            'M' | 'N' => {
                let title = "masks and null surfaces (M, N) are not read";
                let help = "no other line says the same: this scene is one for View3D alone";
                return Err(words.error(title, "this line", help));
            }
            _ => {
                let title = format!("`{first}` is not known");
                let help = "lines begin with T, C, F, V, S, O, E or *; comments with ! or /";
                return Err(words.error(&title, "this line", help));
            }
        }
    }
    file.find_bases(source)?;
    if file.entries.iter().any(|entry| entry.kind == Kind::Surface) {
        return Ok(file);
    }
    let help = "surfaces are lines like: S 1 1 2 3 4 0 0 0.9 floor";
    Err(SceneError::of_file(
        source.path,
        "there are no surfaces",
        help,
    ))
}

fn format(words: &mut Words<'_>) -> Result<(), SceneError> {
    let format = words.words.next().unwrap_or_default();
    if format == "3" {
        return Ok(());
    }
    let title = format!("the format is `{format}`, and only `3` can be read");
    let help = "write the scene in View3D's format `F 3`: vertices (V) and surfaces (S) of them";
    Err(words.error(&title, "this line", help))
}

impl File {
    /// Names with their values; those of no meaning here are noted.
    fn controls(&mut self, words: Words<'_>) {
        let line = words.line;
        let words: Vec<&str> = words.words.flat_map(|word| word.split('=')).collect();
        let words: Vec<&str> = words.into_iter().filter(|word| !word.is_empty()).collect();
        for control in words.chunks(2) {
            match control {
                [name, value] if name.eq_ignore_ascii_case("encl") => self.closed = *value != "0",
                _ => {
                    let control = control.join("=");
                    let control = shortened(&control);
                    self.notes
                        .push(format!("`C {control}` in line {line} is not used"));
                }
            }
        }
    }

    fn vertex(&mut self, mut words: Words<'_>) -> Result<(), SceneError> {
        let number = words.number("the number of a vertex")?;
        let mut position = DVec3::ZERO;
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            position[axis] = words.number(name)?;
            if !position[axis].is_finite() {
                let title = format!("the vertex's {name} is not finite");
                return Err(words.error(&title, "this vertex", "give a number"));
            }
        }
        let next = words.words.next().map(str::parse::<f64>);
        if matches!(next, Some(Ok(_))) {
            let title = "this vertex has more than three coordinates";
            let help = "decimals take a point, as in 2.5: commas are blanks here";
            return Err(words.error(title, "this vertex", help));
        }
        if self.vertices.insert(number, position).is_some() {
            let title = format!("there are two vertices {number}");
            return Err(words.error(&title, "the second", "give it another number"));
        }
        Ok(())
    }

    fn surface(&mut self, mut words: Words<'_>, kind: Kind) -> Result<(), SceneError> {
        let number: u32 = words.number("the number of a surface")?;
        let corners = self.corners(&mut words)?;
        let (mut base, mut combined, mut emittance) = (0, None, 1.0);
        if kind == Kind::Surface {
            base = words.number("base")?;
            combined = self.combined_with(&mut words)?;
            emittance = words.number("the emittance")?;
            if !(0.0..=1.0).contains(&emittance) {
                let title = format!("the emittance {emittance} is out of range");
                return Err(words.error(&title, "this surface", "it is from 0 to 1"));
            }
        } else {
            // The same fields, which mean nothing here.
            words.words.by_ref().take(3).for_each(drop);
        }
        if self.by_number.insert(number, self.entries.len()).is_some() {
            let title = format!("there are two surfaces {number}");
            return Err(words.error(&title, "the second", "give it another number"));
        }
        let name = words.words.as_slice().join(" ");
        if name.len() > MOST_NAME {
            let title = format!("the name of surface {number} has {} bytes", name.len());
            let help = format!("give it one of at most {MOST_NAME}");
            return Err(words.error(&title, "this surface", &help));
        }
        self.entries.push(Entry {
            line: words.line,
            number,
            name: if name.is_empty() {
                number.to_string()
            } else {
                name
            },
            kind,
            corners,
            base_number: base,
            base: None,
            combined,
            emittance,
        });
        Ok(())
    }

    /// Three or four vertices: the fourth is 0 on triangles.
    fn corners(&self, words: &mut Words<'_>) -> Result<ArrayVec<DVec3, 4>, SceneError> {
        let mut corners = ArrayVec::new();
        for position in 1..=4 {
            let number: u32 = words.number("the number of a vertex")?;
            match self.vertices.get(&number) {
                Some(corner) => corners.push(*corner),
                None if number == 0 && position == 4 => {}
                None => {
                    let title = format!("there is no vertex {number}");
                    let help = "correct the number, or write the vertex (V) before this line";
                    return Err(words.error(&title, "this surface", help));
                }
            }
        }
        Ok(corners)
    }

    /// The earlier surface that one is combined with; 0 is none.
    fn combined_with(&self, words: &mut Words<'_>) -> Result<Option<usize>, SceneError> {
        let number: u32 = words.number("cmb")?;
        let index = self.by_number.get(&number).copied();
        match index.filter(|&index| self.entries[index].kind == Kind::Surface) {
            None if number != 0 => {
                let title = format!("`cmb` refers to {number}, which is no earlier surface");
                let help = "name a surface (S) of a line before, or write 0";
                Err(words.error(&title, "this surface", help))
            }
            index => Ok(index),
        }
    }

    /// Finds what each surface lies on: an earlier surface, or an obstruction, which come last.
    fn find_bases(&mut self, source: &Source<'_>) -> Result<(), SceneError> {
        for k in 0..self.entries.len() {
            let number = self.entries[k].base_number;
            let index = self.by_number.get(&number).copied();
            let is_base = |&at: &usize| at < k || self.entries[at].kind == Kind::Obstruction;
            self.entries[k].base = index.filter(is_base);
            if number != 0 && self.entries[k].base.is_none() {
                let title =
                    format!("`base` refers to {number}, no obstruction and no earlier surface");
                let complaint =
                    Complaint::new(title, "this surface").help("name what it lies on, or write 0");
                return Err(source.error_in_line(self.entries[k].line, &complaint));
            }
        }
        Ok(())
    }
}

impl<'a> Words<'a> {
    /// Commas are as good as blanks, and a word that begins with `!` or `/` begins a comment.
    fn of(source: &'a Source<'a>, line: usize, text: &'a str) -> Words<'a> {
        let words = text.split(|c: char| c.is_whitespace() || c == ',');
        let words = words.filter(|word| !word.is_empty());
        let words: Vec<&str> = words
            .take_while(|word| !word.starts_with(['!', '/']))
            .collect();
        let words = words.into_iter();
        Words {
            source,
            line,
            words,
        }
    }

    fn number<T: FromStr>(&mut self, what: &str) -> Result<T, SceneError> {
        let word = self.words.next();
        word.and_then(|word| word.parse().ok()).ok_or_else(|| {
            let title = match word {
                Some(word) => format!("expected {what}, found `{word}`"),
                None => format!("the line ends before {what}"),
            };
            let help = "fields are: V n x y z; S n v1 v2 v3 v4 base cmb emit name; O likewise";
            self.error(&title, "in this line", help)
        })
    }

    fn error(&self, title: &str, label: &str, help: &str) -> SceneError {
        let complaint = Complaint::new(title, label).help(help);
        self.source.error_in_line(self.line, &complaint)
    }
}
