//! What a patch sees that is no front: backs of faces, and nothing at all.
//!
//! Measured by rays, independently of the factors: together they account for everything that a
//! patch sees.

use crate::points::jittered;
use crate::random::Stream;
use crate::visible::{Shifts, folded, shifts};
use radiosity_geometry::{DVec2, DVec3, FaceId, Occluders, Patch, Ray};
use radiosity_simd::LANES;
use std::f64::consts::TAU;

/// Rays from each patch, under each of eight shifts. A power of two.
const RAYS: usize = 32;
/// Tells these shifts from those of pairs of patches.
const SEED: u64 = 1;

/// Shares of all that a patch sees, by form factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Surroundings {
    pub(crate) backs: f64,
    pub(crate) background: f64,
    /// Standard error of their sum.
    pub(crate) error: f64,
}

/// What a ray has met.
enum Met {
    Front,
    Back,
    Nothing,
}

/// Looks around from the patch of this index.
pub(crate) fn look_around(occluders: &Occluders, patch: &Patch, index: usize) -> Surroundings {
    let shifts = shifts(Stream::of_pair(SEED, index, index));
    // By shift: weights of all rays, of those that met backs, and of those that met nothing.
    let mut sums = [[0.0; 3]; LANES];
    for (lane, sums) in sums.iter_mut().enumerate() {
        for k in 0..RAYS {
            let (weight, ray) = ray(patch, k, &shifts, lane);
            sums[0] += weight;
            match meet(occluders, &ray, patch.face) {
                Met::Front => {}
                Met::Back => sums[1] += weight,
                Met::Nothing => sums[2] += weight,
            }
        }
    }
    let total = |k: usize| sums.iter().map(|sums| sums[k]).sum::<f64>();
    let (all, backs, background) = (total(0), total(1), total(2));
    let share = (backs + background) / all;
    let residual = |sums: &[f64; 3]| (sums[1] + sums[2] - share * sums[0]).powi(2);
    let lanes = LANES as f64;
    let squares: f64 = sums.iter().map(residual).sum();
    let scatter = (lanes * squares / (lanes - 1.0)).sqrt() / all;
    // What is smaller than the share of one ray may have gone unseen.
    let unseen = 1.0 / (lanes * RAYS as f64);
    Surroundings {
        backs: backs / all,
        background: background / all,
        error: scatter.max(unseen),
    }
}

/// A ray from a point of the patch, with the area that it stands for, in a direction of density
/// `cos / pi` (Malley's method).
fn ray(patch: &Patch, k: usize, shifts: &Shifts, lane: usize) -> (f64, Ray) {
    let at = |c: usize| folded(k, c, shifts[c][lane]);
    let sample = jittered(&patch.polygon, 1, 0, DVec2::new(at(0), at(1)));
    let (sin, cos) = libm::sincos(TAU * at(2));
    let (tangent, bitangent) = patch.normal.any_orthonormal_pair();
    let squared = at(3);
    let aside: DVec3 = squared.sqrt() * (cos * tangent + sin * bitangent);
    let direction = aside + (1.0 - squared).sqrt() * patch.normal;
    (sample.area, Ray::new(sample.point, direction))
}

fn meet(occluders: &Occluders, ray: &Ray, from: FaceId) -> Met {
    match occluders.closest_hit(ray, 0.0, f64::INFINITY, Some(from)) {
        None => Met::Nothing,
        Some(hit) if hit.front => Met::Front,
        Some(_) => Met::Back,
    }
}
