//! Shapes, in few words.

use radiosity_geometry::{DVec3, Shape};

/// Where the front of a horizontal shape looks: up is towards larger z.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    /// Towards larger z.
    Up,
    /// Towards smaller z.
    Down,
}

/// A parallelogram.
pub fn parallelogram(
    corner: impl Into<DVec3>,
    edge_a: impl Into<DVec3>,
    edge_b: impl Into<DVec3>,
) -> Shape {
    Shape::Parallelogram {
        corner: corner.into(),
        edge_a: edge_a.into(),
        edge_b: edge_b.into(),
    }
}

/// A quad, counter-clockwise seen from its front.
pub fn quad(corners: [[f64; 3]; 4]) -> Shape {
    Shape::Quad(corners.map(DVec3::from))
}

/// A triangle or a quad, counter-clockwise seen from its front.
pub fn polygon(corners: &[DVec3]) -> Shape {
    match *corners {
        [a, b, c] => Shape::Triangle([a, b, c]),
        [a, b, c, d] => Shape::Quad([a, b, c, d]),
        _ => panic!("{} corners: give three or four", corners.len()),
    }
}

/// A square in the plane `z`, its edges along x and y.
pub fn square(center: [f64; 2], edge: f64, z: f64, facing: Facing) -> Shape {
    let half = 0.5 * edge;
    let corner = [center[0] - half, center[1] - half, z];
    let (x, y) = (edge * DVec3::X, edge * DVec3::Y);
    match facing {
        Facing::Up => parallelogram(corner, x, y),
        Facing::Down => parallelogram(corner, y, x),
    }
}

/// Two unit squares that share the edge along y, their fronts an angle apart.
pub fn hinged(degrees: f64) -> [Shape; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [
        parallelogram(DVec3::ZERO, DVec3::X, DVec3::Y),
        parallelogram(DVec3::ZERO, DVec3::Y, [cos, 0.0, sin]),
    ]
}

/// A wall of two faces in one place: a quad, and its reverse that begins at another corner.
pub fn two_sided([a, b, c, d]: [DVec3; 4]) -> [Shape; 2] {
    [Shape::Quad([a, b, c, d]), Shape::Quad([c, b, a, d])]
}
