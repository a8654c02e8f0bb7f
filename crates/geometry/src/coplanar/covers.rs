//! Faces that lie on others: in one plane, facing the same way, over the same points.
//!
//! Of two such faces one counts where they overlap: that of the smaller area, as of a lamp on a
//! ceiling, or, where areas are equal, the one that comes later. Areas are those of all of a
//! surface that hangs together in the plane, so that it does not matter how finely the mesh of a
//! ceiling is cut. (View3D has the same rule for subsurfaces, which its input has to name: G.
//! Walton, NISTIR 6925, 2002.)
//!
//! Long because: the candidates, the test and the order of layers are one search.

use crate::bounds::Aabb;
use crate::coplanar::merged_faces::{edges, key};
use crate::coplanar::remainder::{overlap, remainder};
use crate::mesh::{Face, FaceId, Patch};
use crate::polygon::Polygon;
use crate::rays::occluders::plane_tolerance;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::cmp::Reverse;
use std::collections::HashMap;

/// Which faces of a mesh lie on which others.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Covers {
    covered: Vec<Covered>,
    /// Up to this far from a line counts as on it.
    tolerance: f64,
}

/// A face on which others lie.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Covered {
    /// The face.
    pub face: FaceId,
    /// What lies on it.
    pub by: Vec<FaceId>,
    /// How many lie on each other above it, at most.
    layer: u32,
}

/// What is narrower than this, relative to the longest edge of a patch, is rounding.
const SLIVER: f64 = 1e-9;

impl Covers {
    /// Of all faces that have patches.
    pub(crate) fn of(faces: &[Face]) -> Covers {
        let boxes: Vec<Aabb> = faces.iter().map(|face| face.polygon.bounds()).collect();
        let bounds = boxes.iter().copied().fold(Aabb::EMPTY, Aabb::union);
        let tolerance = plane_tolerance(&bounds);
        let pairs = overlapping(faces, &boxes, &bounds, tolerance);
        let mut covers = Covers {
            covered: Vec::new(),
            tolerance,
        };
        if pairs.is_empty() {
            return covers;
        }
        let areas = areas_together(faces, tolerance);
        // From the bottom to the top. Single precision makes areas equal that differ by rounding.
        let rank = |&face: &usize| (Reverse(areas[face].to_bits()), face);
        let mut by: HashMap<usize, Vec<usize>> = HashMap::new();
        for pair in pairs {
            let [below, above] = match rank(&pair[0]) < rank(&pair[1]) {
                true => pair,
                false => [pair[1], pair[0]],
            };
            by.entry(below).or_default().push(above);
        }
        let mut order: Vec<usize> = by.keys().copied().collect();
        order.sort_by_key(rank);
        let mut layers: HashMap<usize, u32> = HashMap::new();
        for &face in order.iter().rev() {
            let above = by[&face].iter().filter_map(|face| layers.get(face));
            layers.insert(face, 1 + above.copied().max().unwrap_or(0));
        }
        order.sort_unstable();
        let id = |face: &usize| FaceId(*face as u32);
        covers.covered = order
            .iter()
            .map(|face| Covered {
                face: id(face),
                by: by[face].iter().map(id).collect(),
                layer: layers[face],
            })
            .collect();
        covers
    }

    /// The faces on which others lie, in the order of the mesh.
    pub fn covered(&self) -> &[Covered] {
        &self.covered
    }

    /// What of a patch no other face lies on, in polygons of three or four corners; `None` where
    /// that is all of it.
    pub fn free_part(&self, faces: &[Face], patch: &Patch) -> Option<Vec<Polygon>> {
        let covered = self.find(patch.face)?;
        let tolerance = self.tolerance.max(SLIVER * patch.polygon.longest_edge());
        let whole = patch.polygon.corners();
        let holes = covered.by.iter();
        let holes = holes.map(|face| faces[face.index()].polygon.corners());
        let holes = holes.filter(|hole| overlap(whole, hole, patch.normal, tolerance));
        let holes: Vec<&[DVec3]> = holes.collect();
        (!holes.is_empty()).then(|| remainder(whole, patch.normal, &holes, tolerance))
    }

    /// The largest of all layers.
    pub(crate) fn layers(&self) -> u32 {
        let layers = self.covered.iter().map(|covered| covered.layer);
        layers.max().unwrap_or(0)
    }

    /// How many faces lie on each other above a face, at most.
    pub(crate) fn layer(&self, face: FaceId) -> u32 {
        self.find(face).map_or(0, |covered| covered.layer)
    }

    fn find(&self, face: FaceId) -> Option<&Covered> {
        let position = self
            .covered
            .binary_search_by_key(&face, |covered| covered.face);
        Some(&self.covered[position.ok()?])
    }
}

/// Planes that are nearly the same, in steps of [`STEPS`]: by normal, and by distance from the
/// origin relative to the size of the scene.
type PlaneCell = [i64; 4];

const STEPS: f64 = 256.0;
/// Planes up to so many steps apart may be the same: what is rounded in small faces of large
/// scenes.
const MARGIN: f64 = 0.01;

/// Pairs of faces in one plane, facing the same way, that overlap.
fn overlapping(faces: &[Face], boxes: &[Aabb], bounds: &Aabb, tolerance: f64) -> Vec<[usize; 2]> {
    let size = bounds.min.abs().max(bounds.max.abs()).max_element();
    let mut cells: HashMap<PlaneCell, Vec<usize>> = HashMap::new();
    for (index, face) in faces.iter().enumerate() {
        if !face.is_bare() {
            for cell in plane_cells(face, size) {
                cells.entry(cell).or_default().push(index);
            }
        }
    }
    let mut pairs = Vec::new();
    for mut cell in cells.into_values().filter(|cell| cell.len() > 1) {
        let axis = sweep_axis(&cell, boxes);
        cell.sort_by(|&a, &b| boxes[a].min[axis].total_cmp(&boxes[b].min[axis]));
        for (k, &i) in cell.iter().enumerate() {
            let reaches = |&&j: &&usize| boxes[j].min[axis] < boxes[i].max[axis];
            let later = cell[k + 1..].iter().take_while(reaches);
            let overlapping = later.filter(|&&j| {
                boxes[i].is_near(&boxes[j], tolerance)
                    && lie_together(&faces[i], &faces[j], tolerance)
            });
            pairs.extend(overlapping.map(|&j| [i.min(j), i.max(j)]));
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// The axis along which boxes reach over the fewest others: where they are shortest, relative to
/// all together.
fn sweep_axis(cell: &[usize], boxes: &[Aabb]) -> usize {
    let around = cell.iter().map(|&face| boxes[face]);
    let extent = around.clone().fold(Aabb::EMPTY, Aabb::union).extent();
    let sum: DVec3 = around.map(|of| of.extent()).sum();
    let share = |axis: &usize| match extent[*axis] {
        0.0 => f64::INFINITY,
        whole => sum[*axis] / whole,
    };
    (0..3)
        .min_by(|a, b| share(a).total_cmp(&share(b)))
        .unwrap_or(0)
}

/// The cells of a plane and of those that may be the same.
fn plane_cells(face: &Face, size: f64) -> Vec<PlaneCell> {
    let distance = face.normal.dot(face.polygon.corners()[0]) / size;
    let mut cells = vec![PlaneCell::default()];
    for (k, x) in face
        .normal
        .to_array()
        .into_iter()
        .chain([distance])
        .enumerate()
    {
        // Steps end far from 0 and 1, where most planes are.
        let at = |x: f64| (x + 0.5).floor() as i64;
        let (low, high) = (at(STEPS * x - MARGIN), at(STEPS * x + MARGIN));
        let ends = if low == high {
            vec![low]
        } else {
            vec![low, high]
        };
        cells = cells
            .iter()
            .flat_map(|cell| {
                ends.iter().map(move |&end| {
                    let mut cell = *cell;
                    cell[k] = end;
                    cell
                })
            })
            .collect();
    }
    cells
}

/// Whether two faces lie in one plane, face the same way, and overlap.
fn lie_together(a: &Face, b: &Face, tolerance: f64) -> bool {
    let (small, large) = if a.polygon.area() < b.polygon.area() {
        (a, b)
    } else {
        (b, a)
    };
    let (corners, on_plane) = (small.polygon.corners(), large.polygon.corners()[0]);
    let is_near = |&c: &DVec3| large.normal.dot(c - on_plane).abs() <= tolerance;
    small.normal.dot(large.normal) > 0.0
        && corners.iter().all(is_near)
        && !are_apart(&small.polygon, &large.polygon, large.normal, tolerance)
        && overlap(corners, large.polygon.corners(), large.normal, tolerance)
}

/// Whether an edge of one polygon parts it from the other: most neighbours are told apart by that.
fn are_apart(a: &Polygon, b: &Polygon, normal: DVec3, tolerance: f64) -> bool {
    let parts = |of: &Polygon, other: &Polygon| {
        edges(of).any(|[start, end]| {
            let inward = normal.cross(end - start).normalize_or_zero();
            let height = |&c: &DVec3| inward.dot(c - start);
            inward != DVec3::ZERO && other.corners().iter().map(height).all(|h| h <= tolerance)
        })
    };
    parts(a, b) || parts(b, a)
}

/// Of each face, the area of all of its surface that it hangs together with in its plane, by edges
/// that faces share, relative to the largest.
fn areas_together(faces: &[Face], tolerance: f64) -> Vec<f32> {
    let mut left_of: HashMap<_, Vec<usize>> = HashMap::new();
    let mut together = Sets((0..faces.len()).collect());
    for (index, face) in faces.iter().enumerate().filter(|(_, face)| !face.is_bare()) {
        for [a, b] in edges(&face.polygon) {
            for &other in left_of.get(&key([b, a])).into_iter().flatten() {
                if continues(face, &faces[other], tolerance) {
                    together.join(index, other);
                }
            }
            left_of.entry(key([a, b])).or_default().push(index);
        }
    }
    let mut sums = vec![0.0; faces.len()];
    for (index, face) in faces.iter().enumerate() {
        sums[together.first(index)] += face.polygon.area();
    }
    let largest = sums.iter().copied().fold(0.0, f64::max);
    let area = |index| (sums[together.first(index)] / largest) as f32;
    (0..faces.len()).map(area).collect()
}

/// Whether a face of the same surface lies in the plane of another and faces the same way.
fn continues(face: &Face, other: &Face, tolerance: f64) -> bool {
    let from = face.polygon.corners()[0];
    let is_near = |&c: &DVec3| face.normal.dot(c - from).abs() <= tolerance;
    face.surface == other.surface
        && face.normal.dot(other.normal) > 0.0
        && other.polygon.corners().iter().all(is_near)
}

/// Sets of numbers that are joined step by step: each has a number before it in its set, or is the
/// first.
struct Sets(Vec<usize>);

impl Sets {
    fn first(&mut self, mut of: usize) -> usize {
        while self.0[of] != of {
            self.0[of] = self.0[self.0[of]];
            of = self.0[of];
        }
        of
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.first(a), self.first(b));
        self.0[a.max(b)] = a.min(b);
    }
}

#[cfg(test)]
mod tests;
