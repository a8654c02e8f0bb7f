//! What can stand between two parts of the scene, found once for many segments.

use crate::bounds::Aabb;
use crate::mesh::FaceId;
use crate::rays::bvh::ShaftVisitor;
use crate::rays::occluders::{Occluders, ordered};
use crate::rays::shaft::Shaft;
use glam::DVec3;
use radiosity_simd::{Kernel, Simd, dispatch};
use std::ops::ControlFlow;

impl Occluders {
    /// The faces that reach into the shaft between two boxes, unless they are more than `most`:
    /// no others can cut a segment from one to the other.
    pub fn between(&self, ends: [Aabb; 2], most: usize) -> Option<Vec<FaceId>> {
        dispatch(Collect {
            occluders: self,
            ends,
            most,
        })
    }

    /// Whether a face cuts the open segment from `p` to `q`, as [`Occluders::blocked`] has it.
    pub fn cuts(&self, face: FaceId, p: DVec3, q: DVec3) -> bool {
        let [p, q] = ordered(p, q);
        self.faces[face.index()].cuts(p, q, self.plane_tolerance)
    }
}

struct Collect<'a> {
    occluders: &'a Occluders,
    ends: [Aabb; 2],
    most: usize,
}

/// The faces found so far; one more than `most` if they are too many.
struct Collection {
    most: usize,
    faces: Vec<FaceId>,
}

impl Kernel for Collect<'_> {
    type Output = Option<Vec<FaceId>>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Option<Vec<FaceId>> {
        let Collect {
            occluders,
            ends: [from, to],
            most,
        } = self;
        let shaft = Shaft::new(from, to, &occluders.tree.frame);
        let mut collection = Collection {
            most,
            faces: Vec::new(),
        };
        occluders.tree.within(simd, &shaft, &mut collection);
        (collection.faces.len() <= most).then_some(collection.faces)
    }
}

impl ShaftVisitor for Collection {
    #[inline(always)]
    fn visit<S: Simd>(&mut self, _: S, item: u32) -> ControlFlow<()> {
        self.faces.push(FaceId(item));
        if self.faces.len() > self.most {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}
