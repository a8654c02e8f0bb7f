//! Stage 2: the loop over all pairs.
//!
//! Rows are independent and are filled in parallel; each entry depends on its pair alone, so
//! the result is the same for any number of threads.

use crate::exchange::all_pairs;
use crate::monte_carlo::MonteCarlo;
use crate::points::{Sample, regular};
use crate::{Estimator, FormFactors};
use radiosity_geometry::{DVec3, Face, FaceId, Mesh, Occluders, Patch, Polygon};
use radiosity_matrix::{SymmetricMatrix, packed_len, packed_row, row_blocks_mut};
use rayon::prelude::*;

/// Rows per task: few enough to spread well over threads, enough to make progress reports rare.
const BLOCK_ROWS: usize = 8;

/// Estimates all form factors of a mesh. `progress` is told how many further pairs are done,
/// from any thread.
pub fn estimate(mesh: &Mesh, estimator: Estimator, progress: &(dyn Fn(u64) + Sync)) -> FormFactors {
    let size = mesh.patches.len();
    let stage = Stage::new(mesh, estimator);
    let mut values = vec![0.0; packed_len(size)];
    row_blocks_mut(size, &mut values, BLOCK_ROWS)
        .into_par_iter()
        .for_each(|(rows, block)| {
            let pairs = block.len();
            let mut monte_carlo = stage.monte_carlo();
            let first = packed_len(rows.start);
            for i in rows {
                let range = packed_row(i);
                let row = &mut block[range.start - first..range.end - first];
                stage.row(i, row, &mut monte_carlo);
            }
            progress(pairs as u64);
        });
    let areas = mesh.patches.iter().map(|patch| patch.area).collect();
    let exchange = SymmetricMatrix::new(size, values).expect("one value per pair was made");
    FormFactors::new(areas, exchange)
}

/// Estimates a few rows, spread evenly, and throws them away: for predicting how long
/// [`estimate`] will take. Returns how many pairs that were.
pub fn rehearse(mesh: &Mesh, estimator: Estimator, rows: usize) -> u64 {
    let size = mesh.patches.len();
    let stage = Stage::new(mesh, estimator);
    let step = (size / rows.max(1)).max(1);
    let chosen: Vec<usize> = (step / 2..size).step_by(step).collect();
    chosen
        .into_par_iter()
        .map(|i| {
            stage.row(i, &mut vec![0.0; i], &mut stage.monte_carlo());
            i as u64
        })
        .sum()
}

/// What every row needs.
struct Stage<'a> {
    mesh: &'a Mesh,
    occluders: Occluders,
    estimator: Estimator,
    /// The regular points of each patch; empty for the other estimator.
    points: Vec<Vec<Sample>>,
    scale: f64,
}

impl<'a> Stage<'a> {
    fn new(mesh: &'a Mesh, estimator: Estimator) -> Stage<'a> {
        let points = match estimator {
            Estimator::Regular { points } => mesh
                .patches
                .iter()
                .map(|patch| regular(&patch.polygon, points))
                .collect(),
            Estimator::MonteCarlo { .. } => Vec::new(),
        };
        Stage {
            mesh,
            occluders: Occluders::new(mesh),
            estimator,
            points,
            scale: 1.0 / mesh.total_area(),
        }
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
        let patch_i = &self.mesh.patches[i];
        let own_face = patch_i.face.index();
        for (index, face) in self.mesh.faces[..own_face].iter().enumerate() {
            if !face_each_other(patch_i, face) {
                continue;
            }
            let id = FaceId(index as u32);
            let sight = self
                .occluders
                .sight(patch_i.face, &patch_i.polygon, id, &face.polygon);
            let visible =
                |p: DVec3, q: DVec3| !self.occluders.blocked(&sight, patch_i.face, p, id, q);
            for j in face.patches() {
                let patch_j = &self.mesh.patches[j];
                let exchange = match monte_carlo {
                    None => all_pairs(
                        (&self.points[i], patch_i.normal),
                        (&self.points[j], patch_j.normal),
                        visible,
                    ),
                    Some(monte_carlo) => monte_carlo.estimate((i, patch_i), (j, patch_j), visible),
                };
                row[j] = (exchange * self.scale) as f32;
            }
        }
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
