//! Shares the tolerance of rows among the pairs whose visible share is measured.
//!
//! To measure takes least work where errors go with the square root of factors: with
//! `weight_i = sum_j sqrt(F_ij)` over the partly hidden pairs of a row, the errors
//! `tolerance sqrt(F_ij) / weight_i` sum to the tolerance. A pair is in two rows, and has the smaller
//! part of both.

use crate::accurate::Accurate;
use crate::estimate::Estimation;
use crate::fixed::{Fixed, FixedSums};
use crate::obstacles::Between;
use crate::pairs::FEW;
use crate::quotient;
use crate::tiles::{Group, Tile, Tiling};
use rayon::prelude::*;

/// What pairs may add to the errors of rows.
pub(crate) struct Budget {
    tolerance: f64,
    /// By patch.
    weights: Vec<f64>,
}

impl Budget {
    /// That of a row by itself, so far.
    pub(crate) fn new(tolerance: f64, patches: usize) -> Budget {
        Budget {
            tolerance,
            weights: vec![0.0; patches],
        }
    }

    /// The error of the exchange of two patches, given what it is with nothing between them, in
    /// scene units.
    pub(crate) fn of_pair(&self, pair: [(usize, f64); 2], clear: f64) -> f64 {
        let of_row = |(patch, area): (usize, f64)| {
            let factor = clear / area;
            // The weights are estimates, and may leave it out.
            let weight = self.weights[patch].max(factor.sqrt());
            self.tolerance * area * factor.sqrt() / weight
        };
        of_row(pair[0]).min(of_row(pair[1]))
    }
}

impl Estimation<'_> {
    /// Estimates the weights of rows: of two tiles, one pair of patches stands for all.
    pub(crate) fn budget(&self, accurate: &Accurate<'_>, tolerance: f64) -> Budget {
        let Tiling { tiles, groups, .. } = &self.tiling;
        let sums = FixedSums::new(tiles.len());
        (0..tiles.len()).into_par_iter().for_each(|tile| {
            let before = groups.iter();
            for group in before.take_while(|group| group.tiles.start <= tile) {
                self.add_weights(accurate, (tile, group), &sums);
            }
        });
        let mut budget = Budget::new(tolerance, self.mesh.patches.len());
        for (tile, weight) in tiles.iter().zip(sums.sums()) {
            for &patch in &tile.patches {
                budget.weights[patch] = weight;
            }
        }
        budget
    }

    /// Adds what the pairs of a tile and a group weigh in the rows of both.
    fn add_weights(
        &self,
        accurate: &Accurate<'_>,
        (tile, group): (usize, &Group),
        sums: &FixedSums,
    ) {
        let tiles = &self.tiling.tiles;
        let parts = [&tiles[tile].part, &group.part];
        let Some(between) = self.view(&Between::Many, parts, FEW) else {
            return;
        };
        if between.is_clear() {
            return;
        }
        for other in group.tiles.clone().take_while(|&other| other <= tile) {
            let pair = self.partly_hidden_pair([tile, other], &between);
            let Some(pair) = pair else {
                continue;
            };
            let exchange = accurate.near(pair, &self.obstacles).value;
            let [of_tile, of_other] = pair.map(|patch| quotient(exchange, self.areas[patch]));
            let add = |to: usize, of: usize, factor: f64| {
                sums.add(
                    to,
                    Fixed::of(tiles[of].patches.len() as f64 * factor.sqrt()),
                );
            };
            add(tile, other, of_tile);
            if other != tile {
                add(other, tile, of_other);
            }
        }
    }

    /// Two patches, one of each tile, if something stands between them that hides a part of one from
    /// the other.
    fn partly_hidden_pair(&self, pair: [usize; 2], between: &Between) -> Option<[usize; 2]> {
        let tiles = pair.map(|tile| &self.tiling.tiles[tile]);
        let parts = tiles.map(|tile| &tile.part);
        let between = self.view(between, parts, FEW)?;
        if between.is_clear() {
            return None;
        }
        // Any of them that are not covered, by a mix of both numbers.
        let mixed = 5 * pair[0] + 3 * pair[1];
        let any = |tile: &Tile| {
            let count = tile.patches.len();
            let mut patches = (0..count).map(|k| tile.patches[(mixed + k) % count]);
            patches.find(|&patch| self.areas[patch] > 0.0)
        };
        let ends = [any(tiles[0])?, any(tiles[1])?];
        let between = self.view(&between, ends.map(|patch| &self.parts[patch]), FEW)?;
        (!between.is_clear()).then_some(ends)
    }
}
