//! The accurate estimator of one pair: after it has been classified (hidden, clear, or partly
//! hidden), *integrate* the unoccluded kernel, and *measure* the visible share where there is doubt.

use crate::blocker::Blocker;
use crate::element::Element;
use crate::lines::{Lines, MOST_BLOCKERS};
use crate::obstacles::{Between, Obstacles};
use crate::random::Stream;
use crate::segments::{Blocked, Segments};
use crate::tally::Sight;
use crate::target::Target;
use crate::unoccluded;
use crate::visible::{Share, share};
use radiosity_geometry::Mesh;

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

impl<'a> Accurate<'a> {
    pub(crate) fn new(mesh: &'a Mesh, tolerance: f64) -> Accurate<'a> {
        Accurate {
            mesh,
            elements: mesh.patches.iter().map(Element::new).collect(),
            targets: mesh.patches.iter().map(Target::new).collect(),
            tolerance,
        }
    }

    /// The exchange of a pair of patches, with this between them.
    pub(crate) fn exchange(
        &self,
        [i, j]: [usize; 2],
        between: &Between,
        obstacles: &Obstacles,
    ) -> Exchange {
        let error = UNOCCLUDED_SHARE * self.tolerance;
        let (element_i, element_j) = (&self.elements[i], &self.elements[j]);
        let tolerance = obstacles.occluders.plane_tolerance();
        let unoccluded = unoccluded::exchange(element_i, element_j, error, tolerance);
        let clear = unoccluded.value;
        if clear == 0.0 {
            return unoccluded;
        }
        let share = match between {
            Between::Few(faces) if faces.is_empty() => return unoccluded,
            Between::Few(faces) => {
                let faces = faces.iter();
                let blockers: Vec<Blocker> = faces.map(|&f| *obstacles.blocker(f)).collect();
                self.past(i, j, &blockers, clear)
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
    fn past(&self, i: usize, j: usize, blockers: &[Blocker], clear: f64) -> Share {
        if blockers.len() > MOST_BLOCKERS {
            return self.among(i, j, Blocked::By(blockers), clear);
        }
        let (from, across) = if self.area(i) < self.area(j) {
            (i, j)
        } else {
            (j, i)
        };
        let lines = Lines {
            from: &self.targets[from],
            across: &self.targets[across],
            blockers,
        };
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
