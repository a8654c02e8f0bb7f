//! Rays against pairs of boxes, in single precision and yet never missing a box.
//!
//! Coordinates are taken relative to the centre of the scene, and a ray is first moved to where
//! it enters the scene, so no number is larger than the scene. What rounding to `f32` can then
//! move is at most [`PADDING`] of the scene's extent, by which all boxes grow, and
//! [`RELATIVE_ERROR`] of a parameter, by which exits grow (Ize, "Robust BVH Ray Traversal",
//! JCGT 2013).

use crate::bounds::Aabb;
use crate::ray::Ray;
use glam::{DVec3, Vec4, Vec4Swizzles};

/// Of the scene's extent: the origin and the box each round by at most 2^-25 of it (coordinates
/// reach half the extent); eight times that, to be safe.
const PADDING: f64 = 1.0 / (1 << 22) as f64;
/// Direction, its inverse, the difference and the product round by 2^-24 each, on entry and on
/// exit: 5e-7; doubled, to be safe.
const RELATIVE_ERROR: f32 = 1e-6;

/// Two boxes, by axis: `(min of 0, min of 1, max of 0, max of 1)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoxPair {
    axes: [Vec4; 3],
}

/// A ray for boxes: parameters count from where it enters the scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SlabRay {
    origin: [Vec4; 3],
    inverse_direction: [Vec4; 3],
    start: f64,
}

impl BoxPair {
    /// Boxes of nothing. A ray may be said to enter them; their children hold no items.
    pub(crate) const EMPTY: BoxPair = BoxPair {
        axes: [Vec4::new(
            f32::INFINITY,
            f32::INFINITY,
            f32::NEG_INFINITY,
            f32::NEG_INFINITY,
        ); 3],
    };

    /// Boxes in a scene of the given centre and extent.
    pub(crate) fn new(boxes: [Aabb; 2], center: DVec3, extent: DVec3) -> BoxPair {
        let padding = PADDING * extent.max_element();
        let [a, b] = boxes.map(|b| b.grown(padding));
        let axis = |k: usize| {
            let [low, high] = [[a.min, b.min], [a.max, b.max]]
                .map(|sides| sides.map(|side| (side[k] - center[k]) as f32));
            Vec4::new(low[0], low[1], high[0], high[1])
        };
        BoxPair {
            axes: [axis(0), axis(1), axis(2)],
        }
    }

    /// Where the ray enters each box, if it does so before `limit`.
    pub(crate) fn enter(&self, ray: &SlabRay, limit: f32) -> [Option<f32>; 2] {
        let mut entry = Vec4::ZERO;
        let mut exit = Vec4::splat(limit);
        for k in 0..3 {
            let t = (self.axes[k] - ray.origin[k]) * ray.inverse_direction[k];
            let swapped = t.zwxy();
            entry = entry.max(t.min(swapped));
            exit = exit.min(t.max(swapped));
        }
        let exit = exit * (1.0 + RELATIVE_ERROR);
        let hit = |entry: f32, exit: f32| (entry <= exit).then_some(entry);
        [hit(entry.x, exit.x), hit(entry.y, exit.y)]
    }

    /// Which boxes share a point with their counterpart.
    pub(crate) fn overlap(&self, other: &BoxPair) -> [bool; 2] {
        let mut gap = Vec4::NEG_INFINITY;
        for k in 0..3 {
            // Minimum over the other's maximum, or maximum under the other's minimum.
            let distance = self.axes[k] - other.axes[k].zwxy();
            gap = gap.max(distance * Vec4::new(1.0, 1.0, -1.0, -1.0));
        }
        [gap.x.max(gap.z) <= 0.0, gap.y.max(gap.w) <= 0.0]
    }
}

impl SlabRay {
    /// Prepares a ray; `None` if it misses the scene's box within `from..=limit`.
    pub(crate) fn new(
        ray: &Ray,
        scene: &Aabb,
        center: DVec3,
        from: f64,
        limit: f64,
    ) -> Option<SlabRay> {
        let start = ray.enters(scene, from, limit)?;
        let origin = (ray.at(start) - center).as_vec3();
        let inverse = ray.direction.as_vec3().map(finite_inverse);
        let splat = |v: glam::Vec3| [v.x, v.y, v.z].map(Vec4::splat);
        Some(SlabRay {
            origin: splat(origin),
            inverse_direction: splat(inverse),
            start,
        })
    }

    /// A parameter of the ray as boxes count it, rounded up.
    pub(crate) fn parameter(&self, t: f64) -> f32 {
        (t - self.start).max(0.0) as f32 * (1.0 + RELATIVE_ERROR)
    }
}

/// `1 / x`, kept finite so that a slab test never multiplies zero by infinity.
fn finite_inverse(x: f32) -> f32 {
    const LARGEST: f32 = 1e30;
    if x.abs() < 1.0 / LARGEST {
        LARGEST.copysign(x)
    } else {
        1.0 / x
    }
}
