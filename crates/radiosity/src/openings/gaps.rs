//! Edges that bound a hole: no other face closes them, along all of their length.
//!
//! An edge of a single face may be closed all the same. The lower edges of a box lie on the floor
//! it stands on, and a long edge may run along several short ones. So what other faces hold of an
//! edge, in their plane and within their outline, is taken from it, and the edge is open if
//! something is left.

use super::edges::{Edges, Side};
use radiosity_geometry::{Aabb, DVec3, Face, Mesh};

/// Relative to the size of the scene: files have six digits or more, and a slit that is narrower
/// lets out less than rays tell.
const NARROW: f64 = 1e-5;

/// The faces that have open edges, in the order of the mesh; of each surface only the first.
pub(super) fn open(mesh: &Mesh, edges: &Edges) -> Vec<usize> {
    let tolerance = NARROW * mesh.bounds().extent().max_element();
    let boxes = mesh.faces.iter().map(|face| face.polygon.bounds());
    let boxes: Vec<Aabb> = boxes.map(|bounds| bounds.grown(tolerance)).collect();
    let surfaces = mesh.faces.iter().map(|face| face.surface.index() + 1).max();
    let mut is_named = vec![false; surfaces.unwrap_or(0)];
    let mut open = Vec::new();
    for side in &edges.single {
        let surface = mesh.faces[side.face].surface.index();
        if !is_named[surface] && is_open(mesh, &boxes, *side, tolerance) {
            is_named[surface] = true;
            open.push(side.face);
        }
    }
    open
}

/// Whether other faces leave something of an edge.
fn is_open(mesh: &Mesh, boxes: &[Aabb], side: Side, tolerance: f64) -> bool {
    let corners = mesh.faces[side.face].polygon.corners();
    let edge = [side.corner, (side.corner + 1) % corners.len()].map(|k| corners[k]);
    let around = Aabb::around(edge);
    let near = (0..mesh.faces.len())
        .filter(|&other| other != side.face && boxes[other].is_near(&around, 0.0));
    let held = near.filter_map(|other| held(edge, &mesh.faces[other], tolerance));
    let mut held: Vec<[f64; 2]> = held.collect();
    held.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let slit = tolerance / (edge[1] - edge[0]).length();
    let mut end = 0.0_f64;
    for [from, to] in held {
        if from > end + slit {
            return true;
        }
        end = end.max(to);
    }
    end < 1.0 - slit
}

/// The part of an edge that lies in a face, from 0 at its begin to 1 at its end.
fn held([begin, end]: [DVec3; 2], face: &Face, tolerance: f64) -> Option<[f64; 2]> {
    let corners = face.polygon.corners();
    let height = |point: DVec3| face.normal.dot(point - corners[0]).abs();
    if height(begin) > tolerance || height(end) > tolerance {
        return None;
    }
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (k, &corner) in corners.iter().enumerate() {
        let along = corners[(k + 1) % corners.len()] - corner;
        let inward = face.normal.cross(along).normalize_or_zero();
        let inside = |point: DVec3| inward.dot(point - corner) + tolerance;
        let (a, b) = (inside(begin), inside(end));
        if a < 0.0 && b < 0.0 {
            return None;
        }
        // Where the edge crosses the line along this side of the face.
        let crossing = a / (a - b);
        if a < 0.0 {
            from = from.max(crossing);
        } else if b < 0.0 {
            to = to.min(crossing);
        }
    }
    (from < to).then_some([from, to])
}
