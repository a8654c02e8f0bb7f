//! What can stand between two parts of the scene, found once for many segments.

use crate::bounds::Aabb;
use crate::mesh::FaceId;
use crate::occluders::{Occluder, Occluders, ordered};
use crate::shaft::Shaft;
use glam::DVec3;
use radiosity_simd::{Kernel, Simd, dispatch};
use std::ops::ControlFlow;

/// Where many segments begin, or end.
#[derive(Clone, Copy, Debug)]
pub struct End<'a> {
    /// They do so in the convex hull of these points,
    pub corners: &'a [DVec3],
    /// and on this face, if it is one and the same: in front of it.
    pub face: Option<FaceId>,
}

/// So many candidates are listed.
const FEW: usize = 64;

impl Occluders {
    /// The faces that may cut segments from one end to the other, unless they are too many to
    /// list.
    ///
    /// The faces of the ends do not count, nor does anything outside the shaft between the boxes
    /// of both, behind the face of either, or with both on one side of it; rounding counts as on
    /// the plane.
    pub fn between(&self, ends: [End<'_>; 2]) -> Option<Vec<FaceId>> {
        let occluders = self;
        dispatch(Collect { occluders, ends })
    }

    /// Whether a face cuts the open segment from `p` to `q`, as [`Occluders::blocked`] has it.
    pub fn cuts(&self, face: FaceId, p: DVec3, q: DVec3) -> bool {
        let [p, q] = ordered(p, q);
        self.faces[face.index()].cuts(p, q, self.plane_tolerance)
    }
}

struct Collect<'a> {
    occluders: &'a Occluders,
    ends: [End<'a>; 2],
}

impl Kernel for Collect<'_> {
    type Output = Option<Vec<FaceId>>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Option<Vec<FaceId>> {
        let Collect { occluders, ends } = self;
        let [from, to] = ends.map(|end| Aabb::around(end.corners.iter().copied()));
        let shaft = Shaft::new(from, to, &occluders.tree.frame);
        let mut few = Vec::new();
        let mut crowded = false;
        occluders.tree.within(simd, &shaft, |leaf, lane| {
            let face = FaceId(occluders.blocks[leaf].face(lane));
            if self.may_block(face) {
                crowded = few.len() == FEW;
                few.push(face);
            }
            if crowded {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        (!crowded).then_some(few)
    }
}

impl Collect<'_> {
    fn may_block(&self, face: FaceId) -> bool {
        if self.ends.iter().any(|end| end.face == Some(face)) {
            return false;
        }
        let occluders = self.occluders;
        let tolerance = occluders.plane_tolerance;
        let face = &occluders.faces[face.index()];
        let [from, to] = self.ends.map(|end| reach(face, end.corners));
        let above = from.0.max(to.0) > tolerance;
        let below = from.1.max(to.1) > tolerance;
        let in_front = |end: FaceId| {
            let end = &occluders.faces[end.index()];
            reach(end, &face.corners).0 > tolerance
        };
        above && below && self.ends.iter().filter_map(|end| end.face).all(in_front)
    }
}

/// The largest height of some points over a face's plane, and the largest depth below it.
fn reach(face: &Occluder, points: &[DVec3]) -> (f64, f64) {
    let heights = points.iter().map(|&p| face.height(p));
    heights.fold((0.0, 0.0), |(high, deep): (f64, f64), h| {
        (high.max(h), deep.max(-h))
    })
}
