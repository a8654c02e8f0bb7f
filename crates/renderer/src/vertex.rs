//! Smooth interpolation on triangles and meshes: values at vertices, shared by all patches that
//! meet there and belong together, and linear (bilinear on quads) between them. Continuous
//! across all edges between patches that belong together, also where neighbouring faces are cut
//! into different numbers of patches ([`crate::hanging`]); only vertices in the middle of
//! another face's edge, a fault of the mesh, leave a seam.
//!
//! A vertex first has the average of its patches' values, weighted by their angles there
//! (Thuermer & Wuethrich, "Computing Vertex Normals from Polygonal Facets", 1998). That blurs:
//! the mean of a patch's vertices is no longer the patch's value. What is missing is averaged in
//! the same way and added back, [`SHARPENING`] times (Van Cittert's iteration, 1931), but never
//! beyond the values of the patches that meet at the vertex. Patches that cannot be seen do not
//! count.
//!
//! Two patches belong together at a vertex if they have equal emission and reflectance and
//! their normals differ by less than the crease angle, directly or by way of others there.

use crate::fields::Fields;
use crate::hanging::{Hanging, hanging_vertices};
use crate::hidden_patches::is_visible;
use crate::weld::{Corner, groups, weld};
use crate::{Rgb, add_scaled};
use radiosity_geometry::{DVec2, Face, FaceId, Mesh, Polygon};
use radiosity_simd::Simd;
use std::ops::{Mul, Sub};

/// Values at the corners of patches.
pub(crate) struct VertexValues {
    values: Vec<Rgb>,
    /// For each patch, the vertices at its three or four corners; a triangle leaves the last
    /// unused.
    corners: Vec<[u32; 4]>,
}

/// Rounds of sharpening. Each one restores more of the contrast that averaging loses, and more
/// of the noise of single patches.
const SHARPENING: usize = 3;

impl VertexValues {
    /// Of all patches but those of the faces to leave out.
    pub(crate) fn new(
        mesh: &Mesh,
        (fields, of_patches): (&Fields<'_>, &[Rgb]),
        crease_angle: f64,
        is_left_out: &dyn Fn(FaceId) -> bool,
    ) -> VertexValues {
        let smallest_cosine = crease_angle.to_radians().cos();
        let faces = (0..mesh.faces.len() as u32).map(FaceId);
        let faces = faces.filter(|&face| !is_left_out(face));
        let faces: Vec<&Face> = faces.map(|face| &mesh.faces[face.index()]).collect();
        let patches: Vec<usize> = faces.iter().flat_map(|face| face.patches()).collect();
        let together = |a: usize, b: usize| {
            fields.reflectance[a] == fields.reflectance[b]
                && fields.emission[a] == fields.emission[b]
                && mesh.patches[a].normal.dot(mesh.patches[b].normal) > smallest_cosine
        };
        let polygons = patches.iter();
        let polygons = polygons.map(|&patch| (patch, mesh.patches[patch].polygon.corners()));
        let vertices: Vec<Vec<Corner>> = weld(mesh, polygons)
            .iter()
            .flat_map(|vertex| groups(vertex, together))
            .map(|vertex| without_hidden(fields, vertex))
            .collect();
        let mut corners = vec![[0; 4]; mesh.patches.len()];
        for (id, vertex) in vertices.iter().enumerate() {
            for corner in vertex {
                corners[corner.owner][corner.index] = id as u32;
            }
        }
        let hanging = hanging_vertices(&faces, &corners);
        let averages = vertices.iter().map(|v| average(v, of_patches));
        let mut result = VertexValues {
            values: averages.collect(),
            corners,
        };
        result.tie(&hanging);
        for _ in 0..SHARPENING {
            result.sharpen(mesh, of_patches, (&vertices, &patches));
            result.tie(&hanging);
        }
        result
    }

    /// Puts hanging vertices on the line between their ends.
    fn tie(&mut self, hanging: &[Hanging]) {
        for &Hanging { vertex, ends, t } in hanging {
            let [a, b] = ends.map(|end| self.values[end as usize]);
            self.values[vertex as usize] = std::array::from_fn(|c| (1.0 - t) * a[c] + t * b[c]);
        }
    }

    fn sharpen(
        &mut self,
        mesh: &Mesh,
        of_patches: &[Rgb],
        (vertices, patches): (&[Vec<Corner>], &[usize]),
    ) {
        let missing_of = |patch: usize| -> Rgb {
            let polygon = &mesh.patches[patch].polygon;
            let center = if polygon.is_triangle() {
                1.0 / 3.0
            } else {
                0.5
            };
            let shown = self.at(polygon, patch, DVec2::splat(center));
            std::array::from_fn(|c| of_patches[patch][c] - shown[c])
        };
        let mut missing = vec![[0.0; 3]; mesh.patches.len()];
        patches
            .iter()
            .for_each(|&patch| missing[patch] = missing_of(patch));
        for (value, vertex) in self.values.iter_mut().zip(vertices) {
            add_scaled(value, 1.0, average(vertex, &missing));
            for (c, channel) in value.iter_mut().enumerate() {
                let around = vertex.iter().filter(|corner| corner.angle > 0.0);
                let around = around.map(|corner| of_patches[corner.owner][c]);
                let (low, high) = around.fold((f32::MAX, 0.0), |(low, high): (f32, f32), b| {
                    (low.min(b), high.max(b))
                });
                *channel = channel.max(low).min(high);
            }
        }
    }

    /// The value at a point of a patch, given by the patch's own coordinates.
    pub(crate) fn at(&self, polygon: &Polygon, patch: usize, at: DVec2) -> Rgb {
        let weights = weights(at.x as f32, at.y as f32, [0.0, 1.0], polygon.is_triangle());
        let mut value = [0.0; 3];
        for (weight, vertex) in weights.into_iter().zip(self.corners[patch]) {
            add_scaled(&mut value, weight, self.values[vertex as usize]);
        }
        value
    }

    /// The same at eight points.
    #[inline(always)]
    pub(crate) fn at_lanes<S: Simd>(
        &self,
        simd: S,
        patch: usize,
        is_triangle: bool,
        [s, t]: [S::F32; 2],
    ) -> [S::F32; 3] {
        let numbers = [simd.splat_f32(0.0), simd.splat_f32(1.0)];
        let weights = weights(s, t, numbers, is_triangle);
        let mut value = [simd.splat_f32(0.0); 3];
        for (weight, vertex) in weights.iter().zip(&self.corners[patch]) {
            for (value, of_vertex) in value.iter_mut().zip(&self.values[*vertex as usize]) {
                *value = *value + *weight * simd.splat_f32(*of_vertex);
            }
        }
        value
    }
}

/// The weights of the corners at a point; on triangles, the last one has none.
#[inline(always)]
fn weights<F>(s: F, t: F, [zero, one]: [F; 2], is_triangle: bool) -> [F; 4]
where
    F: Copy + Sub<Output = F> + Mul<Output = F>,
{
    let (p, q) = (one - s, one - t);
    if is_triangle {
        [p - t, s, t, zero]
    } else {
        [p * q, s * q, s * t, p * t]
    }
}

/// Has patches that cannot be seen not count, as long as there are others.
fn without_hidden(fields: &Fields<'_>, mut vertex: Vec<Corner>) -> Vec<Corner> {
    let is_hidden = |corner: &Corner| !is_visible(fields, corner.owner);
    if !vertex.iter().all(is_hidden) {
        let hidden = vertex.iter_mut().filter(|corner| is_hidden(corner));
        hidden.for_each(|corner| corner.angle = 0.0);
    }
    vertex
}

/// The average over the patches at a vertex, weighted by angle.
fn average(vertex: &[Corner], of_patches: &[Rgb]) -> Rgb {
    let total: f32 = vertex.iter().map(|corner| corner.angle).sum();
    let mut sum = [0.0; 3];
    for corner in vertex {
        add_scaled(&mut sum, corner.angle / total, of_patches[corner.owner]);
    }
    sum
}
