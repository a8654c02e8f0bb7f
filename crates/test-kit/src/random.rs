//! Random vectors and shapes; who calls brings the generator.

use crate::shapes::parallelogram;
use radiosity_geometry::{DVec3, Shape};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

/// Anywhere in a cube of this edge length around the origin.
pub fn vector(rng: &mut Pcg64Mcg, size: f64) -> DVec3 {
    let mut coordinate = || size * (rng.random::<f64>() - 0.5);
    DVec3::new(coordinate(), coordinate(), coordinate())
}

/// A triangle or a parallelogram that two edges span, as likely either.
pub fn spanned(rng: &mut Pcg64Mcg, corner: DVec3, edge_a: DVec3, edge_b: DVec3) -> Shape {
    if rng.random() {
        Shape::Triangle([corner, corner + edge_a, corner + edge_b])
    } else {
        parallelogram(corner, edge_a, edge_b)
    }
}
