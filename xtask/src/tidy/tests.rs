//! Each rule finds its fault in a small text, and lets a good one pass.

use super::text::WORDS;
use super::{File, Finding, check, exceptions};

fn file(path: &str, text: &str) -> File {
    File {
        path: path.to_owned(),
        text: text.to_owned(),
    }
}

/// Rule, line and subject of all findings in some files.
fn found(files: &[(&str, &str)]) -> Vec<(&'static str, usize, String)> {
    let files: Vec<File> = files.iter().map(|(path, text)| file(path, text)).collect();
    let findings = check(&files).into_iter();
    findings
        .map(|found| (found.rule, found.line, found.what))
        .collect()
}

fn one(rule: &'static str, line: usize, what: &str) -> Vec<(&'static str, usize, String)> {
    vec![(rule, line, what.to_owned())]
}

#[test]
fn files_open_with_what_they_hold() {
    assert_eq!(found(&[("a.rs", "//! Rays.\n")]), []);
    assert_eq!(found(&[("a.rs", "// Rays.\n")]), one("opening", 1, ""));
    assert_eq!(found(&[("a.rs", "")]), one("opening", 1, ""));
    assert_eq!(found(&[("a.toml", "")]), []);
}

#[test]
fn long_files_say_why() {
    let text = |head: &str, lines| format!("//! Rays.\n{head}{}", "\n".repeat(lines));
    let why = "//! Long because: of rays.\n";
    assert_eq!(found(&[("a.rs", &text("", 249))]), []);
    assert_eq!(found(&[("a.rs", &text("", 250))]), one("length", 1, ""));
    assert_eq!(found(&[("a.rs", &text(why, 249))]), []);
    // A reason that is no longer needed, and one where nobody looks for it.
    assert_eq!(found(&[("a.rs", &text(why, 248))]), one("length", 1, ""));
    let below = format!("{}{why}", text("", 250));
    assert_eq!(found(&[("a.rs", &below)]), one("length", 1, ""));
    assert_eq!(found(&[("a.md", &text("", 250))]), []);
}

#[test]
fn lines_fit_into_windows() {
    let source = |columns| format!("//! Rays.\n{}\n", "ü".repeat(columns));
    assert_eq!(found(&[("a.rs", &source(100))]), []);
    assert_eq!(found(&[("a.rs", &source(101))]), one("columns", 2, ""));
    let document = |line: String| found(&[("a.md", &line)]);
    let words = |columns| "w".repeat(columns);
    assert_eq!(document(words(120)), []);
    assert_eq!(document(words(121)), one("columns", 1, ""));
    assert_eq!(
        document(format!("{} [b]", words(117))),
        one("columns", 1, "")
    );
    // Tables, code and addresses cannot be broken.
    assert_eq!(document(format!("| {} |", words(121))), []);
    assert_eq!(document(format!("```\n{}\n```", words(121))), []);
    let after = format!("```\n```\n{}", words(121));
    assert_eq!(document(after), one("columns", 3, ""));
    assert_eq!(document(format!("see https://{}", words(121))), []);
    assert_eq!(document(format!("[b](https://{})", words(121))), []);
    assert_eq!(found(&[("a.rs", &format!("//! | {} |\n", words(121)))]), []);
}

#[test]
fn words_are_those_of_the_field() {
    for (word, better) in WORDS {
        let text = format!("It says {word}, here.\n");
        assert_eq!(found(&[("a.md", &text)]), one("words", 1, word));
        let part = format!("{word}_a a_{word} {word}s {better}\n");
        assert_eq!(found(&[("a.md", &part)]), []);
    }
}

#[test]
fn a_type_means_one_thing() {
    let both = |a: &str, b: &str| {
        let [a, b] = [a, b].map(|text| format!("//! Rays.\n{text}\n"));
        found(&[("crates/a/src/lib.rs", &a), ("crates/b/src/x.rs", &b)])
    };
    assert_eq!(both("pub struct Ray;", "pub struct Rays;"), []);
    assert_eq!(
        both("pub struct Ray;", "enum Ray {"),
        one("types", 2, "Ray")
    );
    assert_eq!(
        both("pub trait Ray {", "pub(crate) type Ray<T> = T;").len(),
        1
    );
    assert_eq!(both("pub struct Ray<'a> {", "pub enum Ray {").len(), 2);
    // Nobody sees both of two private ones, nor those inside of functions.
    assert_eq!(both("struct Ray;", "struct Ray;"), []);
    assert_eq!(both("pub struct Ray;", "    struct Ray;"), []);
    let (ray, test) = ("//! Rays.\npub struct Ray;\n", "crates/b/src/x/tests.rs");
    assert_eq!(found(&[("crates/a/src/lib.rs", ray), (test, ray)]), []);
    assert_eq!(
        found(&[("crates/a/src/lib.rs", ray), ("crates/a/src/b.rs", ray)]),
        []
    );
}

#[test]
fn links_lead_somewhere() {
    let to = |link: &str| {
        let text = format!("# Rays & boxes_2\n\n[a]({link})\n");
        let other = "# A\n## B\n```\n# No\n```\n";
        found(&[
            ("docs/a.md", &text),
            ("docs/b.md", other),
            ("src/c.rs", "//! C.\n"),
        ])
    };
    let good = [
        "b.md",
        "./b.md#a",
        "b.md#b",
        "../src/c.rs",
        "../src",
        "#rays--boxes_2",
        "https://a.b/c",
        "mailto:a@b.c",
    ];
    for link in good {
        assert_eq!(to(link), [], "{link}");
    }
    for link in ["c.md", "src/c.rs", "b.md#a-2", "b.md#no", "#a", "../sr"] {
        assert_eq!(to(link), one("links", 3, link));
    }
    assert_eq!(found(&[("a.md", "```\n[a](b.md)\n```\n")]), []);
}

#[test]
fn exceptions_are_needed_and_have_reasons() {
    let left = |text: &str| {
        let files = [file("a/b.rs", "use c;\n"), file("a/d.md", "overdone\n")];
        let left = exceptions::apply(check(&files), text).into_iter();
        left.map(|Finding { rule, line, .. }| (rule, line))
            .collect::<Vec<_>>()
    };
    let (opening, words) = (("opening", 1), ("words", 1));
    assert_eq!(left(""), [opening, words]);
    assert_eq!(left("# none\n\nopening | a/b.rs | | it is made\n"), [words]);
    assert_eq!(left("opening | a/ | | x\nwords | a/ | overdone | x\n"), []);
    for useless in [
        "words | a | | x",
        "words | a/ | spots | x",
        "words | a/b.rs | | x",
    ] {
        assert_eq!(
            left(useless),
            [opening, words, ("exceptions", 1)],
            "{useless}"
        );
    }
    let twice = "words | a/ | | x\nwords | a/d.md | | x\n";
    assert_eq!(left(twice), [opening, ("exceptions", 2)]);
    for broken in [
        "words | a/ | overdone |",
        "words a/",
        "words | a/ | overdone",
    ] {
        assert_eq!(
            left(broken),
            [opening, words, ("exceptions", 1)],
            "{broken}"
        );
    }
}
