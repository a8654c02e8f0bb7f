//! The plain Monte Carlo estimator: random pairs of points, and a ray for each.

use crate::kernel::kernel;
use crate::sampling::points::{Sample, jittered};
use crate::sampling::random::Stream;
use crate::traversal::tile_block::{PairEstimator, TileBlock, TilePair, Workspace};
use crate::traversal::tiled_mesh::{FEW, TiledMesh};
use radiosity_geometry::{DVec2, DVec3, Mesh, Patch};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// The settings of [`Estimator::MonteCarlo`](crate::Estimator::MonteCarlo).
pub(crate) struct MonteCarlo {
    points: u32,
    pairs: u32,
    seed: u64,
    total_area: f64,
}

/// Reusable room for the shuffled strata of either patch.
#[derive(Default)]
pub(crate) struct Strata {
    of_i: Vec<u32>,
    of_j: Vec<u32>,
}

impl PairEstimator for MonteCarlo {
    fn fill(
        &self,
        block: &mut TileBlock,
        mesh: &TiledMesh<'_>,
        tiles: TilePair<'_>,
        workspace: &mut Workspace,
    ) {
        let occluders = &mesh.blockers.occluders;
        let wall = |patch: &Patch| mesh.blockers.wall(patch);
        let [tile, other] = [tiles.tile, tiles.other].map(|tile| &mesh.tiling.tiles[tile]);
        for (lane, &i) in tile.patches.iter().enumerate() {
            let ends = [&mesh.bounds[i], &other.bound];
            let Some(blockers) = mesh.view(tiles.blockers, ends, FEW) else {
                continue;
            };
            for (k, j) in mesh.on_other_walls(i, tiles.other) {
                let patches = [i, j].map(|patch| &mesh.mesh.patches[patch]);
                let walls = patches.map(wall);
                let visible = |p, q| !blockers.cuts(occluders, (walls[0], p), (walls[1], q));
                let ends = [(i, patches[0]), (j, patches[1])];
                let value = self.estimate(ends, &mut workspace.strata, visible);
                block.values[lane][k] = (value / self.total_area) as f32;
            }
        }
    }
}

impl MonteCarlo {
    pub(crate) fn new(mesh: &Mesh, (points, pairs): (u32, u32), seed: u64) -> MonteCarlo {
        MonteCarlo {
            points,
            pairs,
            seed,
            total_area: mesh.total_area(),
        }
    }

    /// `A_i F_ij` of patches with indices `(i, j)`; depends on these, the seed and the patches
    /// alone.
    fn estimate(
        &self,
        [(i, patch_i), (j, patch_j)]: [(usize, &Patch); 2],
        order: &mut Strata,
        visible: impl Fn(DVec3, DVec3) -> bool,
    ) -> f64 {
        let mut rng = Pcg64Mcg::seed_from_u64(Stream::of_pair(self.seed, i, j).seed());
        let strata = self.points * self.points;
        for strata_of in [&mut order.of_i, &mut order.of_j] {
            strata_of.clear();
            strata_of.extend(0..strata);
        }
        let mut sum = 0.0;
        for pair in 0..self.pairs {
            let position = (pair % strata) as usize;
            if position == 0 {
                order.of_i.shuffle(&mut rng);
                order.of_j.shuffle(&mut rng);
            }
            let p = self.draw(patch_i, order.of_i[position], &mut rng);
            let q = self.draw(patch_j, order.of_j[position], &mut rng);
            let k = kernel(p.point, patch_i.normal, q.point, patch_j.normal);
            if k > 0.0 && visible(p.point, q.point) {
                sum += p.area * q.area * k;
            }
        }
        sum / f64::from(self.pairs)
    }

    fn draw(&self, patch: &Patch, stratum: u32, rng: &mut Pcg64Mcg) -> Sample {
        let uniform = DVec2::new(rng.random(), rng.random());
        jittered(&patch.polygon, self.points, stratum, uniform)
    }
}
