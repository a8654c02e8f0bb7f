//! Meshes of shapes.

use radiosity_geometry::{Divisions, Mesh, Shape, Surface, subdivide};

/// A surface that is cut as the mesh says.
pub fn surface(shape: Shape) -> Surface {
    shape.into()
}

/// A surface of each shape.
pub fn surfaces(shapes: impl IntoIterator<Item = Shape>) -> Vec<Surface> {
    shapes.into_iter().map(surface).collect()
}

/// A mesh with one patch a face.
pub fn mesh_of(shapes: impl IntoIterator<Item = Shape>) -> Mesh {
    cut(shapes, 1)
}

/// A mesh with so many patches along each edge of shapes other than meshes.
pub fn cut(shapes: impl IntoIterator<Item = Shape>, divisions: u32) -> Mesh {
    subdivide(&surfaces(shapes), Divisions::uniform(divisions))
        .unwrap_or_else(|error| panic!("{error}"))
}
