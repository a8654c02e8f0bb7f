//! From a point on a face to the patch it lies in.

use crate::mesh::{Face, FaceId, Grid, Mesh};
use crate::polygon::Polygon;
use glam::{DVec2, DVec3};

/// A point on a face, in the face's own coordinates and in its patch's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Location {
    /// The face.
    pub face: FaceId,
    /// The patch.
    pub patch: usize,
    /// The face's coordinates: `(u, v)` of the bilinear map on quads, barycentric weights of
    /// corners 1 and 2 on triangles; all in [0, 1].
    pub on_face: DVec2,
    /// The same of the patch's own polygon.
    pub on_patch: DVec2,
}

impl Mesh {
    /// Where a point of a face lies. A point slightly off the face is taken to its border.
    pub fn locate(&self, id: FaceId, point: DVec3) -> Location {
        let face = &self.faces[id.index()];
        let on_face = face.coordinates(point);
        let (cell, on_patch) = face.grid.cell_at(on_face);
        Location {
            face: id,
            patch: face.first_patch + cell,
            on_face,
            on_patch,
        }
    }
}

impl Face {
    /// The face's coordinates of a point on it, as [`Location::on_face`] has them.
    pub fn coordinates(&self, point: DVec3) -> DVec2 {
        if self.polygon.is_triangle() {
            inverse_barycentric(&self.polygon, self.normal, point)
        } else {
            inverse_bilinear(&self.polygon, self.normal, point)
        }
    }
}

impl Grid {
    /// The cell at a place on the face, and the place in it. There must be cells.
    pub fn cell_at(self, on_face: DVec2) -> (usize, DVec2) {
        match self {
            Grid::Quad { a, b } => cell_of_quad(on_face, a, b),
            Grid::Triangle { n } => cell_of_triangle(on_face, n),
            Grid::Narrow(grid) => grid.cell_at(on_face),
        }
    }
}

fn cell_of_quad(uv: DVec2, a: u32, b: u32) -> (usize, DVec2) {
    let scaled = uv * DVec2::new(f64::from(a), f64::from(b));
    let i = (scaled.x as u32).min(a - 1);
    let j = (scaled.y as u32).min(b - 1);
    let in_cell = scaled - DVec2::new(f64::from(i), f64::from(j));
    ((i * b + j) as usize, in_cell)
}

fn cell_of_triangle(st: DVec2, n: u32) -> (usize, DVec2) {
    let scaled = st * f64::from(n);
    let i = (scaled.x as u32).min(n - 1);
    let j = (scaled.y as u32).min(n - 1 - i);
    let rest = scaled - DVec2::new(f64::from(i), f64::from(j));
    // Rows before row i hold 2 (n - k) - 1 cells each, k = 0 .. i.
    let upright = i * (2 * n - i) + 2 * j;
    if rest.x + rest.y <= 1.0 || i + j + 1 >= n {
        (upright as usize, rest)
    } else {
        // Corners of the inverted cell: (i+1, j), (i+1, j+1), (i, j+1).
        let in_cell = DVec2::new(rest.x + rest.y - 1.0, 1.0 - rest.x);
        ((upright + 1) as usize, in_cell)
    }
}

/// `(u, v)` in the unit square whose bilinear image is nearest to `point`, for a convex planar
/// quad. The quadratic is solved in the form that stays exact as the quad becomes a
/// parallelogram and the quadratic term vanishes.
pub(crate) fn inverse_bilinear(polygon: &Polygon, normal: DVec3, point: DVec3) -> DVec2 {
    let [c0, c1, c2, c3] = *polygon.padded_corners();
    let (along_u, along_v, twist) = (c1 - c0, c3 - c0, c0 - c1 + c2 - c3);
    let p = point - c0;
    let cross = |x: DVec3, y: DVec3| x.cross(y).dot(normal);
    let quadratic = cross(twist, along_v);
    let linear = cross(along_u, along_v) + cross(p, twist);
    let constant = cross(p, along_u);
    let root = (linear * linear - 4.0 * quadratic * constant)
        .max(0.0)
        .sqrt();
    let v = (-2.0 * constant / (linear + root)).clamp(0.0, 1.0);
    let direction = along_u + v * twist;
    let u = (p - v * along_v).dot(direction) / direction.length_squared();
    DVec2::new(u.clamp(0.0, 1.0), v)
}

pub(crate) fn inverse_barycentric(polygon: &Polygon, normal: DVec3, point: DVec3) -> DVec2 {
    let [c0, c1, c2, _] = *polygon.padded_corners();
    let (e1, e2, p) = (c1 - c0, c2 - c0, point - c0);
    let area = e1.cross(e2).dot(normal);
    let s = (p.cross(e2).dot(normal) / area).clamp(0.0, 1.0);
    let t = (e1.cross(p).dot(normal) / area).clamp(0.0, 1.0 - s);
    DVec2::new(s, t)
}
