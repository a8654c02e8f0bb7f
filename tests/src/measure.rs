//! The measures of error that the reference data defines.

use crate::reference::RadiosityTable;
use radiosity::Pipeline;
use radiosity::renderer::Image;
use radiosity::solver::Solution;

/// Errors as percentages of the mean of the reference.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// Root mean square difference.
    pub rmse: f64,
    /// Mean difference.
    pub bias: f64,
    /// Over how many values, channels counted apart.
    pub values: usize,
}

/// Sums of weighted differences.
#[derive(Default)]
struct Sums {
    weight: f64,
    reference: f64,
    difference: f64,
    square: f64,
    values: usize,
}

impl Sums {
    fn add(&mut self, weight: f64, reference: f64, found: f64) {
        let difference = found - reference;
        self.weight += weight;
        self.reference += weight * reference;
        self.difference += weight * difference;
        self.square += weight * difference * difference;
        self.values += 1;
    }

    fn errors(&self) -> Errors {
        let mean = self.reference / self.weight;
        Errors {
            rmse: 100.0 * (self.square / self.weight).sqrt() / mean,
            bias: 100.0 * self.difference / self.weight / mean,
            values: self.values,
        }
    }
}

/// Surfaces that emit or are not lit.
const LEFT_OUT: [&str; 3] = ["light", "front", "cuboid-back"];

/// The errors of radiosities against a table of the same grid.
pub fn radiosity_errors(
    table: &RadiosityTable,
    pipeline: &Pipeline<'_>,
    solution: &Solution,
) -> Errors {
    let mut sums = Sums::default();
    for (index, patch) in pipeline.mesh().patches.iter().enumerate() {
        let surface = pipeline.surface_name(index);
        if LEFT_OUT.contains(&surface) {
            continue;
        }
        let [ia, ib] = patch.cell;
        let reference = table[&(surface.to_owned(), ia, ib)];
        for (reference, found) in reference.into_iter().zip(solution.radiosity[index]) {
            sums.add(patch.area, reference, f64::from(found));
        }
    }
    sums.errors()
}

/// The errors of a picture against the reference, over unclamped pixels of some regions.
pub fn picture_errors(
    reference: &Image,
    found: &Image,
    regions: &[u8],
    wanted: impl Fn(u8) -> bool,
) -> Errors {
    let mut sums = Sums::default();
    for ((reference, found), region) in reference.pixels.iter().zip(&found.pixels).zip(regions) {
        let clamped = reference.iter().any(|&radiance| 4.0 * radiance > 1.0);
        if clamped || !wanted(*region) {
            continue;
        }
        for (&reference, &found) in reference.iter().zip(found) {
            sums.add(1.0, f64::from(reference), f64::from(found));
        }
    }
    sums.errors()
}
