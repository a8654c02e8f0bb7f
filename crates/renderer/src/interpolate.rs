//! The radiosity at any point, from the patches' values.

use crate::Rgb;
use crate::bicubic::bicubic;
use crate::fields::Fields;
use crate::vertex::VertexValues;
use radiosity_geometry::{Grid, Location, Mesh};

/// Degrees between normals below which neighbouring patches are parts of one smooth surface.
pub const DEFAULT_CREASE_ANGLE: f64 = 30.0;

/// Looks up radiosities at points.
pub(crate) struct Interpolant<'a> {
    mesh: &'a Mesh,
    radiosity: &'a [Rgb],
    /// Whether a face is a grid of its own, not one of many faces of a surface.
    is_grid: Vec<bool>,
    vertices: VertexValues,
}

impl<'a> Interpolant<'a> {
    pub(crate) fn new(mesh: &'a Mesh, fields: &Fields<'a>, crease_angle: f64) -> Interpolant<'a> {
        let surfaces = mesh.faces.iter().map(|face| face.surface.index());
        let mut faces_of = vec![0; surfaces.clone().max().map_or(0, |last| last + 1)];
        surfaces.clone().for_each(|surface| faces_of[surface] += 1);
        let is_grid = |face: &radiosity_geometry::Face| {
            matches!(face.grid, Grid::Quad { .. }) && faces_of[face.surface.index()] == 1
        };
        Interpolant {
            mesh,
            radiosity: fields.radiosity,
            is_grid: mesh.faces.iter().map(is_grid).collect(),
            vertices: VertexValues::new(mesh, fields, crease_angle),
        }
    }

    /// The value of the patch.
    pub(crate) fn constant(&self, at: &Location) -> Rgb {
        self.radiosity[at.patch]
    }

    /// The smooth value; never negative, though a bicubic may be.
    pub(crate) fn smooth(&self, at: &Location) -> Rgb {
        let face = &self.mesh.faces[at.face.index()];
        let value = match face.grid {
            Grid::Quad { a, b } if self.is_grid[at.face.index()] => {
                let cell = |i, j| self.radiosity[face.first_patch + (i * b + j) as usize];
                bicubic((at.on_face.x, at.on_face.y), (a, b), cell)
            }
            _ => {
                let polygon = &self.mesh.patches[at.patch].polygon;
                self.vertices.at(polygon, at.patch, at.on_patch)
            }
        };
        value.map(|channel| channel.max(0.0))
    }
}
