//! Measured numbers, what is promised of them, and how they are printed.

use serde::Serialize;
use std::io::Write;

/// A measured number and what is promised of it.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Figure {
    pub(crate) name: String,
    /// `null` where there is nothing to measure.
    pub(crate) value: Option<f64>,
    unit: &'static str,
    /// What is promised, if anything is.
    target: Option<Target>,
    /// Whether the promise is kept.
    holds: Option<bool>,
}

#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Target {
    AtLeast(f64),
    Between(f64, f64),
}

impl std::fmt::Display for Target {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Target::AtLeast(least) => write!(f, "target: at least {least}"),
            Target::Between(least, most) => write!(f, "target: {least} to {most}"),
        }
    }
}

impl Figure {
    pub(crate) fn new(
        name: String,
        value: Option<f64>,
        unit: &'static str,
        target: Option<Target>,
    ) -> Figure {
        let keeps = |target: Target| {
            value.is_some_and(|value| match target {
                Target::AtLeast(least) => value >= least,
                Target::Between(least, most) => (least..=most).contains(&value),
            })
        };
        Figure {
            name,
            value,
            unit,
            target,
            holds: target.map(keeps),
        }
    }

    /// For people.
    pub(crate) fn say(&self) {
        let value = self.value.unwrap_or(f64::NAN);
        let promise = self.target.map_or_else(String::new, |target| {
            let kept = if self.holds == Some(true) {
                "kept"
            } else {
                "missed"
            };
            format!(" ({target}: {kept})")
        });
        let (name, unit) = (&self.name, self.unit);
        line(&format!("{name:<44}{value:>10.3} {unit}{promise}"));
    }

    /// As one line of JSON.
    pub(crate) fn print(&self) {
        line(&serde_json::to_string(self).expect("plain data always encodes"));
    }
}

/// Prints figures, for people or as JSON.
pub(crate) fn show(figures: &[Figure], json: bool) {
    let show = if json { Figure::print } else { Figure::say };
    figures.iter().for_each(show);
}

/// Prints a line; that nobody reads it any more (`| head`) is no error.
fn line(text: &str) {
    let _ = writeln!(std::io::stdout(), "{text}");
}
