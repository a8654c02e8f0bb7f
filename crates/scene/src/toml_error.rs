//! What TOML and serde say of a scene file, in words that are no program's, and how to mend it.

use crate::error::SceneError;
use crate::source::{Complaint, Source, suggestion};
use std::ops::Range;

/// What TOML or serde say, at their place or at another.
pub(crate) fn error_of(
    source: &Source<'_>,
    error: &toml::de::Error,
    place: Range<usize>,
) -> SceneError {
    let complaint = Complaint::new("cannot read this scene", plain(error.message()));
    let complaint = match help_for(source, error.message()) {
        Some(help) => complaint.help(help),
        None => complaint,
    };
    source.error(error.span().unwrap_or(place), &complaint)
}

/// What serde says of types, in words that are no program's.
fn plain(message: &str) -> String {
    const TYPES: [(&str, &str); 10] = [
        ("expected struct MeshTable", "expected a table"),
        ("expected f64", "expected a number"),
        ("expected u32", "expected a whole number from 0"),
        ("expected a sequence", "expected a list"),
        ("invalid type: map", "this is a table"),
        ("invalid type: sequence", "this is a list"),
        ("invalid type: floating point", "this is the number"),
        ("invalid type: integer", "this is the number"),
        ("invalid type: string", "this is the text"),
        ("invalid type: boolean", "this is"),
    ];
    let replace = |text: String, (from, to): (&str, &str)| text.replace(from, to);
    TYPES.into_iter().fold(message.to_owned(), replace)
}

/// How to mend what TOML or serde say, where that is known.
fn help_for(source: &Source<'_>, message: &str) -> Option<String> {
    let known = [
        (
            "map, expected a sequence",
            "write a list in brackets; of tables, the name in two brackets, like [[surfaces]]",
        ),
        (
            "map, expected a string",
            "write a name in quotes; of names with dots all, like \"Red.001\" = \"red\"",
        ),
        (
            "expected struct MeshTable",
            "write mesh = { file = \"NAME.obj\" }",
        ),
        ("unicode value", "write / instead of \\ in paths"),
    ];
    if let Some((_, help)) = known.into_iter().find(|(part, _)| message.contains(part)) {
        return Some(help.to_owned());
    }
    if let Some(rest) = message.strip_prefix("unknown field ") {
        // The first name in quotes is the one that is not known, the others are.
        let mut names = rest.split('`').skip(1).step_by(2);
        let wanted = names.next()?;
        return suggestion(wanted, names).filter(|help| help.starts_with("did you mean"));
    }
    let is_toml = source
        .path
        .extension()
        .is_some_and(|ending| ending == "toml");
    (!is_toml).then(|| "a file whose name does not end in .vs3 is read as TOML".to_owned())
}
