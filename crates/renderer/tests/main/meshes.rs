//! Shapes cut into patches.

use crate::square::square;
use radiosity_geometry::{
    DVec3, Divisions, Face, Grid, Mesh, PolygonMesh, Shape, Surface, subdivide,
};

/// A face with its front where the normal of its corners points to.
pub(crate) fn quad(corners: [[f64; 3]; 4]) -> Shape {
    Shape::Quad(corners.map(DVec3::from))
}

/// A square of edge 8 around the origin in the plane z = 0, front towards +z.
pub(crate) fn floor() -> Shape {
    quad([
        [-4.0, -4.0, 0.0],
        [4.0, -4.0, 0.0],
        [4.0, 4.0, 0.0],
        [-4.0, 4.0, 0.0],
    ])
}

/// Each shape is a surface, cut into so many patches along each edge.
pub(crate) fn cut(shapes: Vec<Shape>, divisions: u32) -> Mesh {
    cut_each(shapes.into_iter().map(|shape| (shape, divisions)))
}

/// The same, with divisions for each shape.
pub(crate) fn cut_each(shapes: impl Iterator<Item = (Shape, u32)>) -> Mesh {
    let surface = |(shape, divisions)| Surface {
        shape,
        divisions: Some(Divisions::uniform(divisions)),
    };
    let surfaces: Vec<Surface> = shapes.map(surface).collect();
    subdivide(&surfaces, Divisions::uniform(1)).unwrap()
}

/// A narrow triangle between a quad and wider triangles, in one mesh: rows of quads and triangles.
pub(crate) fn narrow_between_others() -> Mesh {
    let [a, b, c, d] = [0, 1, 2, 3];
    let below = [[-0.1, -0.62], [0.3, -1.1], [-0.5, -0.9]];
    let below = below.map(|[x, y]| DVec3::new(x, y, 0.0));
    let positions = square().into_iter().chain(below).collect();
    let faces = vec![
        vec![a, b, c, d],
        vec![4, b, a],
        vec![4, 5, b],
        vec![4, a, 6],
    ];
    let surface = Surface {
        shape: Shape::Mesh(PolygonMesh { positions, faces }),
        divisions: Some(Divisions::MaxEdge(0.13)),
    };
    subdivide(&[surface], Divisions::uniform(1)).unwrap()
}

/// The patches of the one narrow triangle of a mesh.
pub(crate) fn patches_of_narrow_face(mesh: &Mesh) -> Vec<usize> {
    let is_narrow = |face: &&Face| matches!(face.grid, Grid::Narrow(_));
    let mut narrow = mesh.faces.iter().filter(is_narrow);
    let patches = narrow.next().map(Face::patches).unwrap().collect();
    assert!(narrow.next().is_none());
    patches
}

/// A mesh of `2 n^2` triangles over the unit square, with vertices moved about and raised by at
/// most `bump`.
pub(crate) fn bumpy(n: u32, bump: f64) -> PolygonMesh {
    let mut positions = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            let noise = |k: u32| f64::from((i * 31 + j * 17 + k * 7) % 13) / 13.0 - 0.5;
            let [x, y] = [i, j].map(|k| f64::from(k) / f64::from(n) - 0.5);
            let inside = if i % n == 0 || j % n == 0 {
                0.0
            } else {
                0.4 / f64::from(n)
            };
            positions.push(DVec3::new(
                x + inside * noise(1),
                y + inside * noise(2),
                bump * noise(3),
            ));
        }
    }
    let at = |i: u32, j: u32| i * (n + 1) + j;
    let mut faces = Vec::new();
    for i in 0..n {
        for j in 0..n {
            faces.push(vec![at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            faces.push(vec![at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    PolygonMesh { positions, faces }
}
