//! Shares the tolerance of rows among the pairs whose visible share is measured.
//!
//! To measure takes least work where errors go with the square root of factors: with
//! `weight_i = sum_j sqrt(F_ij)` over the partly hidden pairs of a row, the errors
//! `tolerance sqrt(F_ij) / weight_i` sum to the tolerance. A pair is in two rows, and has the
//! smaller part of both.

use crate::accurate::Accurate;
use crate::culling::blockers::Blockers;
use crate::fixed_point_sum::{FixedPoint, FixedPointSums};
use crate::quotient;
use crate::traversal::tiled_mesh::{FEW, TiledMesh};
use crate::traversal::tiles::{Group, Tile};
use rayon::prelude::*;

/// So many pairs of patches stand for all of two tiles that are near each other: factors differ
/// there.
const NEAR_PAIRS: usize = 8;
/// Tiles are near each other within so many of their sizes.
const NEAR: f64 = 2.0;

/// What pairs may add to the errors of rows.
pub(crate) struct ErrorBudget {
    tolerance: f64,
    /// By patch.
    weights: Vec<f64>,
}

impl ErrorBudget {
    /// That of a row by itself, so far.
    pub(crate) fn new(tolerance: f64, patches: usize) -> ErrorBudget {
        ErrorBudget {
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

impl Accurate {
    /// The budget with the weights of rows: of two tiles, a few pairs of patches stand for all.
    pub(super) fn shared_budget(&self, mesh: &TiledMesh<'_>) -> ErrorBudget {
        let tiles = &mesh.tiling.tiles;
        let sums = FixedPointSums::new(self.areas.len());
        (0..tiles.len()).into_par_iter().for_each(|tile| {
            let before = mesh.tiling.groups.iter();
            for group in before.take_while(|group| group.tiles.start <= tile) {
                self.add_weights(mesh, (tile, group), &sums);
            }
        });
        let mut weights = sums.sums();
        for tile in tiles {
            raise_to_mean(&mut weights, &tile.patches);
        }
        ErrorBudget {
            tolerance: self.tolerance,
            weights,
        }
    }

    /// Adds what the pairs of a tile and a group weigh in the rows of both.
    fn add_weights(
        &self,
        mesh: &TiledMesh<'_>,
        (tile, group): (usize, &Group),
        sums: &FixedPointSums,
    ) {
        let tiles = &mesh.tiling.tiles;
        let bounds = [&tiles[tile].bound, &group.bound];
        let Some(of_group) = mesh.view(&Blockers::Tree, bounds, FEW) else {
            return;
        };
        if of_group.is_clear() {
            return;
        }
        for other in group.tiles.clone().take_while(|&other| other <= tile) {
            let pair = [tile, other].map(|tile| &tiles[tile]);
            let Some(blockers) = mesh.view(&of_group, pair.map(|tile| &tile.bound), FEW) else {
                continue;
            };
            if blockers.is_clear() {
                continue;
            }
            let pairs = if are_near(mesh, pair) { NEAR_PAIRS } else { 1 };
            for k in 0..pairs {
                // Patches take turns, whichever of both tiles is the next.
                let turns = [5 * tile + 3 * other + k, 3 * tile + 5 * other + 2 * k];
                let patches =
                    [0, 1].map(|end| pair[end].patches[turns[end] % pair[end].patches.len()]);
                let of_tiles = pair[0].patches.len() * pair[1].patches.len();
                // Of a tile with itself a pair is met from both ends.
                let count = of_tiles as f64 / if other == tile { 2.0 } else { 1.0 };
                self.add_weights_of_pair(mesh, (patches, count / pairs as f64), &blockers, sums);
            }
        }
    }

    /// Whether something of this may hide a part of a patch from another, neither of which is
    /// covered.
    fn is_partly_hidden(
        &self,
        mesh: &TiledMesh<'_>,
        pair: [usize; 2],
        blockers: &Blockers,
    ) -> bool {
        let is_covered = pair.map(|patch| self.areas[patch] == 0.0);
        let bounds = pair.map(|patch| &mesh.bounds[patch]);
        let view = || mesh.view(blockers, bounds, FEW);
        is_covered == [false; 2] && view().is_some_and(|blockers| !blockers.is_clear())
    }

    /// Adds what so many pairs like this one weigh in the rows of both, if something stands between
    /// them that hides a part of one from the other.
    fn add_weights_of_pair(
        &self,
        mesh: &TiledMesh<'_>,
        (pair, count): ([usize; 2], f64),
        blockers: &Blockers,
        sums: &FixedPointSums,
    ) {
        if !self.is_partly_hidden(mesh, pair, blockers) {
            return;
        }
        let exchange = self.near(pair, mesh).value;
        for patch in pair {
            let weight = count * quotient(exchange, self.areas[patch]).sqrt();
            sums.add(patch, FixedPoint::of(weight));
        }
    }
}

/// Whether two tiles are near each other, as their first patches tell.
fn are_near(mesh: &TiledMesh<'_>, tiles: [&Tile; 2]) -> bool {
    let patches = tiles.map(|tile| &mesh.mesh.patches[tile.patches[0]]);
    let area = |end: usize| tiles[end].patches.len() as f64 * patches[end].area;
    let distance = patches[0].centroid.distance_squared(patches[1].centroid);
    distance < NEAR * NEAR * (area(0) + area(1))
}

/// Raises the weights of these patches to their mean: none of the few pairs of a patch that were
/// looked at may be partly hidden, where others are.
fn raise_to_mean(weights: &mut [f64], patches: &[usize]) {
    let sum: f64 = patches.iter().map(|&patch| weights[patch]).sum();
    let mean = sum / patches.len() as f64;
    for &patch in patches {
        weights[patch] = weights[patch].max(mean);
    }
}

#[cfg(test)]
mod tests;
