//! Stage 2: the loop over all pairs.
//!
//! Rows are independent and are filled in parallel; each entry depends on its pair alone, so
//! the result is the same for any number of threads.

use crate::accurate::{Accurate, Exchange};
use crate::exchange::all_pairs;
use crate::fixed::FixedSums;
use crate::monte_carlo::{MonteCarlo, Strata};
use crate::points::{Sample, regular};
use crate::surroundings::{Surroundings, look_around};
use crate::{Estimator, FormFactors};
use radiosity_geometry::{DVec3, Face, FaceId, Mesh, Occluders, Patch, Polygon};
use radiosity_matrix::{SymmetricMatrix, packed_len, packed_row, row_blocks_mut};
use rayon::prelude::*;
use std::ops::Range;

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
    method: Method<'a>,
    scale: f64,
}

/// The estimator with what it prepares.
enum Method<'a> {
    /// The regular points of each patch.
    Regular(Vec<Vec<Sample>>),
    MonteCarlo(MonteCarlo),
    Accurate(Accurate<'a>),
}

/// Neighbouring pairs that a rehearsal takes together, as rows do.
const REHEARSED_RUN: usize = 16;

impl<'a> Estimation<'a> {
    /// Prepares what every pair needs.
    pub fn new(mesh: &'a Mesh, estimator: Estimator) -> Estimation<'a> {
        let occluders = Occluders::new(mesh);
        let method = match estimator {
            Estimator::Regular { points } => {
                let patches = mesh.patches.iter();
                Method::Regular(patches.map(|p| regular(&p.polygon, points)).collect())
            }
            Estimator::MonteCarlo {
                points,
                pairs,
                seed,
            } => Method::MonteCarlo(MonteCarlo::new(points, pairs, seed)),
            Estimator::Accurate { tolerance } => {
                Method::Accurate(Accurate::new(mesh, tolerance, occluders.plane_tolerance()))
            }
        };
        Estimation {
            mesh,
            occluders,
            method,
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
            let mut sum = 0.0;
            if face_j != self.mesh.patches[i].face {
                self.pairs(i, face_j, run, |_, exchange| sum += exchange.value);
            }
            std::hint::black_box(sum);
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
        let errors = FixedSums::new(size);
        row_blocks_mut(size, &mut values, BLOCK_ROWS)
            .into_par_iter()
            .for_each(|(rows, block)| {
                let first = packed_len(rows.start);
                for i in rows {
                    let range = packed_row(i);
                    let row = &mut block[range.start - first..range.end - first];
                    self.row(i, row, &errors);
                    progress(i as u64);
                }
            });
        let patches = self.mesh.patches.par_iter();
        let areas = patches.clone().map(|patch| patch.area).collect();
        let exchange = SymmetricMatrix::new(size, values).expect("one value per pair was made");
        let errors = match self.method {
            Method::Accurate(_) => Some(errors.into_sums()),
            Method::Regular(_) | Method::MonteCarlo(_) => None,
        };
        let surroundings: Vec<Surroundings> = patches
            .enumerate()
            .map(|(index, patch)| look_around(&self.occluders, patch, index))
            .collect();
        FormFactors::new(areas, exchange, errors.as_deref(), &surroundings)
    }

    /// Fills the zeroed entries `(i, 0 .. i)`, face by face, and adds the errors of
    /// the factors to those of both rows.
    fn row(&self, i: usize, row: &mut [f32], errors: &FixedSums) {
        let own_face = self.mesh.patches[i].face.index();
        for (index, face) in self.mesh.faces[..own_face].iter().enumerate() {
            self.pairs(i, FaceId(index as u32), face.patches(), |j, exchange| {
                row[j] = (exchange.value * self.scale) as f32;
                errors.add(i, exchange.error / self.mesh.patches[i].area);
                errors.add(j, exchange.error / self.mesh.patches[j].area);
            });
        }
    }

    /// Estimates the exchange of patch `i` with some patches of another face; tells those that
    /// may not be zero.
    fn pairs(
        &self,
        i: usize,
        face_id: FaceId,
        patches: Range<usize>,
        mut tell: impl FnMut(usize, Exchange),
    ) {
        let (patch, face) = (&self.mesh.patches[i], &self.mesh.faces[face_id.index()]);
        if !face_each_other(patch, face) {
            return;
        }
        let occluders = &self.occluders;
        let sight = occluders.sight(patch.face, &patch.polygon, face_id, &face.polygon);
        let visible = |p: DVec3, q: DVec3| !sight.blocked(p, q);
        let plain = |value: f64| Exchange { value, error: 0.0 };
        match &self.method {
            Method::Regular(points) => {
                for j in patches {
                    let of_i = (&points[i][..], patch.normal);
                    let of_j = (&points[j][..], face.normal);
                    tell(j, plain(all_pairs(of_i, of_j, visible)));
                }
            }
            Method::MonteCarlo(monte_carlo) => {
                let mut strata = Strata::default();
                for j in patches {
                    let of_j = (j, &self.mesh.patches[j]);
                    let value = monte_carlo.estimate((i, patch), of_j, &mut strata, visible);
                    tell(j, plain(value));
                }
            }
            Method::Accurate(accurate) => {
                let between = accurate.between(i, &sight);
                patches.for_each(|j| tell(j, accurate.exchange(i, j, &between)));
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
