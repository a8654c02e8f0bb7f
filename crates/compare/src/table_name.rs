//! Names in tables that people open with spreadsheets, which take a cell that begins with `=`, `+`,
//! `-`, `@`, a tab or a carriage return for a formula, and run it. An apostrophe before it makes it
//! text.

use std::borrow::Cow;

/// A name as tables have it.
pub fn table_name(name: &str) -> Cow<'_, str> {
    if is_risky(name) {
        Cow::Owned(format!("'{name}"))
    } else {
        Cow::Borrowed(name)
    }
}

/// The name that [`table_name`] was given.
pub(crate) fn name_in_table(cell: &str) -> &str {
    let name = cell.strip_prefix('\'');
    name.filter(|name| is_risky(name)).unwrap_or(cell)
}

/// Whatever apostrophes it has of its own: one more can be taken away again.
fn is_risky(name: &str) -> bool {
    let text = name.trim_start_matches('\'');
    text.starts_with(['=', '+', '-', '@', '\t', '\r'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_become_text_and_come_back() {
        for (name, expected) in [
            ("=1+1", "'=1+1"),
            ("+lamp", "'+lamp"),
            ("-", "'-"),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("\tx", "'\tx"),
            ("\rx", "'\rx"),
            ("'=x", "''=x"),
            ("'quoted'", "'quoted'"),
            ("floor - 1", "floor - 1"),
            ("", ""),
        ] {
            assert_eq!(table_name(name), expected);
            assert_eq!(name_in_table(expected), name);
        }
    }
}
