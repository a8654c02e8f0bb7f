//! What rays and segments meet: closest hits for pictures, any hits for visibility.

use crate::bounds::Aabb;
use crate::bvh::{Bvh, Visit};
use crate::mesh::{Face, FaceId, Mesh};
use crate::polygon::Polygon;
use crate::ray::Ray;
use glam::DVec3;

/// The undivided faces of a mesh, ready for rays. Both sides of a face block.
#[derive(Clone, Debug)]
pub struct Occluders {
    faces: Vec<Occluder>,
    tree: Bvh,
    /// Heights below this count as "in the plane": the rounding of coordinates of this scene.
    plane_tolerance: f64,
}

#[derive(Clone, Copy, Debug)]
struct Occluder {
    corners: [DVec3; 4],
    normal: DVec3,
    offset: f64,
}

/// Where a ray meets a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Ray parameter.
    pub t: f64,
    /// The face.
    pub face: FaceId,
    /// Whether the ray meets the side that the normal points to.
    pub front: bool,
}

/// What can stand between one polygon and another: see [`Occluders::sight`].
#[derive(Clone, Copy, Debug)]
pub struct Sight(Between);

#[derive(Clone, Copy, Debug)]
enum Between {
    Nothing,
    Few(FewFaces),
    /// Too many faces to list, or unknown.
    Anything,
}

impl Sight {
    /// Nothing is known, so everything is tried.
    pub const UNKNOWN: Sight = Sight(Between::Anything);
}

/// A short list of faces.
#[derive(Clone, Copy, Debug)]
struct FewFaces {
    faces: [u32; FewFaces::CAPACITY],
    count: usize,
}

impl FewFaces {
    /// Beyond this many candidates a tree is faster than a list.
    const CAPACITY: usize = 12;

    fn push(&mut self, face: u32) -> bool {
        let fits = self.count < Self::CAPACITY;
        if fits {
            self.faces[self.count] = face;
            self.count += 1;
        }
        fits
    }
}

/// Rounding of coordinates, relative to the largest of them.
const RELATIVE_PLANE_TOLERANCE: f64 = 1e-12;

impl Occluder {
    fn new(face: &Face) -> Occluder {
        let corners = *face.polygon.padded_corners();
        Occluder {
            corners,
            normal: face.normal,
            offset: face.normal.dot(corners[0]),
        }
    }

    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }

    /// The largest height of some points over the plane, and the largest depth below it.
    fn reach(&self, points: &[DVec3; 4]) -> (f64, f64) {
        let heights = points.map(|p| self.height(p));
        (
            heights.into_iter().fold(0.0, f64::max),
            heights.into_iter().fold(0.0, |depth, h| depth.max(-h)),
        )
    }
}

impl Occluders {
    /// Prepares all faces of a mesh.
    pub fn new(mesh: &Mesh) -> Occluders {
        let boxes = mesh.faces.iter().map(|face| face.polygon.bounds());
        let all = boxes.clone().fold(Aabb::EMPTY, Aabb::union);
        let largest = all.min.abs().max(all.max.abs()).max_element();
        let plane_tolerance = RELATIVE_PLANE_TOLERANCE * largest;
        // A ray within the side of a flat box must find it.
        let boxes: Vec<Aabb> = boxes.map(|b| b.grown(plane_tolerance)).collect();
        Occluders {
            faces: mesh.faces.iter().map(Occluder::new).collect(),
            tree: Bvh::new(&boxes),
            plane_tolerance,
        }
    }

    /// The first face that a ray meets at a parameter in `from..=to`, other than `except`.
    ///
    /// Name the face that the ray leaves as `except`: rounding may put the origin on either
    /// side of it. Of two hits at the same parameter the face that comes first wins.
    pub fn closest_hit(
        &self,
        ray: &Ray,
        from: f64,
        to: f64,
        except: Option<FaceId>,
    ) -> Option<Hit> {
        let mut closest: Option<Hit> = None;
        self.tree.along(ray, from, to, |item, limit| {
            let face = FaceId(item);
            if Some(face) != except
                && let Some(hit) = self.hit(ray, face, from, *limit)
                && closest.is_none_or(|best| hit.t < best.t || face < best.face)
            {
                *limit = hit.t;
                closest = Some(hit);
            }
            Visit::Continue
        });
        closest
    }

    /// Whether a ray meets any face at a parameter in `from..=to`, other than `except`.
    pub fn any_hit(&self, ray: &Ray, from: f64, to: f64, except: Option<FaceId>) -> bool {
        let mut found = false;
        self.tree.along(ray, from, to, |item, limit| {
            let face = FaceId(item);
            if Some(face) != except && self.hit(ray, face, from, *limit).is_some() {
                found = true;
                return Visit::Stop;
            }
            Visit::Continue
        });
        found
    }

    fn hit(&self, ray: &Ray, id: FaceId, from: f64, to: f64) -> Option<Hit> {
        let face = &self.faces[id.index()];
        let approach = face.normal.dot(ray.direction);
        let t = -face.height(ray.origin) / approach;
        // A ray parallel to the plane gives an infinite or NaN parameter, which no range holds.
        ((from..=to).contains(&t) && ray.pierces(&face.corners)).then_some(Hit {
            t,
            face: id,
            front: approach < 0.0,
        })
    }

    /// Collects what may block segments from a polygon in front of face `i` to face `j`.
    ///
    /// `from` is a part of face `i`, `to` a part of face `j`. Neither face counts, nor does
    /// anything outside the box around both polygons, behind either plane, or with both
    /// polygons on one side of it; rounding counts as on the plane.
    pub fn sight(&self, i: FaceId, from: &Polygon, j: FaceId, to: &Polygon) -> Sight {
        let shaft = from.bounds().union(to.bounds());
        let mut few = FewFaces {
            faces: [0; FewFaces::CAPACITY],
            count: 0,
        };
        let mut crowded = false;
        self.tree.within(&shaft, |item| {
            let relevant = item != i.0 && item != j.0 && self.may_block(item, i, from, j, to);
            if relevant && !few.push(item) {
                crowded = true;
                return Visit::Stop;
            }
            Visit::Continue
        });
        Sight(match (crowded, few.count) {
            (true, _) => Between::Anything,
            (false, 0) => Between::Nothing,
            (false, _) => Between::Few(few),
        })
    }

    fn may_block(&self, item: u32, i: FaceId, from: &Polygon, j: FaceId, to: &Polygon) -> bool {
        let tolerance = self.plane_tolerance;
        let face = &self.faces[item as usize];
        let in_front = |end: FaceId| self.faces[end.index()].reach(&face.corners).0 > tolerance;
        let (from_above, from_below) = face.reach(from.padded_corners());
        let (to_above, to_below) = face.reach(to.padded_corners());
        let above = from_above.max(to_above) > tolerance;
        let below = from_below.max(to_below) > tolerance;
        above && below && in_front(i) && in_front(j)
    }

    /// Whether a face other than `i` and `j` cuts the open segment from `p` on face `i` to `q`
    /// on face `j`. `sight` must come from polygons that contain `p` and `q`.
    ///
    /// A face whose plane contains an end of the segment does not cut it: a cover that lies
    /// exactly on a face does not hide it. Segments that graze an edge are decided by rounding,
    /// but the same way from either end.
    pub fn blocked(&self, sight: &Sight, i: FaceId, p: DVec3, j: FaceId, q: DVec3) -> bool {
        match &sight.0 {
            Between::Nothing => false,
            Between::Few(few) => {
                let (p, q) = ordered(p, q);
                few.faces[..few.count].iter().any(|&f| self.cuts(f, p, q))
            }
            Between::Anything => {
                let (p, q) = ordered(p, q);
                let ray = Ray::new(p, q - p);
                let mut found = false;
                self.tree.along(&ray, 0.0, 1.0, |item, _| {
                    found = item != i.0 && item != j.0 && self.cuts(item, p, q);
                    if found { Visit::Stop } else { Visit::Continue }
                });
                found
            }
        }
    }

    fn cuts(&self, item: u32, p: DVec3, q: DVec3) -> bool {
        let face = &self.faces[item as usize];
        let (at_p, at_q) = (face.height(p), face.height(q));
        let nearer = at_p.abs().min(at_q.abs());
        at_p * at_q < 0.0
            && nearer > self.plane_tolerance
            && Ray::new(p, q - p).pierces(&face.corners)
    }
}

/// The ends of a segment in an order that does not depend on which one was named first.
fn ordered(p: DVec3, q: DVec3) -> (DVec3, DVec3) {
    if p.to_array() <= q.to_array() {
        (p, q)
    } else {
        (q, p)
    }
}
