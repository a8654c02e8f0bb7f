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
    let size = mesh.patches.len();
    let stage = Stage::new(mesh, estimator);
    let mut values = vec![0.0; packed_len(size)];
    row_blocks_mut(size, &mut values, BLOCK_ROWS)
        .into_par_iter()
        .for_each(|(rows, block)| {
            let mut monte_carlo = stage.monte_carlo();
            let first = packed_len(rows.start);
            for i in rows {
                let range = packed_row(i);
                let row = &mut block[range.start - first..range.end - first];
                stage.row(i, row, &mut monte_carlo);
                progress(i as u64);
            }
        });
    let areas = mesh.patches.iter().map(|patch| patch.area).collect();
    let exchange = SymmetricMatrix::new(size, values).expect("one value per pair was made");
    FormFactors::new(areas, exchange)
}

/// Estimates some pairs, spread over all of them, and throws them away: for predicting how long
/// [`estimate`] will take.
pub fn rehearse(mesh: &Mesh, estimator: Estimator, pairs: u64) {
    let size = mesh.patches.len() as u64;
    let stage = Stage::new(mesh, estimator);
    (0..pairs).into_par_iter().for_each(|k| {
        // Multiples of the golden ratio visit a square evenly; half of it is one triangle.
        let spread = |k: u64, ratio: f64| ((k as f64 * ratio).fract() * size as f64) as usize;
        let (i, j) = (
            spread(k, 0.618_033_988_749_895),
            spread(k, 0.754_877_666_246_693),
        );
        stage.pair(i.max(j), i.min(j), &mut stage.monte_carlo());
    });
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

    /// One entry on its own.
    fn pair(&self, i: usize, j: usize, monte_carlo: &mut Option<MonteCarlo>) -> f32 {
        let face_j = self.mesh.patches[j].face;
        if face_j == self.mesh.patches[i].face {
            return 0.0;
        }
        self.sight(i, face_j)
            .map_or(0.0, |sight| self.exchange(i, j, &sight, monte_carlo))
    }

    /// What may stand between a patch and another face; `None` if they cannot see each other.
    fn sight(&self, i: usize, face_id: FaceId) -> Option<Sight> {
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
        sight: &Sight,
        monte_carlo: &mut Option<MonteCarlo>,
    ) -> f32 {
        let (patch_i, patch_j) = (&self.mesh.patches[i], &self.mesh.patches[j]);
        let visible = |p: DVec3, q: DVec3| {
            !self
                .occluders
                .blocked(sight, patch_i.face, p, patch_j.face, q)
        };
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
