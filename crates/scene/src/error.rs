//! What is wrong with a scene or mesh file.

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use std::fmt::{self, Display, Formatter};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// What is wrong with a scene or mesh file, where, and how to mend it.
///
/// Displayed, it is the [report](SceneError::report) with its own words of help.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError(Box<Parts>);

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Parts {
    pub(crate) title: String,
    pub(crate) label: String,
    pub(crate) path: PathBuf,
    pub(crate) place: Option<FilePlace>,
    pub(crate) help: Option<Help>,
}

/// A place in the text of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilePlace {
    /// The number of the line, from 1.
    pub line: usize,
    /// The number of the character in the line, from 1.
    pub column: usize,
    /// The line, or the lines if what is marked has several.
    pub text: String,
    /// The bytes of `text` that the error is about.
    pub marked: Range<usize>,
}

/// How to mend a scene or mesh file, in words that hold for any program. Whoever has flags or
/// buttons for it names them.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Help {
    /// A mesh in the folder of the scene, or [`MeshFiles::Anywhere`](crate::MeshFiles::Anywhere).
    MeshFolder,
    /// Something else.
    Words(String),
}

impl Display for Help {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Help::MeshFolder => "copy it there, or read it all the same",
            Help::Words(text) => text,
        })
    }
}

impl SceneError {
    /// What is wrong.
    pub fn title(&self) -> &str {
        &self.0.title
    }

    /// What is wrong with the marked text in particular. It is empty where the title says all.
    pub fn label(&self) -> &str {
        &self.0.label
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.0.path
    }

    /// Where in the file. There is none if the whole file is wrong.
    pub fn place(&self) -> Option<&FilePlace> {
        self.0.place.as_ref()
    }

    /// How to mend it, if title and label do not say it.
    pub fn help(&self) -> Option<&Help> {
        self.0.help.as_ref()
    }

    /// The title, the place with its lines, the label below the marked text, and the given help, in
    /// lines of text. It does not begin with `error:`, which is for whoever prints it.
    pub fn report(&self, help: Option<&str>) -> String {
        let Parts { title, path, .. } = &*self.0;
        let path = path.display().to_string();
        let Some(place) = self.place() else {
            let help = help.map_or_else(String::new, |help| format!("\n   = help: {help}"));
            return format!("{title}\n  --> {path}{help}");
        };
        let annotation = AnnotationKind::Primary
            .span(place.marked.clone())
            .label(self.label());
        let snippet = Snippet::source(&place.text)
            .line_start(place.line)
            .path(path)
            .annotation(annotation);
        let mut group = Level::ERROR.primary_title(title).element(snippet);
        if let Some(help) = help {
            group = group.element(Level::HELP.message(help));
        }
        let report = Renderer::plain().render(&[group]);
        match report.strip_prefix("error: ") {
            Some(rest) => rest.to_owned(),
            None => report,
        }
    }
}

impl From<Parts> for SceneError {
    fn from(parts: Parts) -> SceneError {
        SceneError(Box::new(parts))
    }
}

impl Display for SceneError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let help = self.help().map(Help::to_string);
        f.write_str(&self.report(help.as_deref()))
    }
}

impl std::error::Error for SceneError {}
