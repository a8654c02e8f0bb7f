//! Form factors between two parallel squares, against the closed form. Differences are within its
//! error and the rounding of single precision: `cargo run --release --example view_factors`.

use radiosity::form_factors::{Params, estimate};
use radiosity::geometry::{DVec3, Divisions, MeshError, Shape, Surface, subdivide};
use std::f64::consts::PI;

fn main() -> Result<(), MeshError> {
    let params = Params {
        tolerance: 1e-6,
        ..Params::default()
    };
    println!("distance  closed form    estimated   difference    its error");
    for distance in [0.1, 0.3, 1.0, 3.0, 10.0] {
        // Their fronts face each other.
        let lower = square(DVec3::ZERO, DVec3::X, DVec3::Y);
        let upper = square(distance * DVec3::Z, DVec3::Y, DVec3::X);
        let mesh = subdivide(&[lower, upper], Divisions::uniform(1))?;
        let factors = estimate(&mesh, &params);
        let (expected, found) = (closed_form(distance), factors.factor(0, 1));
        let error = factors.rows[0].error.unwrap_or_default();
        let difference = found - expected;
        println!("{distance:>8} {expected:>12.9} {found:>12.9} {difference:>12.1e} {error:>12.1e}");
    }
    Ok(())
}

fn square(corner: DVec3, a: DVec3, b: DVec3) -> Surface {
    Shape::Quad([corner, corner + a, corner + a + b, corner + b]).into()
}

/// Between squares of side 1: Howell's catalog, C-11.
fn closed_form(distance: f64) -> f64 {
    let x = 1.0 / distance;
    let w = x.hypot(1.0);
    let arcs = 2.0 * x * (w * (x / w).atan() - x.atan());
    2.0 / (PI * x * x) * ((w * w / (1.0 + 2.0 * x * x).sqrt()).ln() + arcs)
}
