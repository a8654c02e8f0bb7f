//! The shapes a surface can have.

use crate::polygon::Polygon;
use crate::polygon_mesh::PolygonMesh;
use crate::shape_error::{ShapeError, check_quad, check_triangle};
use glam::DVec3;

/// The geometry of one surface.
#[derive(Clone, Debug)]
pub enum Shape {
    /// The points `corner + u edge_a + v edge_b`, `u` and `v` in [0, 1].
    Parallelogram {
        /// The corner that both edges leave.
        corner: DVec3,
        /// The edge of `u`.
        edge_a: DVec3,
        /// The edge of `v`.
        edge_b: DVec3,
    },
    /// Three corners, counter-clockwise seen from the front.
    Triangle([DVec3; 3]),
    /// A convex planar quadrilateral, counter-clockwise seen from the front.
    Quad([DVec3; 4]),
    /// Many faces that are one surface.
    Mesh(PolygonMesh),
}

impl Shape {
    /// The undivided planar polygons, in input order, each with the index of the input face
    /// that it comes from (a non-planar quad of a mesh gives two triangles).
    pub fn polygons(&self) -> Result<Vec<(u32, Polygon)>, ShapeError> {
        match self {
            Shape::Parallelogram {
                corner,
                edge_a,
                edge_b,
            } => {
                let c = *corner;
                let corners = [c, c + edge_a, c + edge_a + edge_b, c + edge_b];
                check_triangle([corners[0], corners[1], corners[3]])?;
                Ok(vec![(0, Polygon::quad(corners))])
            }
            Shape::Triangle(corners) => {
                check_triangle(*corners)?;
                Ok(vec![(0, Polygon::triangle(*corners))])
            }
            Shape::Quad(corners) => {
                check_quad(corners)?;
                Ok(vec![(0, Polygon::quad(*corners))])
            }
            Shape::Mesh(mesh) => mesh.polygons(),
        }
    }
}
