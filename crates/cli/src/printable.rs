//! Text that can be printed as it is. Names come from files that others made: what would move the
//! cursor, recolour the terminal or turn the direction of writing is shown as its code instead.

use std::fmt::Write;

/// No line has more characters, so that a long name does not flood the terminal. Longer ones lose
/// their middle; paths are no longer than 4096 bytes.
const LONGEST_LINE: usize = 5000;
/// The same of a name in a table.
const LONGEST_NAME: usize = 48;

/// One line.
pub(super) fn line(text: &str) -> String {
    shortened(
        escaped(text, |code| format!("\\u{{{code:x}}}")),
        LONGEST_LINE,
    )
}

/// A name in a table of names.
pub(super) fn name(text: &str) -> String {
    shortened(line(text), LONGEST_NAME)
}

/// Some lines, apart by line breaks.
pub(super) fn lines(text: &str) -> String {
    let lines: Vec<String> = text.split('\n').map(line).collect();
    lines.join("\n")
}

/// JSON, which stays JSON: such characters are only in its strings.
pub(super) fn json(text: &str) -> String {
    escaped(text, |code| format!("\\u{code:04x}"))
}

fn escaped(text: &str, code: impl Fn(u32) -> String) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        if is_command(character) {
            safe.push_str(&code(u32::from(character)));
        } else {
            safe.push(character);
        }
    }
    safe
}

/// Control characters, line breaks among them, and those that change the direction of writing
/// (Unicode Standard Annex 9).
fn is_command(character: char) -> bool {
    character.is_control()
        || matches!(character,
            '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

fn shortened(line: String, longest: usize) -> String {
    let count = line.chars().count();
    if count <= longest {
        return line;
    }
    let part = longest / 2;
    let mut short: String = line.chars().take(part).collect();
    write!(short, " ... {} characters ... ", count - 2 * part).expect("strings take all text");
    short.extend(line.chars().skip(count - part));
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_to_the_terminal_are_shown_as_codes() {
        let name = "la\x1b]0;mine\x07mp\r\n\t\u{9b}31m";
        let expected = "la\\u{1b}]0;mine\\u{7}mp\\u{d}\\u{a}\\u{9}\\u{9b}31m";
        assert_eq!(line(name), expected);
        assert_eq!(line("gauche\u{202e}etiord"), "gauche\\u{202e}etiord");
        assert_eq!(lines("a\x1b\n b\r"), "a\\u{1b}\n b\\u{d}");
        assert_eq!(
            line("W/m²: größer, 照明, مصباح"),
            "W/m²: größer, 照明, مصباح"
        );
    }

    #[test]
    fn json_stays_json() {
        let name = "\u{7f}\u{9b}\u{202e}\x1b\"\\ plain";
        let text = json(&serde_json::to_string(name).unwrap());
        assert!(!text.chars().any(is_command), "{text}");
        assert_eq!(serde_json::from_str::<String>(&text).unwrap(), name);
    }

    #[test]
    fn long_lines_lose_their_middle() {
        let text = format!("begin {} end", "ä".repeat(1_000_000));
        let short = line(&text);
        assert!(short.chars().count() < LONGEST_LINE + 40);
        assert!(short.starts_with("begin ää") && short.ends_with("ää end"));
        assert!(
            short.contains(" ... 995010 characters ... "),
            "{}",
            &short[4990..5090]
        );
        assert_eq!(line(&"x".repeat(LONGEST_LINE)).len(), LONGEST_LINE);
    }
}
