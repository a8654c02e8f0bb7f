//! The edges of a mesh, and the faces at each.

use radiosity_geometry::{DVec3, Mesh};
use std::collections::HashMap;

/// An edge of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub(super) face: usize,
    /// The corner that it leaves; it leads to the next.
    pub(super) corner: usize,
    /// Whether it leaves the lesser of its ends: of two faces that face the same way, one's does.
    is_forward: bool,
}

/// Two faces with an edge that no other has.
#[derive(Clone, Copy, Debug)]
pub(super) struct Neighbours {
    pub(super) faces: [usize; 2],
    /// Whether both face the same way there.
    pub(super) agree: bool,
}

/// Sorted by the faces, so that what is made of them does not depend on chance.
pub(super) struct Edges {
    /// Those of a single face.
    pub(super) single: Vec<Side>,
    /// Those of two.
    pub(super) double: Vec<Neighbours>,
}

impl Edges {
    pub(super) fn of(mesh: &Mesh) -> Edges {
        let mut sides: HashMap<[[u64; 3]; 2], Vec<Side>> = HashMap::new();
        // What only blocks bounds no space, and faces neither way.
        let faces = mesh.faces.iter().enumerate();
        for (index, face) in faces.filter(|(_, face)| !face.is_bare()) {
            let corners = face.polygon.corners();
            for (corner, &from) in corners.iter().enumerate() {
                let ends = [from, corners[(corner + 1) % corners.len()]].map(bits);
                let is_forward = ends[0] < ends[1];
                let edge = if is_forward { ends } else { [ends[1], ends[0]] };
                sides.entry(edge).or_default().push(Side {
                    face: index,
                    corner,
                    is_forward,
                });
            }
        }
        let mut edges = Edges {
            single: Vec::new(),
            double: Vec::new(),
        };
        for sides in sides.into_values() {
            match sides[..] {
                [side] => edges.single.push(side),
                [a, b] => edges.double.push(Neighbours {
                    faces: [a.face, b.face],
                    agree: a.is_forward != b.is_forward,
                }),
                _ => {}
            }
        }
        edges.single.sort_by_key(|side| (side.face, side.corner));
        edges.double.sort_by_key(|pair| (pair.faces, pair.agree));
        edges
    }
}

fn bits(point: DVec3) -> [u64; 3] {
    // Adding zero makes one zero of both.
    (point + 0.0).to_array().map(f64::to_bits)
}
