//! The accurate estimator of one pair: after it has been classified (hidden, clear, or partly
//! hidden), *integrate* the unoccluded kernel, and *measure* the visible share where there is
//! doubt.

use crate::blocker::Blocker;
use crate::budget::Budget;
use crate::element::{Element, Elements};
use crate::far::{self, FarTile};
use crate::lines::{Blocked, Lines};
use crate::obstacles::{Between, Obstacles};
use crate::random::Stream;
use crate::tally::Sight;
use crate::target::Target;
use crate::tiles::{Tile, Tiling};
use crate::unoccluded;
use crate::visible::{Share, share};
use radiosity_geometry::Mesh;
use radiosity_simd::LANES;

/// The share of a row's tolerance that the unoccluded exchange may use up.
const UNOCCLUDED_SHARE: f64 = 0.02;
/// Seed of all shifts.
const SEED: u64 = 0;

/// Patches, ready for the accurate estimator.
pub(crate) struct Accurate<'a> {
    mesh: &'a Mesh,
    elements: Elements,
    far_tiles: Vec<Option<FarTile>>,
    tolerance: f64,
    pub(crate) budget: Budget,
}

/// `A_i F_ij` and its standard error, in scene units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairEstimate {
    pub(crate) value: f64,
    pub(crate) error: f64,
    /// By how much the error is larger than it was to be, since there is a limit to samples.
    pub(crate) missed: f64,
    pub(crate) sight: Sight,
}

impl PairEstimate {
    /// Of patches with nothing between them.
    pub(crate) fn clear(value: f64, error: f64) -> PairEstimate {
        let sight = Sight::Clear;
        PairEstimate {
            value,
            error,
            missed: 0.0,
            sight,
        }
    }
}

impl<'a> Accurate<'a> {
    pub(crate) fn new(mesh: &'a Mesh, tiling: &Tiling, tolerance: f64) -> Accurate<'a> {
        let elements = Elements::new(mesh);
        let far_tile = |tile: &Tile| {
            let patches = tile.patches.iter();
            FarTile::new(&patches.map(|&patch| elements.single(patch)).collect())
        };
        Accurate {
            mesh,
            far_tiles: tiling.tiles.iter().map(far_tile).collect(),
            elements,
            tolerance,
            budget: Budget::new(tolerance, mesh.patches.len()),
        }
    }

    /// By patch, the area that exchanges light.
    pub(crate) fn areas(&self) -> Vec<f64> {
        self.elements.areas()
    }

    /// The exchange of a patch with those of a tile that are far from it, if nothing stood between
    /// them.
    pub(crate) fn far(
        &self,
        i: usize,
        tile: usize,
        obstacles: &Obstacles,
    ) -> [Option<PairEstimate>; LANES] {
        let error = UNOCCLUDED_SHARE * self.tolerance;
        let tolerance = obstacles.occluders.plane_tolerance();
        match (self.elements.single(i), &self.far_tiles[tile]) {
            (Some(element), Some(tile)) => far::exchange(element, tile, error, tolerance),
            _ => [None; LANES],
        }
    }

    /// The exchange of a pair of patches, if nothing stood between them.
    pub(crate) fn near(&self, pair: [usize; 2], obstacles: &Obstacles) -> PairEstimate {
        let tolerance = obstacles.occluders.plane_tolerance();
        let pieces = self.pieces(pair);
        let exchanges = pieces.map(|[i, j]| unoccluded::exchange(i, j, tolerance));
        exchanges.fold(PairEstimate::clear(0.0, 0.0), |sum, exchange| {
            PairEstimate::clear(sum.value + exchange.value, sum.error + exchange.error)
        })
    }

    /// All pieces of a patch with all of another.
    fn pieces(&self, [i, j]: [usize; 2]) -> impl Iterator<Item = [&Element; 2]> {
        let (of_i, of_j) = (self.elements.of(i), self.elements.of(j));
        of_i.iter()
            .flat_map(move |i| of_j.iter().map(move |j| [i, j]))
    }

    /// The exchange of a pair of patches, with this between them.
    pub(crate) fn past(
        &self,
        pair: [usize; 2],
        unoccluded: PairEstimate,
        between: &Between,
        obstacles: &Obstacles,
    ) -> PairEstimate {
        let clear = unoccluded.value;
        if clear == 0.0 {
            return unoccluded;
        }
        let faces = pair.map(|patch| obstacles.wall(&self.mesh.patches[patch]));
        let listed: Vec<Blocker>;
        let blocked = match between {
            Between::Few(faces) if faces.is_empty() => return unoccluded,
            Between::Few(faces) => {
                listed = faces.iter().map(|&f| *obstacles.blocker(f)).collect();
                Blocked::By(&listed)
            }
            Between::Many => Blocked::Somehow(&obstacles.occluders, faces),
        };
        let tolerance = obstacles.occluders.plane_tolerance();
        let ends = pair.map(|patch| (patch, self.elements.area(patch)));
        // The same for all pieces: what they may add to the error goes by what they add.
        let wanted = self.budget.of_pair(ends, clear) / clear;
        let is_whole = pair.map(|patch| self.elements.single(patch).is_some()) == [true; 2];
        let mut sum = PairEstimate {
            value: 0.0,
            sight: Sight::Partial,
            ..unoccluded
        };
        for (piece, elements) in self.pieces(pair).enumerate() {
            let clear = match is_whole {
                true => clear,
                false => unoccluded::exchange(elements[0], elements[1], tolerance).value,
            };
            if clear > 0.0 {
                let stream = Stream::of_pair(SEED + piece as u64, pair[0], pair[1]);
                let share = visible(elements, &blocked, (stream, wanted), tolerance);
                sum.value += share.value * clear;
                sum.error += share.error * clear;
                sum.missed += share.missed * clear;
            }
        }
        sum
    }
}

/// The visible share of a pair, as the points of the smaller element see the larger one.
fn visible(
    [i, j]: [&Element; 2],
    blocked: &Blocked<'_>,
    (stream, wanted): (Stream, f64),
    tolerance: f64,
) -> Share {
    let (from, across) = if i.area() < j.area() { (i, j) } else { (j, i) };
    let Some(corners) = across.clip(from.corners(), tolerance) else {
        // One lies in the plane of the other, up to rounding.
        return Share::UNKNOWN;
    };
    let lines = Lines::new(
        (&corners, from.normal),
        Target::new(&across.polygon, across.normal),
        blocked,
    );
    share(&lines, stream, wanted)
}
