//! Indexed meshes of faces with three or four corners.

use crate::polygon::Polygon;
use crate::shape_error::{ShapeError, check_quad, check_triangle};
use glam::DVec3;

/// Faces over shared positions, as mesh files give them.
#[derive(Clone, Debug, Default)]
pub struct PolygonMesh {
    /// Corner positions.
    pub positions: Vec<DVec3>,
    /// The corners of each face, three or four indices into `positions`, counter-clockwise
    /// seen from the front.
    pub faces: Vec<Vec<u32>>,
}

impl PolygonMesh {
    /// Of polygons that share no corners.
    pub fn of(polygons: &[Polygon]) -> PolygonMesh {
        let mut mesh = PolygonMesh::default();
        for polygon in polygons {
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(polygon.corners());
            mesh.faces
                .push((first..mesh.positions.len() as u32).collect());
        }
        mesh
    }

    /// The planar convex polygons of all faces, in input order, each with its face's index.
    ///
    /// A planar convex quad stays one polygon; any other quad becomes two triangles along the
    /// diagonal that keeps both of them facing the same way. Where none does, it crosses itself.
    pub(crate) fn polygons(&self) -> Result<Vec<(u32, Polygon)>, ShapeError> {
        if self.faces.is_empty() {
            return Err(ShapeError::Empty);
        }
        let mut polygons = Vec::with_capacity(self.faces.len());
        for (face, indices) in self.faces.iter().enumerate() {
            let corners = self.corners(face, indices)?;
            let mut push = |polygon| polygons.push((face as u32, polygon));
            match *corners {
                [a, b, c] => push(checked_triangle(face, [a, b, c])?),
                [a, b, c, d] if check_quad(&[a, b, c, d]).is_ok() => {
                    push(Polygon::quad([a, b, c, d]));
                }
                [a, b, c, d] => {
                    let halves = split_quad([a, b, c, d]);
                    for half in halves.ok_or(ShapeError::FaceCrossesItself { face })? {
                        push(checked_triangle(face, half)?);
                    }
                }
                _ => unreachable!("corner counts were checked"),
            }
        }
        Ok(polygons)
    }

    fn corners(&self, face: usize, indices: &[u32]) -> Result<Vec<DVec3>, ShapeError> {
        if !matches!(indices.len(), 3 | 4) {
            return Err(ShapeError::CornerCount {
                face,
                corners: indices.len(),
            });
        }
        let position = |&index: &u32| {
            let out_of_range = ShapeError::IndexOutOfRange {
                face,
                index,
                count: self.positions.len(),
            };
            self.positions
                .get(index as usize)
                .copied()
                .ok_or(out_of_range)
        };
        indices.iter().map(position).collect()
    }
}

fn checked_triangle(face: usize, corners: [DVec3; 3]) -> Result<Polygon, ShapeError> {
    match check_triangle(corners) {
        Ok(()) => Ok(Polygon::triangle(corners)),
        Err(ShapeError::NoArea) => Err(ShapeError::FaceWithoutArea { face }),
        Err(other) => Err(other),
    }
}

/// Cuts along the shorter diagonal, or along the one inside the quad where only one is; `None` if
/// neither is.
pub(crate) fn split_quad([a, b, c, d]: [DVec3; 4]) -> Option<[[DVec3; 3]; 2]> {
    let normal = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p);
    let along_ac = normal(a, b, c).dot(normal(a, c, d));
    let along_bd = normal(a, b, d).dot(normal(b, c, d));
    if along_ac < 0.0 && along_bd < 0.0 {
        return None;
    }
    let ac_is_shorter = (c - a).length_squared() <= (d - b).length_squared();
    if along_ac > 0.0 && (ac_is_shorter || along_bd <= 0.0) {
        Some([[a, b, c], [a, c, d]])
    } else {
        Some([[a, b, d], [b, c, d]])
    }
}
