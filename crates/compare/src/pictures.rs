//! The measure for pictures.

use crate::errors::{Differences, Errors};
use radiosity_image::{Decoded, Image, Regions};
use std::collections::BTreeMap;

/// Why two pictures cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PictureError {
    /// They differ in size.
    #[error(
        "{what} is {} x {} pixels, but the reference {} x {}",
        size.0, size.1, reference.0, reference.1
    )]
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
///
/// ```
/// use radiosity_compare::compare_pictures;
/// use radiosity_image::{Decoded, Image};
///
/// let grey = |levels: [f32; 2]| Image {
///     width: 2,
///     height: 1,
///     pixels: levels.map(|level| [level; 3]).to_vec(),
/// };
/// let reference = Decoded {
///     image: grey([0.25, 0.75]),
///     levels: false,
/// };
/// let errors = compare_pictures(&grey([0.25, 0.8125]), &reference, None, 1.0)?;
/// // Half of the pixels are too bright by 0.0625, and the reference's mean is 0.5.
/// let (name, all) = &errors[0];
/// assert_eq!((name.as_str(), all.bias_percent), ("all", 6.25));
/// # Ok::<(), radiosity_compare::PictureError>(())
/// ```
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
    let label_of = |index: usize| regions.map_or(0, |regions| regions.labels[index]);
    let clamped = |&radiance: &f32| exposure * f64::from(radiance) > brightest;
    let mut by_label = empty(reference.image.pixels.len(), label_of);
    let pairs = found.pixels.iter().zip(&reference.image.pixels);
    for (index, (found, reference)) in pairs.enumerate() {
        if reference.iter().any(clamped) {
            continue;
        }
        let differences = by_label.entry(label_of(index)).or_default();
        for (&found, &reference) in found.iter().zip(reference) {
            differences.add(1.0, f64::from(reference), f64::from(found));
        }
    }
    let errors = by_region(by_label, regions.is_some());
    let whole = errors.last().is_some_and(|(name, _)| name == "all");
    if whole {
        Ok(errors)
    } else {
        Err(PictureError::Nothing)
    }
}

/// Room for the differences of each region, and no more: it is most of what a comparison takes.
fn empty(pixels: usize, label_of: impl Fn(usize) -> u8) -> BTreeMap<u8, Differences> {
    let mut counts: BTreeMap<u8, usize> = BTreeMap::new();
    (0..pixels).for_each(|index| *counts.entry(label_of(index)).or_default() += 1);
    let labels = counts.into_iter();
    labels
        .map(|(label, pixels)| (label, Differences::with_capacity(3 * pixels)))
        .collect()
}

/// The errors of every region, of all up to one, and of all.
fn by_region(by_label: BTreeMap<u8, Differences>, is_map: bool) -> Vec<(String, Errors)> {
    let (mut alone, mut joined) = (Vec::new(), Vec::new());
    let first = by_label.keys().next().copied().unwrap_or(0);
    let last = by_label.keys().next_back().copied();
    let values = by_label.values().map(Differences::len).sum();
    let mut sum = if is_map {
        Differences::with_capacity(values)
    } else {
        Differences::default()
    };
    for (label, mut differences) in by_label {
        if is_map {
            alone.push((label.to_string(), differences.errors()));
        }
        sum.append(differences);
        if label != first && Some(label) != last {
            joined.push((format!("{first}-{label}"), sum.errors()));
        }
    }
    joined.push(("all".to_owned(), sum.errors()));
    let all = alone.into_iter().chain(joined);
    all.filter_map(|(name, errors)| Some((name, errors?)))
        .collect()
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
