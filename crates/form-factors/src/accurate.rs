//! The accurate estimator of one pair: after it has been classified (hidden, clear, or partly
//! hidden), *integrate* the unoccluded kernel, and *measure* the visible share where there is doubt.

use crate::blocker::Blocker;
use crate::element::Element;
use crate::far::{self, FarTile};
use crate::lines::{Lines, MOST_BLOCKERS};
use crate::obstacles::{Between, Obstacles};
use crate::random::Stream;
use crate::segments::{Blocked, Segments};
use crate::tally::Sight;
use crate::target::Target;
use crate::tiles::{Tile, Tiling};
use crate::unoccluded;
use crate::visible::{Share, share};
use radiosity_geometry::Mesh;
use radiosity_simd::LANES;

/// The share of a row's tolerance that the unoccluded exchange may use up.
const UNOCCLUDED_SHARE: f64 = 0.02;
/// The tolerance of a row is shared as if one in so many of its patches were partly hidden, each
/// with as large a factor. Rows with more of them have a larger error, and say so.
const PARTLY_HIDDEN_ONE_IN: f64 = 40.0;
/// Seed of all shifts.
const SEED: u64 = 0;

/// Patches, ready for the accurate estimator.
pub(crate) struct Accurate<'a> {
    mesh: &'a Mesh,
    elements: Vec<Element>,
    far_tiles: Vec<FarTile>,
    targets: Vec<Target>,
    tolerance: f64,
}

/// `S_ij` and its standard error, in scene units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exchange {
    pub(crate) value: f64,
    pub(crate) error: f64,
    pub(crate) sight: Sight,
}

impl Exchange {
    /// Of patches with nothing between them.
    pub(crate) fn clear(value: f64, error: f64) -> Exchange {
        let sight = Sight::Clear;
        Exchange {
            value,
            error,
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
            targets: mesh.patches.iter().map(Target::new).collect(),
            elements,
            tolerance,
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
        let share = match between {
            Between::Few(faces) if faces.is_empty() => return unoccluded,
            Between::Few(faces) => {
                let faces = faces.iter();
                let blockers: Vec<Blocker> = faces.map(|&f| *obstacles.blocker(f)).collect();
                self.past_few(i, j, &blockers, clear)
            }
            Between::Many => {
                let faces = [i, j].map(|patch| obstacles.wall(&self.mesh.patches[patch]));
                self.among(i, j, Blocked::Somehow(&obstacles.occluders, faces), clear)
            }
        };
        Exchange {
            value: share.value * clear,
            error: share.error * clear + unoccluded.error,
            sight: Sight::Partial,
        }
    }

    /// The visible share past a few blockers: by lines across the larger patch, unless they are
    /// many.
    fn past_few(&self, i: usize, j: usize, blockers: &[Blocker], clear: f64) -> Share {
        if blockers.len() > MOST_BLOCKERS {
            return self.among(i, j, Blocked::By(blockers), clear);
        }
        let (from, across) = if self.area(i) < self.area(j) {
            (i, j)
        } else {
            (j, i)
        };
        let lines = Lines::new(&self.targets[from], &self.targets[across], blockers);
        share(
            &lines,
            Stream::of_pair(SEED, i, j),
            self.wanted(i, j, clear),
        )
    }

    /// The visible share among any blockers, by segments.
    fn among(&self, i: usize, j: usize, blocked: Blocked<'_>, clear: f64) -> Share {
        let targets = [&self.targets[i], &self.targets[j]];
        let segments = Segments { targets, blocked };
        let stream = Stream::of_pair(SEED, i, j);
        share(&segments, stream, self.wanted(i, j, clear))
    }

    /// The error of a share that is the pair's part of the tolerance of either row.
    ///
    /// The work is least where errors go with the square root of factors, and `n` such errors, of
    /// factors that sum to 1, sum to the tolerance if each is `tolerance sqrt(F / n)`.
    fn wanted(&self, i: usize, j: usize, clear: f64) -> f64 {
        let factor = clear / self.area(i).min(self.area(j));
        let pairs = self.mesh.patches.len() as f64 / PARTLY_HIDDEN_ONE_IN;
        self.tolerance / (pairs.max(1.0) * factor).sqrt()
    }

    fn area(&self, patch: usize) -> f64 {
        self.mesh.patches[patch].area
    }
}
