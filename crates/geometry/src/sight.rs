//! What can stand between two polygons, found once for many segments between them.

use crate::mesh::FaceId;
use crate::occluders::{Occluder, Occluders, ordered};
use crate::polygon::Polygon;
use crate::shaft::Shaft;
use arrayvec::ArrayVec;
use glam::DVec3;
use radiosity_simd::{Kernel, Simd, dispatch};
use std::ops::ControlFlow;

/// What can stand between one polygon and another: see [`Occluders::sight`].
#[derive(Clone, Debug)]
pub struct Sight<'a> {
    occluders: &'a Occluders,
    ends: [FaceId; 2],
    /// All faces that can stand between, unless they are too many to list.
    few: Option<FewFaces>,
}

/// So many candidates are listed.
const FEW: usize = 64;
/// For single segments a tree is faster than a longer list.
const FASTER_THAN_TREE: usize = 12;
type FewFaces = ArrayVec<u32, FEW>;

impl<'a> Sight<'a> {
    /// What can stand between parts of the two polygons.
    pub fn narrowed(&self, from: &Polygon, to: &Polygon) -> Sight<'a> {
        let [i, j] = self.ends;
        self.occluders.sight(i, from, j, to)
    }

    /// All faces that can stand between, unless they are too many to list.
    pub fn faces(&self) -> Option<&[u32]> {
        self.few.as_deref()
    }

    /// [`Occluders::blocked`] for a segment between points of the two polygons.
    pub fn blocked(&self, p: DVec3, q: DVec3) -> bool {
        match &self.few {
            Some(few) if few.len() <= FASTER_THAN_TREE => {
                let [p, q] = ordered(p, q);
                let tolerance = self.occluders.plane_tolerance;
                let face = |&face: &u32| &self.occluders.faces[face as usize];
                few.iter().any(|f| face(f).cuts(p, q, tolerance))
            }
            _ => {
                let [i, j] = self.ends;
                self.occluders.blocked(i, p, j, q)
            }
        }
    }
}

impl Occluders {
    /// Collects what may block segments from a polygon in front of face `i` to face `j`.
    ///
    /// `from` is a part of face `i`, `to` a part of face `j`. Neither face counts, nor does
    /// anything outside the shaft between the boxes of both polygons, behind either plane, or with both
    /// polygons on one side of it; rounding counts as on the plane.
    pub fn sight(&self, i: FaceId, from: &Polygon, j: FaceId, to: &Polygon) -> Sight<'_> {
        Sight {
            occluders: self,
            ends: [i, j],
            few: dispatch(Collect {
                occluders: self,
                ends: [i, j],
                polygons: [from, to],
            }),
        }
    }
}

struct Collect<'a> {
    occluders: &'a Occluders,
    ends: [FaceId; 2],
    polygons: [&'a Polygon; 2],
}

impl Kernel for Collect<'_> {
    type Output = Option<FewFaces>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Option<FewFaces> {
        let [from, to] = self.polygons;
        let frame = &self.occluders.tree.frame;
        let shaft = Shaft::new(from.bounds(), to.bounds(), frame);
        let mut few = FewFaces::new();
        let mut crowded = false;
        let occluders = self.occluders;
        occluders.tree.within(simd, &shaft, |leaf, lane| {
            let face = occluders.blocks[leaf].face(lane);
            crowded = self.may_block(face) && few.try_push(face).is_err();
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
    fn may_block(&self, item: u32) -> bool {
        if self.ends.contains(&FaceId(item)) {
            return false;
        }
        let tolerance = self.occluders.plane_tolerance;
        let face = &self.occluders.faces[item as usize];
        let in_front = |end: FaceId| {
            let end = &self.occluders.faces[end.index()];
            reach(end, &face.corners).0 > tolerance
        };
        let [from, to] = self.polygons.map(|p| reach(face, p.padded_corners()));
        let above = from.0.max(to.0) > tolerance;
        let below = from.1.max(to.1) > tolerance;
        above && below && self.ends.into_iter().all(in_front)
    }
}

/// The largest height of some points over a face's plane, and the largest depth below it.
fn reach(face: &Occluder, points: &[DVec3; 4]) -> (f64, f64) {
    let heights = points.map(|p| face.height(p));
    (
        heights.into_iter().fold(0.0, f64::max),
        heights.into_iter().fold(0.0, |depth, h| depth.max(-h)),
    )
}
