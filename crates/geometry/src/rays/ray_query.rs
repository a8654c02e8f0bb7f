//! The questions that rays put to the tree of faces, for any instruction set.

use crate::mesh::FaceId;
use crate::rays::bvh::{Visitor, bits};
use crate::rays::occluders::{Hit, Occluders};
use crate::rays::ray::Ray;
use glam::DVec3;
use radiosity_simd::{Kernel, Simd};
use std::ops::ControlFlow;

/// A ray, the range of its parameters that counts, and the face that does not.
#[derive(Clone, Copy)]
pub(crate) struct Reach<'a> {
    pub(crate) occluders: &'a Occluders,
    pub(crate) ray: &'a Ray,
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) except: Option<FaceId>,
}

/// [`Occluders::closest_hit`].
pub(crate) struct ClosestHit<'a> {
    reach: Reach<'a>,
    front: Option<Nearest>,
    back: Option<Nearest>,
    /// What is met lies no farther: what does is behind some face, and not in its plane.
    horizon: f64,
}

/// The nearest of some faces.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Nearest {
    /// Where it counts as met: later than at `t` where others lie on it.
    set_back: f64,
    face: FaceId,
    t: f64,
}

/// [`Occluders::any_hit`].
pub(crate) struct AnyHit<'a> {
    reach: Reach<'a>,
    found: bool,
}

/// [`Occluders::blocked`].
pub(crate) struct Blocked<'a> {
    occluders: &'a Occluders,
    ray: Ray,
    ends: [DVec3; 2],
    except: [FaceId; 2],
    found: bool,
}

#[cfg(test)]
mod tests;

impl<'a> Reach<'a> {
    pub(crate) fn closest_hit(self) -> ClosestHit<'a> {
        ClosestHit {
            reach: self,
            front: None,
            back: None,
            horizon: self.to,
        }
    }

    pub(crate) fn any_hit(self) -> AnyHit<'a> {
        AnyHit {
            reach: self,
            found: false,
        }
    }

    #[inline(always)]
    fn search<S: Simd>(&self, simd: S, visitor: &mut impl Visitor) {
        let tree = &self.occluders.tree;
        tree.along(simd, self.ray, self.from, self.to, visitor);
    }
}

impl Kernel for ClosestHit<'_> {
    type Output = Option<Hit>;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) -> Option<Hit> {
        let reach = self.reach;
        reach.search(simd, &mut self);
        let within = |nearest: &Nearest| nearest.t <= self.horizon;
        let [front, back] = [self.front, self.back].map(|side| side.filter(within));
        front.or(back).map(|Nearest { t, face, .. }| Hit {
            t,
            face,
            front: front.is_some(),
            backed: front.is_some() && back.is_some(),
        })
    }
}

impl Visitor for ClosestHit<'_> {
    #[inline(always)]
    fn visit<S: Simd>(&mut self, simd: S, leaf: usize, limit: &mut f64) -> ControlFlow<()> {
        let Reach {
            occluders,
            ray,
            from,
            except,
            ..
        } = self.reach;
        let block = &occluders.blocks[leaf];
        let hits = block.hits(simd, ray, from, *limit);
        for lane in bits(hits.mask) {
            let face = occluders.face(leaf, lane);
            if Some(face) == except {
                continue;
            }
            let t = hits.t[lane];
            let (side, set_back) = match hits.front >> lane & 1 {
                0 => (&mut self.back, t),
                _ => (&mut self.front, t + occluders.set_back(face, ray)),
            };
            let found = Nearest { set_back, face, t };
            if side.is_none_or(|nearest| found < nearest) {
                *side = Some(found);
            }
            self.horizon = self.horizon.min(t + occluders.in_plane(face, ray));
        }
        *limit = self.horizon;
        ControlFlow::Continue(())
    }
}

impl Kernel for AnyHit<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) -> bool {
        let reach = self.reach;
        reach.search(simd, &mut self);
        self.found
    }
}

impl Visitor for AnyHit<'_> {
    #[inline(always)]
    fn visit<S: Simd>(&mut self, simd: S, leaf: usize, limit: &mut f64) -> ControlFlow<()> {
        let Reach {
            occluders,
            ray,
            from,
            except,
            ..
        } = self.reach;
        let block = &occluders.blocks[leaf];
        let hits = block.hits(simd, ray, from, *limit);
        self.found = bits(hits.mask).any(|lane| Some(occluders.face(leaf, lane)) != except);
        stop_if(self.found)
    }
}

impl<'a> Blocked<'a> {
    /// `ends` in the order of [`ordered`](crate::rays::occluders::ordered).
    pub(crate) fn new(
        occluders: &'a Occluders,
        except: [FaceId; 2],
        ends: [DVec3; 2],
    ) -> Blocked<'a> {
        Blocked {
            occluders,
            ray: Ray::new(ends[0], ends[1] - ends[0]),
            ends,
            except,
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
        let occluders = self.occluders;
        let (block, tolerance) = (&occluders.blocks[leaf], occluders.plane_tolerance);
        let mask = block.cut(simd, &self.ray, self.ends, tolerance);
        self.found = bits(mask).any(|lane| !self.except.contains(&occluders.face(leaf, lane)));
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
