//! The plain Monte Carlo estimator of one pair.

use crate::exchange::kernel;
use crate::points::{Sample, jittered};
use crate::random::Stream;
use radiosity_geometry::{DVec2, DVec3, Patch};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// The settings of [`Estimator::MonteCarlo`](crate::Estimator::MonteCarlo).
pub(crate) struct MonteCarlo {
    points: u32,
    pairs: u32,
    seed: u64,
}

/// Reusable room for the shuffled strata of either patch.
#[derive(Default)]
pub(crate) struct Strata {
    of_i: Vec<u32>,
    of_j: Vec<u32>,
}

impl MonteCarlo {
    pub(crate) fn new(points: u32, pairs: u32, seed: u64) -> MonteCarlo {
        MonteCarlo {
            points,
            pairs,
            seed,
        }
    }

    /// `A_i F_ij` of patches with indices `(i, j)`; depends on these, the seed and the patches
    /// alone.
    pub(crate) fn estimate(
        &self,
        [(i, patch_i), (j, patch_j)]: [(usize, &Patch); 2],
        order: &mut Strata,
        mut visible: impl FnMut(DVec3, DVec3) -> bool,
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
