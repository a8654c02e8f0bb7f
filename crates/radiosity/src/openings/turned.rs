//! Faces that face the other way than those beside them.
//!
//! Faces that hang together by edges of two faces each can be parted into two sides, those that
//! face one way and those that face the other. Where both are there, those of the smaller area are
//! the fault, most likely; of sides of equal area either may be.

use super::edges::Edges;
use radiosity_geometry::Mesh;

/// Areas that differ by less than this share are equal up to rounding.
const EQUAL: f64 = 1e-9;

/// Faces at fault, in the order of the mesh.
#[derive(Debug, Default)]
pub(super) struct Turned {
    /// They face the other way than the larger part of what they hang together with.
    pub(super) fewer: Vec<usize>,
    /// They and as large a part of what they hang together with face different ways.
    pub(super) either: Vec<usize>,
}

/// A face beside another.
struct Beside {
    face: usize,
    agrees: bool,
}

impl Turned {
    pub(super) fn of(mesh: &Mesh, edges: &Edges) -> Turned {
        let mut beside: Vec<Vec<Beside>> = mesh.faces.iter().map(|_| Vec::new()).collect();
        for pair in &edges.double {
            let [a, b] = pair.faces;
            for (from, face) in [(a, b), (b, a)] {
                let agrees = pair.agree;
                beside[from].push(Beside { face, agrees });
            }
        }
        let mut turned = Turned::default();
        let mut is_met = vec![false; mesh.faces.len()];
        for first in 0..mesh.faces.len() {
            if !is_met[first] {
                turned.add(mesh, sides(first, &beside, &mut is_met));
            }
        }
        turned.fewer.sort_unstable();
        turned.either.sort_unstable();
        turned
    }

    /// Adds what is at fault of two sides.
    fn add(&mut self, mesh: &Mesh, [mut a, mut b]: [Vec<usize>; 2]) {
        let area = |side: &[usize]| -> f64 {
            let faces = side.iter().map(|&face| &mesh.faces[face]);
            faces.map(|face| face.polygon.area()).sum()
        };
        let areas = [area(&a), area(&b)];
        if a.is_empty() || b.is_empty() {
            return;
        }
        if (areas[0] - areas[1]).abs() <= EQUAL * (areas[0] + areas[1]) {
            self.either.append(&mut a);
            self.either.append(&mut b);
        } else if areas[0] < areas[1] {
            self.fewer.append(&mut a);
        } else {
            self.fewer.append(&mut b);
        }
    }
}

/// All that a face hangs together with: what faces the same way as it does, and what does not.
fn sides(first: usize, beside: &[Vec<Beside>], is_met: &mut [bool]) -> [Vec<usize>; 2] {
    let mut sides = [Vec::new(), Vec::new()];
    let mut waiting = vec![(first, 0)];
    is_met[first] = true;
    while let Some((face, side)) = waiting.pop() {
        sides[side].push(face);
        for other in &beside[face] {
            if !is_met[other.face] {
                is_met[other.face] = true;
                let side = if other.agrees { side } else { 1 - side };
                waiting.push((other.face, side));
            }
        }
    }
    sides
}
