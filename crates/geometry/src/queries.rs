//! The questions that rays put to the tree of faces, for any instruction set.

use crate::bvh::{Visitor, bits};
use crate::mesh::FaceId;
use crate::occluders::{Hit, Occluders};
use crate::ray::Ray;
use glam::DVec3;
use radiosity_simd::{Kernel, Simd};
use std::ops::ControlFlow;

/// [`Occluders::closest_hit`].
pub(crate) struct ClosestHit<'a> {
    occluders: &'a Occluders,
    ray: &'a Ray,
    from: f64,
    to: f64,
    except: u32,
    closest: Option<Hit>,
}

/// [`Occluders::any_hit`].
pub(crate) struct AnyHit<'a> {
    occluders: &'a Occluders,
    ray: &'a Ray,
    from: f64,
    to: f64,
    except: u32,
    found: bool,
}

/// [`Occluders::blocked`].
pub(crate) struct Blocked<'a> {
    occluders: &'a Occluders,
    ray: Ray,
    ends: [DVec3; 2],
    except: [u32; 2],
    found: bool,
}

#[cfg(test)]
mod tests;

/// The index of no face.
const NONE: u32 = u32::MAX;

impl<'a> ClosestHit<'a> {
    pub(crate) fn new(
        occluders: &'a Occluders,
        ray: &'a Ray,
        from: f64,
        to: f64,
        except: Option<FaceId>,
    ) -> ClosestHit<'a> {
        ClosestHit {
            occluders,
            ray,
            from,
            to,
            except: except.map_or(NONE, |face| face.0),
            closest: None,
        }
    }
}

impl Kernel for ClosestHit<'_> {
    type Output = Option<Hit>;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) -> Option<Hit> {
        let tree = &self.occluders.tree;
        tree.along(simd, self.ray, self.from, self.to, &mut self);
        self.closest
    }
}

impl Visitor for ClosestHit<'_> {
    #[inline(always)]
    fn visit<S: Simd>(&mut self, simd: S, leaf: usize, limit: &mut f64) -> ControlFlow<()> {
        let block = &self.occluders.blocks[leaf];
        let hits = block.hits(simd, self.ray, self.from, *limit);
        for lane in bits(hits.mask) {
            let (t, face) = (hits.t[lane], block.face(lane));
            let first = |best: Hit| t < best.t || t == best.t && face < best.face.0;
            if face != self.except && self.closest.is_none_or(first) {
                *limit = t;
                self.closest = Some(Hit {
                    t,
                    face: FaceId(face),
                    front: hits.front >> lane & 1 != 0,
                });
            }
        }
        ControlFlow::Continue(())
    }
}

impl<'a> AnyHit<'a> {
    pub(crate) fn new(
        occluders: &'a Occluders,
        ray: &'a Ray,
        from: f64,
        to: f64,
        except: Option<FaceId>,
    ) -> AnyHit<'a> {
        AnyHit {
            occluders,
            ray,
            from,
            to,
            except: except.map_or(NONE, |face| face.0),
            found: false,
        }
    }
}

impl Kernel for AnyHit<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) -> bool {
        let tree = &self.occluders.tree;
        tree.along(simd, self.ray, self.from, self.to, &mut self);
        self.found
    }
}

impl Visitor for AnyHit<'_> {
    #[inline(always)]
    fn visit<S: Simd>(&mut self, simd: S, leaf: usize, limit: &mut f64) -> ControlFlow<()> {
        let block = &self.occluders.blocks[leaf];
        let hits = block.hits(simd, self.ray, self.from, *limit);
        self.found = bits(hits.mask).any(|lane| block.face(lane) != self.except);
        stop_if(self.found)
    }
}

impl<'a> Blocked<'a> {
    /// `ends` in the order of [`ordered`](crate::occluders::ordered).
    pub(crate) fn new(
        occluders: &'a Occluders,
        except: [FaceId; 2],
        ends: [DVec3; 2],
    ) -> Blocked<'a> {
        Blocked {
            occluders,
            ray: Ray::new(ends[0], ends[1] - ends[0]),
            ends,
            except: except.map(|face| face.0),
            found: false,
        }
    }
}

impl Kernel for Blocked<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) -> bool {
        let (tree, ray) = (&self.occluders.tree, self.ray);
        tree.along(simd, &ray, 0.0, 1.0, &mut self);
        self.found
    }
}

impl Visitor for Blocked<'_> {
    #[inline(always)]
    fn visit<S: Simd>(&mut self, simd: S, leaf: usize, _: &mut f64) -> ControlFlow<()> {
        let block = &self.occluders.blocks[leaf];
        let tolerance = self.occluders.plane_tolerance;
        let mask = block.cut(simd, &self.ray, self.ends, tolerance);
        self.found = bits(mask).any(|lane| !self.except.contains(&block.face(lane)));
        stop_if(self.found)
    }
}

#[inline(always)]
fn stop_if(found: bool) -> ControlFlow<()> {
    if found {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}
