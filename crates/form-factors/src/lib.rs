//! Turns a [`Mesh`](radiosity_geometry::Mesh) into [`FormFactors`]: for every pair of patches,
//! how much of the light that leaves one arrives at the other.
//!
//! `F_ij` is the share of the power leaving patch `i` that arrives directly at the front of
//! patch `j` (Cohen & Wallace, "Radiosity and Realistic Image Synthesis", 1993, eq. 4.3):
//!
//! ```text
//! F_ij = 1/A_i  int_i int_j  V cos_i cos_j / (pi r^2)  dA_j dA_i
//! ```
//!
//! - Reciprocity `A_i F_ij = A_j F_ji` holds by construction: one number
//!   `A_i F_ij` is stored per pair.
//! - A patch sees what is in front of it and shows its own front; both sides of a face block.
//! - Two patches of one planar face, or of faces joined to one wall, have `F = 0`. That goes by
//!   face: two faces of one mesh see each other like any others.
//! - No entry is clamped so that rows fit: what rows sum to is reported.
//!
//! This crate knows nothing of materials, emission, cameras or names, so changing those cannot
//! invalidate what it computed.

pub mod accurate;
mod aggregate;
mod closure;
pub mod culling;
mod elements;
mod estimate;
mod estimator;
mod fixed_point_sum;
pub mod hemisphere;
mod kernel;
pub mod monte_carlo;
mod params;
pub mod regular;
pub mod sampling;
mod tally;
pub mod traversal;

use elements::{visible_areas, visible_share};
use hemisphere::Hemisphere;
use radiosity_matrix::{DenseExchange, Exchange, SymmetricMatrix};
use serde::{Deserialize, Serialize};
use tally::RowErrors;

pub use aggregate::AggregateFactors;
pub use closure::{Closure, ClosureFacts};
pub use estimate::{Estimation, estimate};
pub use estimator::Estimator;
pub use hemisphere::error_of_rays;
pub use params::{Mode, Params};
pub use tally::{ClassFacts, Classes, Tally};
pub use traversal::begun_rows::BegunRows;

/// Raise it whenever the same mesh would give other form factors, because of a change here, in
/// `geometry`, or in the random numbers: it is part of their key.
pub const VERSION: u32 = 17;

/// What is known of one row of the form factor matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RowFacts {
    /// The sum of the row's factors: the share of the power leaving the patch that arrives at
    /// fronts of other patches. More than 1 is an error of the estimator.
    pub fronts: f64,
    /// The share that arrives at backs, and the share that leaves the scene: measured by rays, and
    /// so independent of the factors. With `fronts` they sum to 1 within the errors.
    pub backs: f64,
    /// See `backs`.
    pub background: f64,
    /// Standard error of the sum of `backs` and `background`.
    pub rays_error: f64,
    /// The share of the patch's area that can be seen: points that see nearly nothing but backs are
    /// inside of something, or covered. By rays, to a percent.
    pub visible: f64,
    /// The estimated sum of the absolute errors of the row's factors, rounding to single precision
    /// included, if the estimator tells.
    pub error: Option<f64>,
    /// The part of `error` that is left although more was asked for: of pairs that have used up
    /// all of their samples. No tolerance lowers it.
    pub missed: f64,
}

/// The form factors of all pairs.
#[derive(Clone, Debug)]
pub struct FormFactors {
    /// By patch, its area in square scene units. The accurate estimator leaves out what other faces
    /// [lie on](radiosity_geometry::Covers); where they cover all, it is 0, and so are the patch's
    /// factors.
    pub areas: Vec<f64>,
    /// `A_i F_ij`, and the areas of *elements*: of that part of a patch that exchanges light, of
    /// which a radiosity is the mean. By the accurate estimator it is what can be seen of the
    /// patch, unless that is too little to be told apart. By the others it is all of it, as in
    /// textbooks.
    pub exchange: DenseExchange,
    /// Per patch.
    pub rows: Vec<RowFacts>,
    /// Of pairs, if the estimator tells.
    pub classes: Option<Classes>,
    /// How rows were made to sum to 1, if they were.
    pub closure: Option<ClosureFacts>,
}

impl FormFactors {
    /// Completes areas and matrix by the facts that follow from them. `errors` are those of an
    /// estimator that tells them: its elements are what can be seen of patches.
    fn new(
        areas: Vec<f64>,
        matrix: SymmetricMatrix,
        errors: Option<RowErrors>,
        hemispheres: &[Hemisphere],
    ) -> FormFactors {
        let whole = DenseExchange::new(matrix, areas.clone());
        let fronts = whole.weighted_sums(&vec![1.0; areas.len()]);
        let row = |i: usize| RowFacts {
            fronts: quotient(fronts[i], areas[i]),
            backs: hemispheres[i].backs,
            background: hemispheres[i].background,
            rays_error: hemispheres[i].error,
            visible: hemispheres[i].visible,
            error: (errors.as_ref())
                .map(|errors| errors.estimated[i] + ROUNDING * quotient(fronts[i], areas[i])),
            missed: errors.as_ref().map_or(0.0, |errors| errors.missed[i]),
        };
        let rows: Vec<RowFacts> = (0..areas.len()).map(row).collect();
        let exchange = match errors {
            Some(_) => whole.of_parts(visible_areas(&areas, &rows)),
            None => whole,
        };
        FormFactors {
            rows,
            areas,
            exchange,
            classes: errors.map(|errors| errors.classes),
            closure: None,
        }
    }

    /// `F_ij` for all `j`.
    pub fn row(&self, i: usize) -> Vec<f64> {
        (0..self.areas.len()).map(|j| self.factor(i, j)).collect()
    }

    /// `F_ij`: the share of the power leaving patch `i` that arrives at patch `j`, in constant
    /// time. Of all of the patch, what cannot be seen of it included, which sees nothing of `j`.
    pub fn factor(&self, i: usize, j: usize) -> f64 {
        quotient(self.exchange.exchange_area(i, j), self.areas[i])
    }

    /// The powers that arrive at backs, and that leave the scene, where `exitance` is what each
    /// element radiates, per channel in W/m^2: by rays, and so independent of the factors.
    pub fn lost(&self, exitance: &[[f32; 3]]) -> [[f64; 3]; 2] {
        let mut lost = [[0.0; 3]; 2];
        for (i, (row, exitance)) in self.rows.iter().zip(exitance).enumerate() {
            // What of a patch is no element sees nothing but backs.
            let hidden = self.areas[i] - self.exchange.areas()[i];
            let backs = (self.areas[i] * row.backs - hidden).max(0.0);
            let background = self.areas[i] * row.background;
            for c in 0..3 {
                lost[0][c] += backs * f64::from(exitance[c]);
                lost[1][c] += background * f64::from(exitance[c]);
            }
        }
        lost
    }

    /// By patch, the share of it that is its element.
    pub fn element_shares(&self) -> Vec<f32> {
        let elements = self.exchange.areas().iter().zip(&self.areas);
        let share = |(element, &area): (&f64, &f64)| match area > 0.0 {
            true => (element / area) as f32,
            false => 1.0,
        };
        elements.map(share).collect()
    }

    /// By patch, the share of it that can be seen, or 0 if that is too little to be told apart.
    pub fn visible_shares(&self) -> Vec<f32> {
        let shares = self.rows.iter().map(visible_share);
        shares.map(|share| share as f32).collect()
    }
}

/// What single precision rounds off a stored number, relative to it.
const ROUNDING: f64 = 1.0 / (1 << 24) as f64;

/// What an area has of something; nothing if it is no area.
pub(crate) fn quotient(whole: f64, area: f64) -> f64 {
    if area > 0.0 { whole / area } else { 0.0 }
}
