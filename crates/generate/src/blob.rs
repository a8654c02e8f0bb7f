//! A dented ball in a box: a few patches, and many triangles that stand in their way.

use crate::vs3::{Point, Scene, cells};
use std::f64::consts::{PI, TAU};

/// Patches along each edge of the box, which reaches from -2 to 2.
const CELLS: u32 = 18;

/// The text of the scene, with about so many triangles.
pub fn vs3(triangles: u32) -> Result<String, String> {
    if !(8..=4_000_000).contains(&triangles) {
        return Err(format!(
            "a ball of {triangles} triangles: choose 8 to 4,000,000"
        ));
    }
    let mut scene = Scene::default();
    for wall in walls() {
        for cell in cells(wall, CELLS, CELLS) {
            scene.add('S', &cell, "0 0 0.9 wall");
        }
    }
    // 4 n (n - 1) triangles: those at the poles are one each.
    let rows = (0.5 + (0.25 + f64::from(triangles) / 4.0).sqrt())
        .round()
        .max(2.0) as u32;
    for row in 0..rows {
        for column in 0..2 * rows {
            let at = |i: u32, j: u32| {
                point(
                    f64::from(row + i) / f64::from(rows),
                    f64::from(column + j) / f64::from(2 * rows),
                )
            };
            let [a, b, c, d] = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
            if row + 1 < rows {
                scene.add('O', &[a, b, c], "0 0 1 blob");
            }
            if row > 0 {
                scene.add('O', &[a, c, d], "0 0 1 blob");
            }
        }
    }
    Ok(scene.text("a dented ball in a box", false))
}

/// Three corners of each wall, which face inwards.
fn walls() -> [[Point; 3]; 6] {
    let corner = |x: f64, y: f64, z: f64| [2.0 * x, 2.0 * y, 2.0 * z];
    [
        [
            corner(-1.0, -1.0, -1.0),
            corner(1.0, -1.0, -1.0),
            corner(-1.0, 1.0, -1.0),
        ],
        [
            corner(-1.0, -1.0, 1.0),
            corner(-1.0, 1.0, 1.0),
            corner(1.0, -1.0, 1.0),
        ],
        [
            corner(-1.0, -1.0, -1.0),
            corner(-1.0, 1.0, -1.0),
            corner(-1.0, -1.0, 1.0),
        ],
        [
            corner(1.0, -1.0, -1.0),
            corner(1.0, -1.0, 1.0),
            corner(1.0, 1.0, -1.0),
        ],
        [
            corner(-1.0, -1.0, -1.0),
            corner(-1.0, -1.0, 1.0),
            corner(1.0, -1.0, -1.0),
        ],
        [
            corner(-1.0, 1.0, -1.0),
            corner(1.0, 1.0, -1.0),
            corner(-1.0, 1.0, 1.0),
        ],
    ]
}

/// On the ball, by shares of the way from pole to pole and around.
fn point(polar: f64, azimuth: f64) -> Point {
    let (sin, cos) = (PI * polar).sin_cos();
    // The last column is the first again, to the bit; so are all points of a pole.
    let (across, along) = (TAU * azimuth.fract()).sin_cos();
    let sin = if polar.fract() == 0.0 { 0.0 } else { sin };
    let direction = [sin * along, sin * across, cos];
    let [x, y, z] = direction.map(|axis| 5.0 * axis);
    let radius = 1.2 + 0.15 * (x.sin() * y.cos() + y.sin() * z.cos() + z.sin() * x.cos());
    direction.map(|axis| radius * axis)
}
