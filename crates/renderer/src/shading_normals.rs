//! Normals of smooth meshes, for light at points: facets show no edges.
//!
//! A vertex has the mean of the normals of its faces, weighted by their angles there, as far as
//! they differ by less than the crease angle; between vertices normals are interpolated (Phong,
//! "Illumination for Computer Generated Pictures", CACM 18, 1975).
//!
//! At grazing angles that alone fails: light from above the interpolated horizon may come from
//! below the plane of the facet, and the mesh itself blocks it, facet by facet. So points are
//! lifted to the smooth surface that the facets stand for. With corners `c_i`, their normals `n_i`
//! and the weights `w_i` of a point `p = sum_i w_i c_i`,
//!
//! ```text
//! p' = p + sum_i w_i max(0, (c_i - p) . n_i) n_i
//! ```
//!
//! is the mean of where the tangent planes at the corners are, on the convex side alone (Hanika,
//! "Hacking the Shadow Terminator", in Ray Tracing Gems II, 2021). It is continuous across edges,
//! and the planes of the facets around are below it.

use crate::weld::{groups, weld};
use radiosity_geometry::{DVec2, DVec3, Face, FaceId, Mesh};

/// The normals of all faces.
pub(crate) struct ShadingNormals<'a> {
    mesh: &'a Mesh,
    /// For each face, unit normals at its corners if it is not flat.
    of_faces: Vec<Option<[DVec3; 4]>>,
}

/// A face of a smooth mesh.
#[derive(Clone, Copy)]
pub(crate) struct Smooth<'a> {
    face: &'a Face,
    normals: &'a [DVec3; 4],
}

/// Normals that differ by less are one.
const SAME: f64 = 1e-9;
/// The least cosine between a normal and that of the face: steeper ones, by crease angles of more
/// than 90 degrees, would turn away from what they shade.
const STEEPEST: f64 = 0.1;

impl<'a> ShadingNormals<'a> {
    /// Of meshes alone: surfaces of one face are flat.
    pub(crate) fn new(mesh: &'a Mesh, crease_angle: f64) -> ShadingNormals<'a> {
        let smallest_cosine = crease_angle.to_radians().cos();
        let together = |a: usize, b: usize| {
            let (a, b) = (&mesh.faces[a], &mesh.faces[b]);
            a.surface == b.surface && a.normal.dot(b.normal) > smallest_cosine
        };
        let mut normals: Vec<[DVec3; 4]> = mesh.faces.iter().map(|f| [f.normal; 4]).collect();
        let polygons = mesh.faces.iter().enumerate();
        let polygons = polygons.map(|(face, of_mesh)| (face, of_mesh.polygon.corners()));
        let vertices = weld(mesh, polygons);
        for group in vertices.iter().flat_map(|vertex| groups(vertex, together)) {
            let normal_of = |face: usize| mesh.faces[face].normal;
            let weighted = group
                .iter()
                .map(|corner| f64::from(corner.angle) * normal_of(corner.owner));
            let mean = weighted.sum::<DVec3>().try_normalize();
            for corner in &group {
                normals[corner.owner][corner.index] = mean
                    .filter(|mean| mean.dot(normal_of(corner.owner)) > STEEPEST)
                    .unwrap_or(normal_of(corner.owner));
            }
        }
        let not_flat = |(face, normals): (&Face, [DVec3; 4])| {
            let count = face.polygon.corners().len();
            let is_flat = |normal: &DVec3| normal.distance(face.normal) < SAME;
            (!normals[..count].iter().all(is_flat)).then_some(normals)
        };
        ShadingNormals {
            mesh,
            of_faces: mesh.faces.iter().zip(normals).map(not_flat).collect(),
        }
    }

    /// What a face is shaded by, if it is not flat.
    pub(crate) fn of(&self, face: FaceId) -> Option<Smooth<'_>> {
        let normals = self.of_faces[face.index()].as_ref()?;
        let face = &self.mesh.faces[face.index()];
        Some(Smooth { face, normals })
    }
}

impl Smooth<'_> {
    /// The point on the smooth surface that a point of the face stands for, and the normal there.
    pub(crate) fn at(&self, on_face: DVec2, point: DVec3) -> (DVec3, DVec3) {
        let (s, t) = (on_face.x, on_face.y);
        let weights = match self.face.polygon.is_triangle() {
            true => [1.0 - s - t, s, t, 0.0],
            false => [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t],
        };
        let corners = self.face.polygon.padded_corners();
        let (mut normal, mut lift) = (DVec3::ZERO, DVec3::ZERO);
        for ((weight, &corner), &own) in weights.into_iter().zip(corners).zip(self.normals) {
            normal += weight * own;
            lift += weight * (corner - point).dot(own).max(0.0) * own;
        }
        (
            point + lift,
            normal.try_normalize().unwrap_or(self.face.normal),
        )
    }

    /// The normals that all normals of the face are means of, but for their lengths.
    pub(crate) fn normals(&self) -> &[DVec3] {
        &self.normals[..self.face.polygon.corners().len()]
    }

    /// How far points are lifted at most.
    pub(crate) fn most_lift(&self) -> f64 {
        let corners = self.face.polygon.corners();
        let from = |normal: &DVec3, foot: &DVec3| {
            let heights = corners.iter().map(|corner| (*foot - *corner).dot(*normal));
            heights.fold(0.0, f64::max)
        };
        let lifts = self.normals().iter().zip(corners);
        lifts
            .map(|(normal, foot)| from(normal, foot))
            .fold(0.0, f64::max)
    }
}
