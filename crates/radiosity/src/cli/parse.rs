//! Values on the command line.

use std::path::PathBuf;

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
    let limits = 1..=1 << 16;
    match parse_counts(text) {
        Ok((w, h)) if text.contains('x') && limits.contains(&w) && limits.contains(&h) => {
            Ok((w, h))
        }
        _ => Err("expected width and height between 1 and 65536, like 640x480".to_owned()),
    }
}

pub(super) fn parse_positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(x) if x > 0.0 && f64::is_finite(x) => Ok(x),
        _ => Err("expected a positive number".to_owned()),
    }
}

pub(super) fn parse_row_tolerance(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(tolerance) if (1e-6..=0.1).contains(&tolerance) => Ok(tolerance),
        _ => Err("must be a number from 1e-6 to 0.1".to_owned()),
    }
}

pub(super) fn parse_tolerance(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(x) if x > 0.0 && x < 1.0 => Ok(x),
        _ => Err("expected a number between 0 and 1, like 1e-6".to_owned()),
    }
}

pub(super) fn parse_csv_path(text: &str) -> Result<PathBuf, String> {
    parse_path(text, &["csv"])
}

pub(super) fn parse_matrix_path(text: &str) -> Result<PathBuf, String> {
    parse_path(text, &["npy", "csv"])
}

pub(super) fn parse_threshold(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(x) if (0.0..1.0).contains(&x) => Ok(x),
        _ => Err("expected a number from 0 to 1, like 1e-6".to_owned()),
    }
}

pub(super) fn parse_difference_path(text: &str) -> Result<PathBuf, String> {
    parse_path(text, &["png", "pfm"])
}

pub(super) fn parse_path(text: &str, endings: &[&str]) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.extension() {
        Some(found) if endings.iter().any(|ending| found == *ending) => Ok(path),
        _ => Err(format!(
            "expected a path that ends in .{}",
            endings.join(" or .")
        )),
    }
}
