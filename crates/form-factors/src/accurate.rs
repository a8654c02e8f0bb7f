//! The accurate estimator of one pair: after it has been classified (hidden, clear, or partly
//! hidden), *integrate* the unoccluded kernel, and *measure* the visible share where there is doubt.

use crate::blocker::Blocker;
use crate::budget::Budget;
use crate::element::Element;
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
    elements: Vec<Element>,
    far_tiles: Vec<FarTile>,
    tolerance: f64,
    pub(crate) budget: Budget,
}

/// `S_ij` and its standard error, in scene units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exchange {
    pub(crate) value: f64,
    pub(crate) error: f64,
    /// By how much the error is larger than it was to be, since there is a limit to samples.
    pub(crate) missed: f64,
    pub(crate) sight: Sight,
}

impl Exchange {
    /// Of patches with nothing between them.
    pub(crate) fn clear(value: f64, error: f64) -> Exchange {
        let sight = Sight::Clear;
        Exchange {
            value,
            error,
            missed: 0.0,
            sight,
        }
    }
}

impl<'a> Accurate<'a> {
    pub(crate) fn new(mesh: &'a Mesh, tiling: &Tiling, tolerance: f64) -> Accurate<'a> {
        let elements: Vec<Element> = mesh.patches.iter().map(Element::new).collect();
        let far_tile = |tile: &Tile| {
            let patches = tile.patches.iter();
            FarTile::new(&patches.map(|&patch| &elements[patch]).collect())
        };
        Accurate {
            mesh,
            far_tiles: tiling.tiles.iter().map(far_tile).collect(),
            elements,
            tolerance,
            budget: Budget::new(tolerance, mesh.patches.len()),
        }
    }

    /// The exchange of a patch with those of a tile that are far from it, if nothing stood between
    /// them.
    pub(crate) fn far(
        &self,
        i: usize,
        tile: usize,
        obstacles: &Obstacles,
    ) -> [Option<Exchange>; LANES] {
        let error = UNOCCLUDED_SHARE * self.tolerance;
        let tolerance = obstacles.occluders.plane_tolerance();
        far::exchange(&self.elements[i], &self.far_tiles[tile], error, tolerance)
    }

    /// The exchange of a pair of patches, if nothing stood between them.
    pub(crate) fn near(&self, [i, j]: [usize; 2], obstacles: &Obstacles) -> Exchange {
        let (i, j) = (&self.elements[i], &self.elements[j]);
        unoccluded::exchange(i, j, obstacles.occluders.plane_tolerance())
    }

    /// The exchange of a pair of patches, with this between them.
    pub(crate) fn past(
        &self,
        [i, j]: [usize; 2],
        unoccluded: Exchange,
        between: &Between,
        obstacles: &Obstacles,
    ) -> Exchange {
        let clear = unoccluded.value;
        if clear == 0.0 {
            return unoccluded;
        }
        let faces = [i, j].map(|patch| obstacles.wall(&self.mesh.patches[patch]));
        let listed: Vec<Blocker>;
        let blocked = match between {
            Between::Few(faces) if faces.is_empty() => return unoccluded,
            Between::Few(faces) => {
                listed = faces.iter().map(|&f| *obstacles.blocker(f)).collect();
                Blocked::By(&listed)
            }
            Between::Many => Blocked::Somehow(&obstacles.occluders, faces),
        };
        let share = self.visible([i, j], &blocked, clear, obstacles);
        Exchange {
            value: share.value * clear,
            error: share.error * clear + unoccluded.error,
            missed: share.missed * clear,
            sight: Sight::Partial,
        }
    }

    /// The visible share of a pair, as the points of the smaller patch see the larger one.
    fn visible(
        &self,
        [i, j]: [usize; 2],
        blocked: &Blocked<'_>,
        clear: f64,
        obstacles: &Obstacles,
    ) -> Share {
        let (from, across) = if self.area(i) < self.area(j) {
            (i, j)
        } else {
            (j, i)
        };
        let tolerance = obstacles.occluders.plane_tolerance();
        let [of_from, of_across] = [from, across].map(|patch| &self.elements[patch]);
        let Some(corners) = of_across.clip(&of_from.corners, tolerance) else {
            // One lies in the plane of the other, up to rounding.
            return Share::UNKNOWN;
        };
        let lines = Lines::new(
            (&corners, of_from.normal),
            Target::new(&self.mesh.patches[across].polygon, of_across.normal),
            blocked,
        );
        let stream = Stream::of_pair(SEED, i, j);
        let ends = [i, j].map(|patch| (patch, self.area(patch)));
        share(&lines, stream, self.budget.of_pair(ends, clear) / clear)
    }

    fn area(&self, patch: usize) -> f64 {
        self.mesh.patches[patch].area
    }
}
