//! Numbers and names, as people read them.

use std::collections::BTreeSet;

/// So many surfaces are named.
const MOST_NAMED: usize = 6;

/// A number with its thousands apart.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// How many there are of something: one of it, or more.
pub fn counted(n: usize, [one, more]: [&str; 2]) -> String {
    format!("{} {}", grouped(n as u64), if n == 1 { one } else { more })
}

/// For [`counted`].
pub const SURFACES: [&str; 2] = ["surface", "surfaces"];
/// For [`counted`].
pub const PATCHES: [&str; 2] = ["patch", "patches"];
/// For [`counted`].
pub const PAIRS: [&str; 2] = ["pair of patches", "pairs of patches"];
/// For [`counted`].
pub const ROWS: [&str; 2] = ["row", "rows"];

/// A size in decimal units.
pub fn bytes(n: u64) -> String {
    let units = ["B", "kB", "MB", "GB", "TB"];
    let mut size = n as f64;
    let mut unit = 0;
    while size >= 999.5 && unit + 1 < units.len() {
        size /= 1000.0;
        unit += 1;
    }
    if unit == 0 || size >= 99.5 {
        format!("{size:.0} {}", units[unit])
    } else {
        format!("{size:.1} {}", units[unit])
    }
}

/// A duration in words.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "under a second".to_owned(),
        s if s < 100.0 => format!("about {s:.0} s"),
        s if s < 5400.0 => format!("about {:.0} min", s / 60.0),
        s => format!("about {:.1} h", s / 3600.0),
    }
}

/// The names of some surfaces, the first few of them.
pub fn named(names: BTreeSet<&str>) -> String {
    let count = names.len();
    let some: Vec<&str> = names.into_iter().take(MOST_NAMED).collect();
    let more = match count.saturating_sub(MOST_NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!("`{}`{more}", some.join("`, `"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_are_readable() {
        assert_eq!(
            ["0", "999", "1,728", "1,492,128"],
            [0, 999, 1728, 1_492_128].map(grouped)[..]
        );
        assert_eq!(
            ["0 patches", "1 patch", "2,400 patches"],
            [0, 1, 2400].map(|n| counted(n, PATCHES))[..]
        );
        let sizes = [12, 999, 1_000, 5_968_512, 123_456_789, 1_530_000_000].map(bytes);
        assert_eq!(
            sizes,
            ["12 B", "999 B", "1.0 kB", "6.0 MB", "123 MB", "1.5 GB"]
        );
        let times = [0.1, 7.4, 600.0, 9000.0].map(duration);
        assert_eq!(
            times,
            ["under a second", "about 7 s", "about 10 min", "about 2.5 h"]
        );
    }
}
