//! Values on the command line.

use clap::builder::{OsStringValueParser, TypedValueParser};
use radiosity::params::NumberOrWord;
use radiosity::scene::MOST_DIMMING;
use std::path::PathBuf;
use std::time::Duration;

/// Units of time, in seconds.
const OF_TIME: [(&str, f64); 5] = [
    ("s", 1.0),
    ("min", 60.0),
    ("h", 3600.0),
    ("d", 86_400.0),
    ("w", 604_800.0),
];
/// Units of size, in bytes: those that sizes are told in.
const OF_SIZE: [(&str, f64); 5] = [
    ("B", 1.0),
    ("kB", 1e3),
    ("MB", 1e6),
    ("GB", 1e9),
    ("TB", 1e12),
];

pub(super) fn parse_counts(text: &str) -> Result<(u32, u32), String> {
    let counts = match text.split_once('x') {
        Some((a, b)) => (a.parse(), b.parse()),
        None => (text.parse(), text.parse()),
    };
    match counts {
        (Ok(a), Ok(b)) if a > 0 && b > 0 => Ok((a, b)),
        _ => Err("expected a positive whole number like 12, or two like 12x8".to_owned()),
    }
}

pub(super) fn parse_size(text: &str) -> Result<(u32, u32), String> {
    match parse_counts(text) {
        Ok(size) if text.contains('x') => Ok(size),
        _ => Err("expected width and height, like 640x480".to_owned()),
    }
}

pub(super) fn parse_number(text: &str) -> Result<f64, String> {
    let number = text.parse();
    number.map_err(|_| "expected a number like 0.001".to_owned())
}

pub(super) fn parse_positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(x) if x > 0.0 && f64::is_finite(x) => Ok(x),
        _ => Err("expected a positive number".to_owned()),
    }
}

/// `7d`.
pub(super) fn parse_age(text: &str) -> Result<Duration, String> {
    let seconds = with_unit(text, &OF_TIME);
    let age = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    age.ok_or("expected a number and a unit (s, min, h, d or w), like 7d".to_owned())
}

/// `2GB`.
pub(super) fn parse_bytes(text: &str) -> Result<u64, String> {
    let bytes = with_unit(text, &OF_SIZE).map(|bytes| bytes as u64);
    bytes.ok_or("expected a number and a unit (B, kB, MB, GB or TB), like 2GB".to_owned())
}

/// A number, not negative, before one of these units, which may be in capitals or not.
fn with_unit(text: &str, units: &[(&str, f64)]) -> Option<f64> {
    let number_end = text
        .trim_end_matches(|c: char| c.is_ascii_alphabetic())
        .len();
    let (number, unit) = text.split_at(number_end);
    let (_, size) = units
        .iter()
        .find(|(name, _)| name.eq_ignore_ascii_case(unit))?;
    let value = number.trim().parse::<f64>().ok()? * size;
    (value >= 0.0 && value.is_finite()).then_some(value)
}

pub(super) fn parse_threshold(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(x) if (0.0..1.0).contains(&x) => Ok(x),
        _ => Err("expected a number from 0 to below 1, like 1e-6".to_owned()),
    }
}

/// Any path that has one of these endings, whatever bytes it is made of.
pub(super) fn path_ending_in(
    endings: &'static [&'static str],
) -> impl TypedValueParser<Value = PathBuf> {
    OsStringValueParser::new().try_map(move |text| {
        let path = PathBuf::from(text);
        match path.extension() {
            Some(found) if endings.iter().any(|ending| found == *ending) => Ok(path),
            _ => Err(format!(
                "expected a path that ends in .{}",
                endings.join(" or .")
            )),
        }
    })
}

/// A number, or the word that the parameter may be.
pub(super) fn number_or_word<T: NumberOrWord>(text: &str) -> Result<T, String> {
    if text == T::WORD {
        return Ok(T::new(None));
    }
    let number = text.parse().map(|number| T::new(Some(number)));
    number.map_err(|_| format!("expected a number, or {}", T::WORD))
}

/// A patch by its surface and its place there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PatchName {
    /// The surface.
    pub surface: String,
    /// As exported tables have it: the cell along either edge, or a polygon of a mesh file and the
    /// position in it.
    pub cell: [u32; 2],
}

/// What a picture may be scaled to; beyond, single precision ends.
pub(super) fn parse_top(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(top) if (1e-30..=1e30).contains(&top) => Ok(top),
        _ => Err("expected a number between 1e-30 and 1e30".to_owned()),
    }
}

pub(super) fn parse_directions(text: &str) -> Result<u32, String> {
    let hint = "expected a whole number; a scene's name goes before it";
    text.parse().map_err(|_| hint.to_owned())
}

/// `floor:3,4`.
pub(super) fn parse_patch(text: &str) -> Result<PatchName, String> {
    let known = text.rsplit_once(':').and_then(|(surface, cell)| {
        let (a, b) = cell.split_once(',')?;
        Some(PatchName {
            surface: surface.to_owned(),
            cell: [a.trim().parse().ok()?, b.trim().parse().ok()?],
        })
    });
    known.ok_or(
        "expected a surface and two numbers, as in exported tables, like floor:3,4".to_owned(),
    )
}

/// `lamp=0.3`.
pub(super) fn parse_dim(text: &str) -> Result<(String, f64), String> {
    let (light, factor) = of_light(text)?;
    Ok((light, parse_dimming(factor)?))
}

/// `lamp=1,0.8,0.6`.
pub(super) fn parse_tint(text: &str) -> Result<(String, [f64; 3]), String> {
    let (light, factors) = of_light(text)?;
    let factors: Result<Vec<f64>, String> = factors.split(',').map(parse_dimming).collect();
    let factors = <[f64; 3]>::try_from(factors?);
    let factors = factors.map_err(|_| "give three factors: LIGHT=R,G,B".to_owned())?;
    Ok((light, factors))
}

/// The light's name and what comes after the last `=`.
fn of_light(text: &str) -> Result<(String, &str), String> {
    let (light, value) = text
        .rsplit_once('=')
        .ok_or("give the light's name, =, and factors")?;
    Ok((light.to_owned(), value))
}

fn parse_dimming(text: &str) -> Result<f64, String> {
    match text.trim().parse() {
        Ok(factor) if (0.0..=MOST_DIMMING).contains(&factor) => Ok(factor),
        _ => Err(format!("`{text}` is not a factor between 0 and 1000")),
    }
}
