//! The mean radiosity of each cell of a subdivision.

use crate::Rgb;
use crate::emitters::uniform_point;
use crate::path::walk;
use crate::statistics::Samples;
use crate::world::World;
use radiosity_geometry::Mesh;
use radiosity_scene::Scene;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

/// The mean radiosity of one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellMean {
    /// W/m^2.
    pub radiosity: Rgb,
    /// Standard error of the mean, W/m^2.
    pub standard_error: Rgb,
}

/// Estimates the mean radiosity of each patch of a mesh of the scene, hidden parts included, by
/// `samples` random walks from each; indexed by patch.
///
/// Each patch has random numbers of its own, so the result does not depend on threads.
/// `progress` is told how many further patches are done, from any thread.
pub fn cell_means(
    scene: &Scene,
    mesh: &Mesh,
    samples: u32,
    seed: u64,
    progress: &(dyn Fn(u64) + Sync),
) -> Vec<CellMean> {
    let world = World::new(scene, mesh);
    let cell = |(index, patch): (usize, &radiosity_geometry::Patch)| {
        let stream = (index as u64) << 32 ^ seed.rotate_left(17);
        let mut rng = Pcg64Mcg::seed_from_u64(stream);
        let mut sums = Samples::default();
        for _ in 0..samples {
            let start = (patch.face, uniform_point(&patch.polygon, &mut rng));
            sums.add(walk(&world, start, &mut rng).radiosity);
        }
        progress(1);
        CellMean {
            radiosity: sums.mean(),
            standard_error: sums.standard_error(),
        }
    };
    mesh.patches.par_iter().enumerate().map(cell).collect()
}
