//! The measure for pictures.

use crate::decode::Decoded;
use crate::errors::{Differences, Errors};
use crate::regions::Regions;
use radiosity_renderer::Image;
use std::collections::BTreeMap;

/// Why two pictures cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PictureError {
    /// They differ in size.
    #[error("{what} is {} x {} pixels, but the reference {} x {}", size.0, size.1, reference.0, reference.1)]
    Size {
        /// The picture or the map of regions.
        what: &'static str,
        /// Its width and height.
        size: (u32, u32),
        /// Those of the reference.
        reference: (u32, u32),
    },
    /// One of them holds a value that is no number.
    #[error("{what} has a value that is not finite, at column {x} and row {y}")]
    NotFinite {
        /// The picture or the reference.
        what: &'static str,
        /// Column, counted from 0.
        x: usize,
        /// Row, counted from 0 at the top.
        y: usize,
    },
    /// Every pixel of the reference is clamped, or black.
    #[error("the reference is black or clamped everywhere: compare at another exposure")]
    Nothing,
}

/// Brightness from which on a level counts as clamped: between the brightest two of 8 or 16 bits.
const BRIGHTEST_LEVEL: f64 = 1.0 - 1e-5;

/// The errors of a picture's linear radiance against a reference, over the pixels that the
/// reference shows unclamped (`exposure * L <= 1` in all channels), by region.
///
/// Regions are every number in the map alone (`"2"`), all numbers up to one (`"0-2"`), and
/// `"all"` pixels; those without an unclamped lit pixel are absent.
pub fn compare_pictures(
    found: &Image,
    reference: &Decoded,
    regions: Option<&Regions>,
    exposure: f64,
) -> Result<Vec<(String, Errors)>, PictureError> {
    check(found, &reference.image, regions)?;
    let brightest = if reference.levels {
        BRIGHTEST_LEVEL
    } else {
        1.0
    };
    let mut by_label: BTreeMap<u8, Differences> = BTreeMap::new();
    let pairs = found.pixels.iter().zip(&reference.image.pixels);
    for (index, (found, reference)) in pairs.enumerate() {
        let clamped = |&radiance: &f32| exposure * f64::from(radiance) > brightest;
        if reference.iter().any(clamped) {
            continue;
        }
        let label = regions.map_or(0, |regions| regions.labels[index]);
        let differences = by_label.entry(label).or_default();
        for (&found, &reference) in found.iter().zip(reference) {
            differences.add(1.0, f64::from(reference), f64::from(found));
        }
    }
    let named = name_regions(&by_label, regions.is_some());
    let errors = named
        .into_iter()
        .filter_map(|(name, d)| Some((name, d.errors()?)));
    let errors: Vec<(String, Errors)> = errors.collect();
    let whole = errors.last().is_some_and(|(name, _)| name == "all");
    if whole {
        Ok(errors)
    } else {
        Err(PictureError::Nothing)
    }
}

fn name_regions(by_label: &BTreeMap<u8, Differences>, is_map: bool) -> Vec<(String, Differences)> {
    let mut named = Vec::new();
    if is_map {
        let alone = by_label.iter();
        named.extend(alone.map(|(label, d)| (label.to_string(), d.clone())));
    }
    let mut sum = Differences::default();
    let first = by_label.keys().next();
    for (index, (label, differences)) in by_label.iter().enumerate() {
        sum.append(differences);
        if 0 < index && index + 1 < by_label.len() {
            let first = first.expect("there is this one at least");
            named.push((format!("{first}-{label}"), sum.clone()));
        }
    }
    named.push(("all".to_owned(), sum));
    named
}

fn check(found: &Image, reference: &Image, regions: Option<&Regions>) -> Result<(), PictureError> {
    let expected = (reference.width, reference.height);
    let map = regions.map(|map| ("the map of regions", (map.width, map.height)));
    let picture = ("the picture", (found.width, found.height));
    for (what, size) in [Some(picture), map].into_iter().flatten() {
        if size != expected {
            return Err(PictureError::Size {
                what,
                size,
                reference: expected,
            });
        }
    }
    for (what, image) in [("the picture", found), ("the reference", reference)] {
        let bad = |pixel: &[f32; 3]| pixel.iter().any(|channel| !channel.is_finite());
        if let Some(index) = image.pixels.iter().position(bad) {
            let width = image.width as usize;
            return Err(PictureError::NotFinite {
                what,
                x: index % width,
                y: index / width,
            });
        }
    }
    Ok(())
}
