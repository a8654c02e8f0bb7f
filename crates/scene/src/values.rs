//! Values of scene files with more than one spelling, and range checks.

use crate::source::{Complaint, SceneError, Source};
use radiosity_geometry::DVec3;
use serde::de::{Deserialize, Deserializer, Error, Expected, SeqAccess, Visitor};
use std::fmt;
use toml::Spanned;

/// `0.75` or `[0.75, 0.25, 0.25]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Color(pub(crate) [f64; 3]);

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
