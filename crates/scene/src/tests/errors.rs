//! Errors as parts, for programs that show them in their own way.

use super::{GOOD, parse};
use crate::{Help, SceneError};
use std::path::Path;

fn error_of(from: &str, to: &str) -> SceneError {
    parse(Path::new("test.toml"), &GOOD.replacen(from, to, 1)).unwrap_err()
}

#[test]
fn errors_have_parts() {
    let error = error_of("material = \"white\"", "material = \"whit\"");
    assert_eq!(error.title(), "there is no material `whit`");
    assert_eq!(error.label(), "unknown");
    assert_eq!(error.path(), Path::new("test.toml"));
    let place = error.place().unwrap();
    assert_eq!((place.line, place.column), (16, 12));
    assert_eq!(place.text, "material = \"whit\"");
    assert_eq!(&place.text[place.marked.clone()], "\"whit\"");
    let help = Help::Words("did you mean `white`?".to_owned());
    assert_eq!(error.help(), Some(&help));
}

#[test]
fn columns_are_those_of_the_report() {
    for (from, to) in [
        (
            "[materials.white]",
            "[lights.\"ä\u{1f4a1}\"]\r\ndim\t= -1\r\n[x]",
        ),
        ("edge_b = [0, 1, 0]", "\"ä\u{1f4a1}\" = 1"),
    ] {
        let error = error_of(from, to);
        let place = error.place().unwrap();
        let at = format!(" --> test.toml:{}:{}\n", place.line, place.column);
        assert!(error.to_string().contains(&at), "{error}");
    }
}

#[test]
fn whole_files_are_wrong_at_no_place() {
    let error = crate::read(Path::new("missing.toml")).unwrap_err();
    assert_eq!((error.place(), error.label()), (None, ""));
    let said = error.to_string();
    let end = "\n  --> missing.toml\n   = help: give the path of a scene file (.toml, .vs3)";
    assert!(
        said.starts_with(error.title()) && said.ends_with(end),
        "{said}"
    );
}

#[test]
fn help_is_said_in_other_words() {
    let error = error_of("material = \"white\"", "material = \"whit\"");
    let said = error.report(Some("press the button"));
    assert_eq!(
        error
            .to_string()
            .replace("did you mean `white`?", "press the button"),
        said
    );
    let without = error.report(None);
    assert!(!without.contains("help"), "{without}");
}
