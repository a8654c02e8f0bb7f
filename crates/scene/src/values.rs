//! Values of scene files with more than one spelling, and range checks.

use crate::source::{Complaint, SceneError, Source};
use radiosity_geometry::{DVec3, Divisions};
use serde::de::{Deserialize, Deserializer, Error, Expected, SeqAccess, Visitor};
use std::fmt;
use toml::Spanned;

/// `0.75` or `[0.75, 0.25, 0.25]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Color(pub(crate) [f64; 3]);

/// `12` or `[12, 8]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counts(pub(crate) u32, pub(crate) u32);

/// `[1, 2, 3]`. An array of three would drop what follows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triple([f64; 3]);

/// A triple, and where it stands.
pub(crate) type Vector = Spanned<Triple>;

impl<'de> Deserialize<'de> for Color {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Color, D::Error> {
        struct ColorVisitor;
        impl<'de> Visitor<'de> for ColorVisitor {
            type Value = Color;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or three numbers [red, green, blue]")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Color, E> {
                Ok(Color([value; 3]))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Color, E> {
                Ok(Color([value as f64; 3]))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, sequence: A) -> Result<Color, A::Error> {
                numbers(sequence, &self).map(Color)
            }
        }
        deserializer.deserialize_any(ColorVisitor)
    }
}

impl<'de> Deserialize<'de> for Triple {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Triple, D::Error> {
        struct TripleVisitor;
        impl<'de> Visitor<'de> for TripleVisitor {
            type Value = Triple;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("three numbers [x, y, z]")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, sequence: A) -> Result<Triple, A::Error> {
                numbers(sequence, &self).map(Triple)
            }
        }
        deserializer.deserialize_seq(TripleVisitor)
    }
}

impl<'de> Deserialize<'de> for Counts {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Counts, D::Error> {
        struct CountsVisitor;
        impl<'de> Visitor<'de> for CountsVisitor {
            type Value = Counts;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a whole number or two whole numbers [along a, along b]")
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Counts, E> {
                let unexpected = serde::de::Unexpected::Signed(value);
                let count =
                    u32::try_from(value).map_err(|_| Error::invalid_value(unexpected, &self))?;
                Ok(Counts(count, count))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, sequence: A) -> Result<Counts, A::Error> {
                exactly(all(sequence)?, &self, "").map(|[a, b]| Counts(a, b))
            }
        }
        deserializer.deserialize_any(CountsVisitor)
    }
}

/// Three numbers or so. Those with decimal commas are too many, and all whole.
fn numbers<'de, A: SeqAccess<'de>, const N: usize>(
    sequence: A,
    expected: &dyn Expected,
) -> Result<[f64; N], A::Error> {
    let values: Vec<f64> = all(sequence)?;
    let is_too_many = values.len() > N && values.len() <= 2 * N;
    let hint = if is_too_many && values.iter().all(|x| x.fract() == 0.0) {
        ": decimals take a point, as in 2.5"
    } else {
        ""
    };
    exactly(values, expected, hint)
}

/// So many values, neither more nor fewer.
fn exactly<T, E: Error, const N: usize>(
    values: Vec<T>,
    expected: &dyn Expected,
    hint: &str,
) -> Result<[T; N], E> {
    let found = values.len();
    values
        .try_into()
        .map_err(|_| Error::custom(format_args!("expected {expected}, found {found}{hint}")))
}

fn all<'de, T: Deserialize<'de>, A: SeqAccess<'de>>(mut sequence: A) -> Result<Vec<T>, A::Error> {
    std::iter::from_fn(|| sequence.next_element().transpose()).collect()
}

/// Checks a value by a condition on the value inside its span.
pub(crate) fn require<T>(
    source: &Source<'_>,
    value: &Spanned<T>,
    holds: impl FnOnce(&T) -> bool,
    what: &str,
    range: &str,
) -> Result<(), SceneError> {
    if holds(value.get_ref()) {
        return Ok(());
    }
    let complaint = Complaint::new(
        format!("{what} is out of range"),
        format!("must be {range}"),
    );
    Err(source.error(value.span(), &complaint))
}

/// Bytes of a name: what can be printed in a line.
pub(crate) const MOST_NAME: usize = 400;

/// Refuses names that are empty or cannot be printed.
pub(crate) fn check_name(
    source: &Source<'_>,
    name: &Spanned<String>,
    what: &str,
) -> Result<(), SceneError> {
    require(
        source,
        name,
        |name| !name.trim().is_empty(),
        what,
        "some text",
    )?;
    let range = format!("at most {MOST_NAME} bytes long");
    require(source, name, |name| name.len() <= MOST_NAME, what, &range)
}

/// A vector of finite numbers.
pub(crate) fn vector(source: &Source<'_>, value: &Vector, what: &str) -> Result<DVec3, SceneError> {
    let finite = |Triple(v): &Triple| v.iter().all(|x| x.is_finite());
    require(source, value, finite, what, "three finite numbers")?;
    Ok(DVec3::from(value.get_ref().0))
}

/// The subdivision that a table's `divisions` and `max_patch_edge` describe, if any.
pub(crate) fn divisions(
    source: &Source<'_>,
    counts: Option<&Spanned<Counts>>,
    max_edge: Option<&Spanned<f64>>,
) -> Result<Option<Divisions>, SceneError> {
    match (counts, max_edge) {
        (Some(_), Some(max_edge)) => {
            let complaint = Complaint::new(
                "`divisions` and `max_patch_edge` exclude each other",
                "remove this or `divisions`",
            );
            Err(source.error(max_edge.span(), &complaint))
        }
        (Some(counts), None) => {
            let positive = |&Counts(a, b): &Counts| a > 0 && b > 0;
            require(source, counts, positive, "`divisions`", "at least 1")?;
            let Counts(a, b) = *counts.get_ref();
            Ok(Some(Divisions::Count { a, b }))
        }
        (None, Some(max_edge)) => {
            let positive = |&length: &f64| length > 0.0 && length.is_finite();
            require(
                source,
                max_edge,
                positive,
                "`max_patch_edge`",
                "a positive length",
            )?;
            Ok(Some(Divisions::MaxEdge(*max_edge.get_ref())))
        }
        (None, None) => Ok(None),
    }
}
