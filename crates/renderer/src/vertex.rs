//! Smooth interpolation on triangles and meshes: values at vertices, shared by all patches that
//! meet there and belong together.
//!
//! A vertex has the average of its patches' values, weighted by their angles there (Thuermer &
//! Wuethrich, "Computing Vertex Normals from Polygonal Facets", 1998). Inside a patch the
//! vertices' values are interpolated linearly (bilinearly on quads), and a bubble, zero on the
//! border, lifts the centre to the patch's own value. So the interpolant is continuous across
//! all edges between patches that belong together, and passes through every patch's value.
//!
//! Two patches belong together at a vertex if they have equal emission and reflectance and
//! their normals differ by less than the crease angle, directly or by way of others there.

use crate::interpolate::Fields;
use crate::{Rgb, add_scaled};
use radiosity_geometry::{DVec2, DVec3, Mesh, Polygon};
use std::collections::HashMap;

/// Values at the corners of patches.
pub(crate) struct VertexValues {
    /// For each patch, its three or four corners' values; the last of a triangle twice.
    corners: Vec<[Rgb; 4]>,
}

/// Positions closer than this, relative to the scene, are one vertex: what the digits of mesh
/// files and the rounding of subdivision leave.
const RELATIVE_WELD_DISTANCE: f64 = 1e-7;

/// A patch at a vertex.
#[derive(Clone, Copy)]
struct Corner {
    patch: usize,
    index: usize,
    angle: f32,
}

impl VertexValues {
    pub(crate) fn new(mesh: &Mesh, fields: &Fields<'_>, crease_angle: f64) -> VertexValues {
        let mut corners: Vec<[Rgb; 4]> = fields.radiosity.iter().map(|&b| [b; 4]).collect();
        let smallest_cosine = crease_angle.to_radians().cos();
        for vertex in weld(mesh) {
            for group in groups(mesh, fields, smallest_cosine, &vertex) {
                let value = average(fields, &group);
                for corner in group {
                    corners[corner.patch][corner.index] = value;
                }
            }
        }
        for (values, patch) in corners.iter_mut().zip(&mesh.patches) {
            if patch.polygon.is_triangle() {
                values[3] = values[2];
            }
        }
        VertexValues { corners }
    }

    /// The value at a point of a patch, given by the patch's own coordinates.
    pub(crate) fn at(&self, polygon: &Polygon, patch: usize, at: DVec2, own: Rgb) -> Rgb {
        let corners = &self.corners[patch];
        let (s, t) = (at.x as f32, at.y as f32);
        let (weights, center, bubble) = if polygon.is_triangle() {
            let r = 1.0 - s - t;
            ([r, s, t, 0.0], [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0], 27.0 * r * s * t)
        } else {
            let (p, q) = (1.0 - s, 1.0 - t);
            ([p * q, s * q, s * t, p * t], [0.25; 4], 16.0 * p * q * s * t)
        };
        let mut value = [0.0; 3];
        let mut at_center = [0.0; 3];
        for k in 0..4 {
            add_scaled(&mut value, weights[k], corners[k]);
            add_scaled(&mut at_center, center[k], corners[k]);
        }
        std::array::from_fn(|c| value[c] + bubble * (own[c] - at_center[c]))
    }
}

/// The corners of all patches, by the vertex they share.
fn weld(mesh: &Mesh) -> Vec<Vec<Corner>> {
    let coordinates = mesh.faces.iter().flat_map(|f| f.polygon.corners());
    let largest = coordinates.fold(0.0, |max: f64, p| max.max(p.abs().max_element()));
    let mut vertices = Vertices {
        distance: RELATIVE_WELD_DISTANCE * largest,
        cells: HashMap::new(),
        positions: Vec::new(),
    };
    let mut corners: Vec<Vec<Corner>> = Vec::new();
    for (patch, p) in mesh.patches.iter().enumerate() {
        let points = p.polygon.corners();
        for (index, &point) in points.iter().enumerate() {
            let vertex = vertices.find_or_add(point);
            corners.resize_with(vertices.positions.len(), Vec::new);
            let angle = angle_at(points, index) as f32;
            corners[vertex].push(Corner { patch, index, angle });
        }
    }
    corners
}

fn angle_at(corners: &[DVec3], index: usize) -> f64 {
    let n = corners.len();
    let here = corners[index];
    let [next, previous] = [corners[(index + 1) % n], corners[(index + n - 1) % n]];
    (next - here).angle_between(previous - here)
}

/// Positions in a hash grid whose cells are four times as wide as the distance that welds.
struct Vertices {
    distance: f64,
    cells: HashMap<[i64; 3], Vec<usize>>,
    positions: Vec<DVec3>,
}

impl Vertices {
    fn find_or_add(&mut self, point: DVec3) -> usize {
        let (low, high) = (self.cell(point - self.distance), self.cell(point + self.distance));
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    let there = self.cells.get(&[x, y, z]).into_iter().flatten();
                    let is_near =
                        |&&k: &&usize| self.positions[k].distance(point) <= self.distance;
                    if let Some(&found) = there.clone().find(is_near) {
                        return found;
                    }
                }
            }
        }
        let cell = self.cell(point);
        self.cells.entry(cell).or_default().push(self.positions.len());
        self.positions.push(point);
        self.positions.len() - 1
    }

    fn cell(&self, point: DVec3) -> [i64; 3] {
        (point / (4.0 * self.distance)).floor().to_array().map(|x| x as i64)
    }
}

/// The corners at one vertex, split into those that belong together.
fn groups(
    mesh: &Mesh,
    fields: &Fields<'_>,
    smallest_cosine: f64,
    vertex: &[Corner],
) -> Vec<Vec<Corner>> {
    let together = |a: &Corner, b: &Corner| {
        let (a, b) = (a.patch, b.patch);
        fields.reflectance[a] == fields.reflectance[b]
            && fields.emission[a] == fields.emission[b]
            && mesh.patches[a].normal.dot(mesh.patches[b].normal) > smallest_cosine
    };
    let mut groups: Vec<Vec<Corner>> = Vec::new();
    for corner in vertex {
        let touches = |group: &mut Vec<Corner>| group.iter().any(|other| together(corner, other));
        let mut merged: Vec<Corner> = groups.extract_if(.., touches).flatten().collect();
        merged.push(*corner);
        groups.push(merged);
    }
    groups
}

fn average(fields: &Fields<'_>, group: &[Corner]) -> Rgb {
    let total: f32 = group.iter().map(|corner| corner.angle).sum();
    let mut sum = [0.0; 3];
    for corner in group {
        add_scaled(&mut sum, corner.angle / total, fields.radiosity[corner.patch]);
    }
    sum
}
