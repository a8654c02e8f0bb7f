//! The plain Monte Carlo estimator of one pair.

use crate::exchange::kernel;
use crate::points::{Sample, jittered};
use radiosity_geometry::{DVec2, DVec3, Patch};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// The settings of [`Estimator::MonteCarlo`](crate::Estimator::MonteCarlo), with reusable room
/// for the shuffled strata.
pub(crate) struct MonteCarlo {
    pub(crate) points: u32,
    pub(crate) pairs: u32,
    pub(crate) seed: u64,
    order_i: Vec<u32>,
    order_j: Vec<u32>,
}

impl MonteCarlo {
    pub(crate) fn new(points: u32, pairs: u32, seed: u64) -> MonteCarlo {
        MonteCarlo {
            points,
            pairs,
            seed,
            order_i: Vec::new(),
            order_j: Vec::new(),
        }
    }

    /// `S_ij` of patches with indices `(i, j)`; depends on these, the seed and the patches
    /// alone.
    pub(crate) fn estimate(
        &mut self,
        (i, patch_i): (usize, &Patch),
        (j, patch_j): (usize, &Patch),
        mut visible: impl FnMut(DVec3, DVec3) -> bool,
    ) -> f64 {
        let mut rng = Pcg64Mcg::seed_from_u64(stream(self.seed, i as u64, j as u64));
        let strata = self.points * self.points;
        for order in [&mut self.order_i, &mut self.order_j] {
            order.clear();
            order.extend(0..strata);
        }
        let mut sum = 0.0;
        for pair in 0..self.pairs {
            let position = (pair % strata) as usize;
            if position == 0 {
                self.order_i.shuffle(&mut rng);
                self.order_j.shuffle(&mut rng);
            }
            let p = self.draw(patch_i, self.order_i[position], &mut rng);
            let q = self.draw(patch_j, self.order_j[position], &mut rng);
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

/// An independent seed for each pair: three rounds of the finalizer of SplitMix64
/// (Steele, Lea & Flood, "Fast Splittable Pseudorandom Number Generators", 2014).
fn stream(seed: u64, i: u64, j: u64) -> u64 {
    let mix = |state: u64, next: u64| {
        let z = state.wrapping_add(next).wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    mix(mix(mix(0, seed), i), j)
}
