//! Meshes of squares, and what estimators make of them.

#![allow(dead_code, reason = "each test file uses some of it")]

use radiosity_form_factors::{Estimator, FormFactors, estimate};
use radiosity_geometry::{DVec3, Divisions, Mesh, Shape, Surface, subdivide};

pub(crate) fn mesh_of(shapes: &[Shape], divisions: u32) -> Mesh {
    let surface = |shape: &Shape| Surface {
        shape: shape.clone(),
        divisions: None,
    };
    let surfaces: Vec<Surface> = shapes.iter().map(surface).collect();
    subdivide(&surfaces, Divisions::uniform(divisions)).unwrap()
}

pub(crate) fn run(mesh: &Mesh, estimator: Estimator) -> FormFactors {
    estimate(mesh, estimator, &|_| ())
}

pub(crate) fn regular(mesh: &Mesh, points: u32) -> FormFactors {
    run(mesh, Estimator::Regular { points })
}

/// A square in the plane `z`, facing up or down.
pub(crate) fn square(center: [f64; 2], edge: f64, z: f64, up: bool) -> Shape {
    let h = 0.5 * edge;
    let corner = DVec3::new(center[0] - h, center[1] - h, z);
    let (x, y) = (edge * DVec3::X, edge * DVec3::Y);
    let (edge_a, edge_b) = if up { (x, y) } else { (y, x) };
    Shape::Parallelogram {
        corner,
        edge_a,
        edge_b,
    }
}

/// Two unit squares that share the edge along y, opened by an angle.
pub(crate) fn hinged(degrees: f64) -> [Shape; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let leaf = DVec3::new(cos, 0.0, sin);
    let parallelogram = |edge_a, edge_b| Shape::Parallelogram {
        corner: DVec3::ZERO,
        edge_a,
        edge_b,
    };
    [
        parallelogram(DVec3::X, DVec3::Y),
        parallelogram(DVec3::Y, leaf),
    ]
}
