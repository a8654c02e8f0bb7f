//! Rays against boxes, eight at a time, in single precision and yet never missing a box.
//!
//! Coordinates are taken relative to the centre of the scene, and a ray is first moved to where
//! it enters the scene, so no number is larger than the scene. What rounding to `f32` can then
//! move is at most [`PADDING`] of the scene's extent, by which all boxes grow, and
//! [`RELATIVE_ERROR`] of a parameter, by which exits grow (Ize, "Robust BVH Ray Traversal",
//! JCGT 2013).

use crate::bounds::Aabb;
use crate::rays::ray::Ray;
use glam::{DVec3, Vec3};
use radiosity_simd::{Float, LANES, Simd};

/// Of the scene's extent: the origin and the box each round by at most 2^-25 of it (coordinates
/// reach half the extent); eight times that, to be safe.
const PADDING: f64 = 1.0 / (1 << 22) as f64;
/// Direction, its inverse, the difference and the product round by 2^-24 each, on entry and on
/// exit: 5e-7; doubled, to be safe.
pub(crate) const RELATIVE_ERROR: f32 = 1e-6;

/// Where a tree's boxes are in single precision.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub(crate) scene: Aabb,
    pub(crate) center: DVec3,
    /// The longest edge of the scene.
    pub(crate) extent: f64,
}

/// Eight boxes: the minima by axis, then the maxima.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct Boxes {
    sides: [[f32; LANES]; 6],
    /// The lanes that hold a box.
    used: u8,
}

/// A ray for boxes: parameters count from where it enters the scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SlabRay {
    origin: [f32; 3],
    inverse_direction: [f32; 3],
    /// The sides that the ray meets first, and last, by axis.
    near: [usize; 3],
    far: [usize; 3],
    start: f64,
}

impl Frame {
    pub(crate) fn new(scene: Aabb) -> Frame {
        Frame {
            scene,
            center: scene.center(),
            extent: scene.extent().max_element(),
        }
    }

    /// Prepares a ray; `None` if it misses the scene within `from..=limit`.
    #[inline(always)]
    pub(crate) fn ray(&self, ray: &Ray, from: f64, limit: f64) -> Option<SlabRay> {
        let mut start = from;
        let mut entry = ray.at(from);
        if !self.scene.contains(entry) {
            start = ray.enters(&self.scene, from, limit)?;
            entry = ray.at(start);
        }
        let inverse = inverse(ray.direction.as_vec3()).to_array();
        let near: [usize; 3] = std::array::from_fn(|k| if inverse[k] < 0.0 { k + 3 } else { k });
        Some(SlabRay {
            origin: (entry - self.center).as_vec3().to_array(),
            inverse_direction: inverse,
            near,
            far: near.map(|side| (side + 3) % 6),
            start,
        })
    }
}

impl Boxes {
    /// No boxes.
    pub(crate) const EMPTY: Boxes = Boxes {
        sides: [[0.0; LANES]; 6],
        used: 0,
    };

    /// Puts a box in a lane, rounded outwards.
    pub(crate) fn set(&mut self, lane: usize, bounds: Aabb, frame: &Frame) {
        let bounds = bounds.grown(PADDING * frame.extent);
        self.used |= 1 << lane;
        for k in 0..3 {
            self.sides[k][lane] = (bounds.min[k] - frame.center[k]) as f32;
            self.sides[k + 3][lane] = (bounds.max[k] - frame.center[k]) as f32;
        }
    }

    /// The lanes that hold a box.
    pub(crate) fn used(&self) -> u8 {
        self.used
    }

    /// All sides.
    pub(crate) fn sides(&self) -> &[[f32; LANES]; 6] {
        &self.sides
    }

    /// One side of all boxes: minima by axis, then maxima.
    #[inline(always)]
    pub(crate) fn side(&self, side: usize) -> &[f32; LANES] {
        &self.sides[side]
    }

    /// Which boxes the ray enters before `limit`, one bit each, and where.
    #[inline(always)]
    pub(crate) fn enter<S: Simd>(&self, simd: S, ray: &SlabRay, limit: f32) -> (u8, [f32; LANES]) {
        let mut entry = simd.splat_f32(0.0);
        let mut exit = simd.splat_f32(limit);
        for k in 0..3 {
            let origin = simd.splat_f32(ray.origin[k]);
            let inverse = simd.splat_f32(ray.inverse_direction[k]);
            let near = (simd.f32(&self.sides[ray.near[k]]) - origin) * inverse;
            let far = (simd.f32(&self.sides[ray.far[k]]) - origin) * inverse;
            entry = near.max(entry);
            exit = far.min(exit);
        }
        let exit = exit * simd.splat_f32(1.0 + RELATIVE_ERROR);
        (entry.less_or_equal(exit) & self.used, entry.lanes())
    }

    /// Which boxes share a point with the first box of `region`, one bit each.
    #[inline(always)]
    pub(crate) fn overlap<S: Simd>(&self, simd: S, region: &Boxes) -> u8 {
        let mut mask = self.used;
        for k in 0..3 {
            let low = simd.splat_f32(region.sides[k][0]);
            let high = simd.splat_f32(region.sides[k + 3][0]);
            mask &= simd.f32(&self.sides[k]).less_or_equal(high);
            mask &= low.less_or_equal(simd.f32(&self.sides[k + 3]));
        }
        mask
    }
}

impl SlabRay {
    /// A parameter of the ray as boxes count it, rounded up.
    #[inline]
    pub(crate) fn parameter(&self, t: f64) -> f32 {
        (t - self.start).max(0.0) as f32 * (1.0 + RELATIVE_ERROR)
    }
}

/// The largest inverse of a direction.
pub(crate) const LARGEST: f32 = 1e30;

/// `1 / d`, kept finite so that a slab test never multiplies zero by infinity.
#[inline(always)]
fn inverse(d: Vec3) -> Vec3 {
    // Four lanes divide at once.
    let inverse = d.extend(1.0).recip().truncate();
    inverse.clamp(Vec3::splat(-LARGEST), Vec3::splat(LARGEST))
}
