//! Vertices that polygons of a mesh share, found by position.

use radiosity_geometry::{DVec3, Mesh};
use std::collections::HashMap;

/// Positions closer than this, relative to the scene's extent, are one vertex: what the digits
/// of mesh files leave.
const RELATIVE_WELD_DISTANCE: f64 = 1e-7;
/// And closer than this, relative to the largest coordinate: the rounding of subdivision.
const COORDINATE_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A polygon at a vertex.
#[derive(Clone, Copy)]
pub(crate) struct Corner {
    /// Whose corner it is: the number that was given with the polygon.
    pub(crate) owner: usize,
    /// Which one.
    pub(crate) index: usize,
    pub(crate) angle: f32,
}

/// The corners of polygons of a mesh, which have a number each, by the vertex they share.
pub(crate) fn weld<'p>(
    mesh: &Mesh,
    polygons: impl Iterator<Item = (usize, &'p [DVec3])>,
) -> Vec<Vec<Corner>> {
    let bounds = mesh.bounds();
    let largest = bounds.min.abs().max(bounds.max.abs()).max_element();
    let mut vertices = Vertices {
        distance: (RELATIVE_WELD_DISTANCE * bounds.extent().max_element())
            .max(COORDINATE_ROUNDING * largest),
        cells: HashMap::new(),
        positions: Vec::new(),
    };
    let mut corners: Vec<Vec<Corner>> = Vec::new();
    for (owner, points) in polygons {
        for (index, &point) in points.iter().enumerate() {
            let vertex = vertices.find_or_add(point);
            corners.resize_with(vertices.positions.len(), Vec::new);
            let angle = angle_at(points, index) as f32;
            corners[vertex].push(Corner {
                owner,
                index,
                angle,
            });
        }
    }
    corners
}

fn angle_at(corners: &[DVec3], index: usize) -> f64 {
    let n = corners.len();
    let here = corners[index];
    let [next, previous] = [corners[(index + 1) % n], corners[(index + n - 1) % n]];
    let (a, b) = (next - here, previous - here);
    // Unlike the inverse cosine, right for slivers too.
    a.cross(b).length().atan2(a.dot(b))
}

/// Cells of the hash grid, in distances that weld: wide enough that a point rarely looks into
/// more than one.
const CELL_WIDTH: f64 = 4.0;

/// Positions in a hash grid.
struct Vertices {
    distance: f64,
    cells: HashMap<[i64; 3], Vec<usize>>,
    positions: Vec<DVec3>,
}

impl Vertices {
    fn find_or_add(&mut self, point: DVec3) -> usize {
        let (low, high) = (
            self.cell(point - self.distance),
            self.cell(point + self.distance),
        );
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    let there = self.cells.get(&[x, y, z]).into_iter().flatten();
                    let is_near = |&&k: &&usize| self.positions[k].distance(point) <= self.distance;
                    if let Some(&found) = there.clone().find(is_near) {
                        return found;
                    }
                }
            }
        }
        let cell = self.cell(point);
        self.cells
            .entry(cell)
            .or_default()
            .push(self.positions.len());
        self.positions.push(point);
        self.positions.len() - 1
    }

    fn cell(&self, point: DVec3) -> [i64; 3] {
        (point / (CELL_WIDTH * self.distance))
            .floor()
            .to_array()
            .map(|x| x as i64)
    }
}

/// The corners at one vertex, split into those that belong together, directly or by way of others.
pub(crate) fn groups(
    vertex: &[Corner],
    together: impl Fn(usize, usize) -> bool,
) -> Vec<Vec<Corner>> {
    let mut groups: Vec<Vec<Corner>> = Vec::new();
    for corner in vertex {
        let touches = |group: &mut Vec<Corner>| {
            group
                .iter()
                .any(|other| together(corner.owner, other.owner))
        };
        let mut merged: Vec<Corner> = groups.extract_if(.., touches).flatten().collect();
        merged.push(*corner);
        groups.push(merged);
    }
    groups
}
