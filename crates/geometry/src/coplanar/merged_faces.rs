//! Faces that lie side by side in one plane, as the few large polygons that they make: fewer
//! things stand in the way.

use crate::bounds::Aabb;
use crate::mesh::{Face, FaceId, Mesh};
use crate::polygon::Polygon;
use crate::rays::occluders::plane_tolerance;
use glam::DVec3;
use std::collections::HashMap;

/// Polygons that cover the same points as the faces of a mesh do, with the same fronts.
#[derive(Clone, Debug)]
pub struct MergedFaces {
    /// The polygons; a [`FaceId`] is the position in this list where walls are meant.
    pub polygons: Vec<Polygon>,
    /// The wall that each face of the mesh is part of.
    pub of_face: Vec<FaceId>,
    /// Of each wall, whether its faces are [bare](crate::Face::is_bare).
    pub bare: Vec<bool>,
}

/// Edges that part by this angle at most run on. (That planes are the same is a matter of heights.)
const STRAIGHT: f64 = 1e-9;

impl MergedFaces {
    /// Joins faces that share an edge, lie in one plane and face the same way, as long as that
    /// gives a convex triangle or quadrilateral. Bare faces are joined to bare ones only.
    pub fn new(mesh: &Mesh) -> MergedFaces {
        let polygons = mesh.faces.iter().map(|face| face.polygon).collect();
        let bare = mesh.faces.iter().map(Face::is_bare).collect();
        let mut joining = Joining::new(polygons, bare);
        while joining.pass() {}
        joining.finish()
    }
}

/// An edge by the bits of its ends, in the order of its polygon.
pub(crate) type Edge = [[u64; 3]; 2];

struct Joining {
    /// `None` where a polygon has become part of another.
    polygons: Vec<Option<Polygon>>,
    part_of: Vec<usize>,
    bare: Vec<bool>,
    /// The polygon to the left of each edge.
    left_of: HashMap<Edge, usize>,
    /// The height up to which a corner counts as in a plane.
    tolerance: f64,
}

impl Joining {
    fn new(polygons: Vec<Polygon>, bare: Vec<bool>) -> Joining {
        let boxes = polygons.iter().map(Polygon::bounds);
        let bounds = boxes.fold(Aabb::EMPTY, Aabb::union);
        let mut joining = Joining {
            part_of: (0..polygons.len()).collect(),
            bare,
            left_of: HashMap::new(),
            tolerance: plane_tolerance(&bounds),
            polygons: polygons.into_iter().map(Some).collect(),
        };
        for k in 0..joining.polygons.len() {
            joining.enter(k);
        }
        joining
    }

    /// Joins what can be joined, polygon after polygon; whether anything could.
    fn pass(&mut self) -> bool {
        let mut any = false;
        for k in 0..self.polygons.len() {
            while let Some((other, union)) = self.neighbour(k) {
                self.leave(k);
                self.leave(other);
                self.polygons[other] = None;
                self.part_of[other] = k;
                self.polygons[k] = Some(union);
                self.enter(k);
                any = true;
            }
        }
        any
    }

    /// A polygon that can be joined to this one, and both together.
    fn neighbour(&self, k: usize) -> Option<(usize, Polygon)> {
        let polygon = self.polygons[k]?;
        edges(&polygon).find_map(|[a, b]| {
            let other = *self.left_of.get(&key([b, a]))?;
            if self.bare[other] != self.bare[k] {
                return None;
            }
            let union = union(&polygon, &self.polygons[other]?, [a, b], self.tolerance)?;
            (other != k).then_some((other, union))
        })
    }

    fn enter(&mut self, k: usize) {
        for edge in self.polygons[k].iter().flat_map(edges) {
            self.left_of.insert(key(edge), k);
        }
    }

    fn leave(&mut self, k: usize) {
        for edge in self.polygons[k].iter().flat_map(edges) {
            if self.left_of.get(&key(edge)) == Some(&k) {
                self.left_of.remove(&key(edge));
            }
        }
    }

    fn finish(self) -> MergedFaces {
        let mut places = vec![FaceId(0); self.polygons.len()];
        let (mut polygons, mut bare) = (Vec::new(), Vec::new());
        for (k, place) in places.iter_mut().enumerate() {
            *place = FaceId(polygons.len() as u32);
            if let Some(polygon) = self.polygons[k] {
                polygons.push(polygon);
                bare.push(self.bare[k]);
            }
        }
        let whole = |k: usize| {
            let next = |&k: &usize| (self.part_of[k] != k).then_some(self.part_of[k]);
            std::iter::successors(Some(k), next).last().unwrap_or(k)
        };
        let of_face = (0..places.len()).map(|k| places[whole(k)]).collect();
        MergedFaces {
            polygons,
            of_face,
            bare,
        }
    }
}

/// The edges of a polygon, in order.
pub(crate) fn edges(polygon: &Polygon) -> impl Iterator<Item = [DVec3; 2]> {
    let corners = polygon.corners();
    (0..corners.len()).map(move |k| [corners[k], corners[(k + 1) % corners.len()]])
}

pub(crate) fn key(edge: [DVec3; 2]) -> Edge {
    // Adding zero makes one zero of both.
    edge.map(|point| (point + 0.0).to_array().map(f64::to_bits))
}

/// Two polygons that share an edge, of which the first has `a` before `b`, as one.
fn union(p: &Polygon, q: &Polygon, [a, b]: [DVec3; 2], tolerance: f64) -> Option<Polygon> {
    let normal = p.normal();
    let height = |&c: &DVec3| normal.dot(c - a).abs();
    let same_plane = q.corners().iter().map(height).all(|h| h <= tolerance);
    if !same_plane || normal.dot(q.normal()) < 1.0 - STRAIGHT {
        return None;
    }
    let from = |polygon: &Polygon, first: DVec3| {
        let corners = polygon.corners();
        let start = corners.iter().position(|&c| c == first).unwrap_or(0);
        (0..corners.len())
            .map(|k| corners[(start + k) % corners.len()])
            .collect::<Vec<_>>()
    };
    // Around the first from `b` to `a`, then around the second back.
    let mut ring = from(p, b);
    let second = from(q, a);
    ring.extend(&second[1..second.len() - 1]);
    let turn = |k: usize| {
        let n = ring.len();
        let (into, out) = (ring[k] - ring[(k + n - 1) % n], ring[(k + 1) % n] - ring[k]);
        normal.dot(into.cross(out)) / (into.length() * out.length())
    };
    let turns: Vec<f64> = (0..ring.len()).map(turn).collect();
    if turns.iter().any(|&turn| turn < -STRAIGHT) {
        return None;
    }
    let corners = ring
        .iter()
        .zip(&turns)
        .filter(|&(_, &turn)| turn > STRAIGHT);
    match corners.map(|(&corner, _)| corner).collect::<Vec<_>>()[..] {
        [a, b, c] => Some(Polygon::triangle([a, b, c])),
        [a, b, c, d] => Some(Polygon::quad([a, b, c, d])),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
