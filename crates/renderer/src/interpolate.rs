//! The radiosity at any point, from the patches' values.

use crate::bicubic::{Piece, pieces};
use crate::fields::Fields;
use crate::hidden_patches::{continued, is_visible};
use crate::vertex::VertexValues;
use crate::{Rgb, add_scaled};
use radiosity_geometry::{DVec2, Face, FaceId, Grid, Location, Mesh};
use radiosity_simd::{Float, LANES, Simd};

/// Looks up radiosities at points.
pub(crate) struct Interpolant<'a> {
    mesh: &'a Mesh,
    /// For each face, where its pieces begin if it is a grid of its own, and not one of many faces
    /// of a surface.
    grids: Vec<Option<u32>>,
    pieces: Vec<Piece>,
    vertices: VertexValues,
}

/// Eight points of a face, in its coordinates, and which of them matter.
#[derive(Clone, Copy)]
pub(crate) struct SurfacePoints {
    pub(crate) face: FaceId,
    pub(crate) on_face: [[f64; LANES]; 2],
    /// The same in space, if they are needed.
    pub(crate) in_space: [[f64; LANES]; 3],
    pub(crate) lanes: u8,
}

/// Points in a polynomial or a patch each, by its number, and their coordinates there.
pub(crate) struct PatchCoords {
    pub(crate) number: [u32; LANES],
    at: [[f32; LANES]; 2],
}

impl PatchCoords {
    /// Where points of a face lie in its patches.
    #[inline(always)]
    pub(crate) fn in_patches(mesh: &Mesh, points: &SurfacePoints) -> PatchCoords {
        let face = &mesh.faces[points.face.index()];
        let mut coords = PatchCoords {
            number: [0; LANES],
            at: [[0.0; LANES]; 2],
        };
        for lane in 0..LANES {
            let on_face = DVec2::new(points.on_face[0][lane], points.on_face[1][lane]);
            let (cell, on_patch) = face.grid.cell_at(on_face);
            coords.number[lane] = (face.first_patch + cell) as u32;
            coords.at[0][lane] = on_patch.x as f32;
            coords.at[1][lane] = on_patch.y as f32;
        }
        coords
    }

    /// Goes through the numbers: the first of those of the lanes that are left, and the lanes that
    /// have it.
    #[inline(always)]
    pub(crate) fn first_of(&self, rest: u8) -> (usize, u8) {
        let number = self.number[rest.trailing_zeros() as usize];
        let mut same = 0;
        for (lane, other) in self.number.iter().enumerate() {
            same |= u8::from(*other == number) << lane;
        }
        (number as usize, same & rest)
    }
}

impl<'a> Interpolant<'a> {
    /// Interpolates values of patches.
    pub(crate) fn new(
        mesh: &'a Mesh,
        (fields, crease_angle): (&Fields<'_>, f64),
        values: &[Rgb],
    ) -> Interpolant<'a> {
        let surfaces = mesh.faces.iter().map(|face| face.surface.index());
        let mut faces_of = vec![0; surfaces.clone().max().map_or(0, |last| last + 1)];
        surfaces.for_each(|surface| faces_of[surface] += 1);
        let mut all = Vec::new();
        let mut grid = |face: &Face| match face.grid {
            Grid::Quad { a, b } if faces_of[face.surface.index()] == 1 && !face.is_bare() => {
                let first = all.len();
                let of_patches = &values[face.patches()];
                all.extend(pieces((a, b), |i, j| of_patches[(i * b + j) as usize]));
                if let Some(continued) = continued(fields, face, values) {
                    let continued = pieces((a, b), |i, j| continued[(i * b + j) as usize]);
                    let visible = face.patches().map(|patch| is_visible(fields, patch));
                    let pieces = all[first..].iter_mut().zip(continued).zip(visible);
                    pieces
                        .filter(|(_, is_visible)| *is_visible)
                        .for_each(|((piece, continued), _)| *piece = continued);
                }
                Some(first as u32)
            }
            _ => None,
        };
        let grids: Vec<Option<u32>> = mesh.faces.iter().map(&mut grid).collect();
        let is_grid = |face: FaceId| grids[face.index()].is_some();
        Interpolant {
            mesh,
            vertices: VertexValues::new(mesh, (fields, values), crease_angle, &is_grid),
            grids,
            pieces: all,
        }
    }

    /// The smooth value at one place.
    pub(crate) fn at_location(&self, there: &Location) -> Rgb {
        let value = match self.grids[there.face.index()] {
            Some(first) => {
                let cell = there.patch - self.mesh.faces[there.face.index()].first_patch;
                value_of(&self.pieces[first as usize + cell], there.on_patch)
            }
            None => {
                let polygon = &self.mesh.patches[there.patch].polygon;
                self.vertices.at(polygon, there.patch, there.on_patch)
            }
        };
        value.map(|channel| channel.max(0.0))
    }

    /// The smooth values at points; never negative, though a bicubic may be.
    #[inline(always)]
    pub(crate) fn at<S: Simd>(
        &self,
        simd: S,
        (points, coords): (&SurfacePoints, &PatchCoords),
    ) -> [S::F32; 3] {
        let zero = simd.splat_f32(0.0);
        let mut values = [zero; 3];
        let first_patch = self.mesh.faces[points.face.index()].first_patch;
        let first_piece = self.grids[points.face.index()];
        let at = [simd.f32(&coords.at[0]), simd.f32(&coords.at[1])];
        let mut rest = points.lanes;
        while rest != 0 {
            let (number, same) = coords.first_of(rest);
            let found = match first_piece {
                Some(first) => {
                    let piece = &self.pieces[first as usize + number - first_patch];
                    polynomial(simd, piece, at)
                }
                None => {
                    let is_triangle = self.mesh.patches[number].polygon.is_triangle();
                    self.vertices.at_lanes(simd, number, is_triangle, at)
                }
            };
            for c in 0..3 {
                values[c] = found[c].max(zero).select(same, values[c]);
            }
            rest &= !same;
        }
        values
    }
}

/// A piece at one place.
fn value_of(piece: &Piece, at: DVec2) -> Rgb {
    let powers = |x: f32| [1.0, x, x * x, x * x * x];
    let (s, t) = (powers(at.x as f32), powers(at.y as f32));
    let mut value = [0.0; 3];
    for (row, s) in piece.as_chunks::<4>().0.iter().zip(s) {
        for (coefficient, t) in row.iter().zip(t) {
            add_scaled(&mut value, s * t, *coefficient);
        }
    }
    value
}

/// A piece at points, by Horner's rule.
#[inline(always)]
fn polynomial<S: Simd>(simd: S, piece: &Piece, [s, t]: [S::F32; 2]) -> [S::F32; 3] {
    let mut values = [simd.splat_f32(0.0); 3];
    for (c, value) in values.iter_mut().enumerate() {
        for i in (0..4).rev() {
            let mut row = simd.splat_f32(piece[4 * i + 3][c]);
            for j in (0..3).rev() {
                row = row * t + simd.splat_f32(piece[4 * i + j][c]);
            }
            *value = *value * s + row;
        }
    }
    values
}
