//! Stage 2: the loop over all pairs.
//!
//! Rows are independent and are filled in parallel; each entry depends on its pair alone, so
//! the result is the same for any number of threads.

use crate::exchange::all_pairs;
use crate::monte_carlo::MonteCarlo;
use crate::points::{Sample, regular};
use crate::{Estimator, FormFactors};
use radiosity_geometry::{DVec3, Face, FaceId, Mesh, Occluders, Patch, Polygon, Sight};
use radiosity_matrix::{SymmetricMatrix, packed_len, packed_row, row_blocks_mut};
use rayon::prelude::*;

/// Rows per task.
const BLOCK_ROWS: usize = 8;

/// Estimates all form factors of a mesh. `progress` is told how many further pairs are done,
/// from any thread.
pub fn estimate(mesh: &Mesh, estimator: Estimator, progress: &(dyn Fn(u64) + Sync)) -> FormFactors {
    Estimation::new(mesh, estimator).run(progress)
}

/// [`estimate`] in two steps, with a rehearsal between them.
pub struct Estimation<'a> {
    mesh: &'a Mesh,
    occluders: Occluders,
    estimator: Estimator,
    /// The regular points of each patch; empty for the other estimator.
    points: Vec<Vec<Sample>>,
    scale: f64,
}

/// Neighbouring pairs that a rehearsal takes together, as rows do.
const REHEARSED_RUN: usize = 16;

impl<'a> Estimation<'a> {
    /// Prepares what every pair needs.
    pub fn new(mesh: &'a Mesh, estimator: Estimator) -> Estimation<'a> {
        let points = match estimator {
            Estimator::Regular { points } => mesh
                .patches
                .iter()
                .map(|patch| regular(&patch.polygon, points))
                .collect(),
            Estimator::MonteCarlo { .. } => Vec::new(),
        };
        Estimation {
            mesh,
            occluders: Occluders::new(mesh),
            estimator,
            points,
            scale: 1.0 / mesh.total_area(),
        }
    }

    /// Estimates at least so many pairs, spread over all of them, and throws them away: for
    /// predicting how long [`Estimation::run`] will take. Returns how many pairs they were.
    pub fn rehearse(&self, pairs: u64) -> u64 {
        let size = self.mesh.patches.len() as f64;
        let run = |k: u64| {
            // The R2 sequence (Roberts 2018) visits the square of pairs evenly.
            let spread = |inverse: f64| (((k + 1) as f64 * inverse).fract() * size) as usize;
            let (i, j) = (spread(0.754_877_666_246_693), spread(0.569_840_290_998_053));
            let face_j = self.mesh.patches[j].face;
            let end = self.mesh.faces[face_j.index()].patches().end;
            let run = j..end.min(j + REHEARSED_RUN);
            let length = run.len() as u64;
            let other_face = face_j != self.mesh.patches[i].face;
            if let Some(sight) = other_face.then(|| self.sight(i, face_j)).flatten() {
                let monte_carlo = &mut self.monte_carlo();
                let sum: f32 = run.map(|j| self.exchange(i, j, &sight, monte_carlo)).sum();
                std::hint::black_box(sum);
            }
            length
        };
        let mut done = 0;
        let mut next = 0;
        while done < pairs {
            let batch = ((pairs - done) / REHEARSED_RUN as u64).max(8);
            done += (next..next + batch).into_par_iter().map(run).sum::<u64>();
            next += batch;
        }
        done
    }

    /// Estimates all pairs. `progress` is told how many further pairs are done, from any thread.
    pub fn run(&self, progress: &(dyn Fn(u64) + Sync)) -> FormFactors {
        let size = self.mesh.patches.len();
        let mut values = vec![0.0; packed_len(size)];
        row_blocks_mut(size, &mut values, BLOCK_ROWS)
            .into_par_iter()
            .for_each(|(rows, block)| {
                let mut monte_carlo = self.monte_carlo();
                let first = packed_len(rows.start);
                for i in rows {
                    let range = packed_row(i);
                    let row = &mut block[range.start - first..range.end - first];
                    self.row(i, row, &mut monte_carlo);
                    progress(i as u64);
                }
            });
        let areas = self.mesh.patches.iter().map(|patch| patch.area).collect();
        let exchange = SymmetricMatrix::new(size, values).expect("one value per pair was made");
        FormFactors::new(areas, exchange)
    }

    fn monte_carlo(&self) -> Option<MonteCarlo> {
        match self.estimator {
            Estimator::Regular { .. } => None,
            Estimator::MonteCarlo {
                points,
                pairs,
                seed,
            } => Some(MonteCarlo::new(points, pairs, seed)),
        }
    }

    /// Fills the zeroed entries `(i, 0 .. i)`, face by face.
    fn row(&self, i: usize, row: &mut [f32], monte_carlo: &mut Option<MonteCarlo>) {
        let own_face = self.mesh.patches[i].face.index();
        for (index, face) in self.mesh.faces[..own_face].iter().enumerate() {
            let id = FaceId(index as u32);
            if let Some(sight) = self.sight(i, id) {
                for j in face.patches() {
                    row[j] = self.exchange(i, j, &sight, monte_carlo);
                }
            }
        }
    }

    /// What may stand between a patch and another face; `None` if they cannot see each other.
    fn sight(&self, i: usize, face_id: FaceId) -> Option<Sight<'_>> {
        let (patch, face) = (&self.mesh.patches[i], &self.mesh.faces[face_id.index()]);
        face_each_other(patch, face).then(|| {
            self.occluders
                .sight(patch.face, &patch.polygon, face_id, &face.polygon)
        })
    }

    /// `S_ij` in units of the total area.
    fn exchange(
        &self,
        i: usize,
        j: usize,
        sight: &Sight<'_>,
        monte_carlo: &mut Option<MonteCarlo>,
    ) -> f32 {
        let (patch_i, patch_j) = (&self.mesh.patches[i], &self.mesh.patches[j]);
        let visible = |p: DVec3, q: DVec3| !sight.blocked(p, q);
        let exchange = match monte_carlo {
            None => all_pairs(
                (&self.points[i], patch_i.normal),
                (&self.points[j], patch_j.normal),
                visible,
            ),
            Some(monte_carlo) => monte_carlo.estimate((i, patch_i), (j, patch_j), visible),
        };
        (exchange * self.scale) as f32
    }
}

/// Whether some point of the patch and some point of the face lie in front of each other.
fn face_each_other(patch: &Patch, face: &Face) -> bool {
    let reaches_over = |polygon: &Polygon, normal: DVec3, origin: DVec3| {
        let corners = polygon.corners().iter();
        corners.map(|&c| normal.dot(c - origin)).any(|h| h > 0.0)
    };
    let corner_of_face = face.polygon.corners()[0];
    reaches_over(&face.polygon, patch.normal, patch.centroid)
        && reaches_over(&patch.polygon, face.normal, corner_of_face)
}
