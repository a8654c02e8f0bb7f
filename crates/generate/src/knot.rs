//! The trefoil knot of `scenes/knot.toml`.
//!
//! The centre line is `(sin t + 2 sin 2t, cos t - 2 cos 2t, -sin 3t)`; its curvature never
//! vanishes, so the Frenet frame turns smoothly and closes by itself.

use std::fmt::Write;

const SEGMENTS: u32 = 110;
const SIDES: u32 = 14;
const RADIUS: f64 = 0.5;

type Vector = [f64; 3];

/// The knot as an OBJ file of triangles.
pub fn obj() -> String {
    let mut text = String::from(
        "# A tube along a trefoil knot, made by `cargo xtask generate knot`\no knot\n",
    );
    for segment in 0..SEGMENTS {
        let t = angle(segment, SEGMENTS);
        let (center, normal, binormal) = frame(t);
        for side in 0..SIDES {
            let (sin, cos) = angle(side, SIDES).sin_cos();
            let [x, y, z]: Vector =
                std::array::from_fn(|k| center[k] + RADIUS * (cos * normal[k] + sin * binormal[k]));
            writeln!(text, "v {x:.6} {y:.6} {z:.6}").expect("strings take all text");
        }
    }
    let vertex = |segment: u32, side: u32| 1 + segment % SEGMENTS * SIDES + side % SIDES;
    for segment in 0..SEGMENTS {
        for side in 0..SIDES {
            let [a, b] = [vertex(segment, side), vertex(segment, side + 1)];
            let [c, d] = [vertex(segment + 1, side + 1), vertex(segment + 1, side)];
            writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}").expect("strings take all text");
        }
    }
    text
}

fn angle(step: u32, steps: u32) -> f64 {
    std::f64::consts::TAU * f64::from(step) / f64::from(steps)
}

/// The centre line at `t` with its principal normal and binormal.
fn frame(t: f64) -> (Vector, Vector, Vector) {
    let ([s1, c1], [s2, c2], [s3, c3]) = (pair(t), pair(2.0 * t), pair(3.0 * t));
    let center = [s1 + 2.0 * s2, c1 - 2.0 * c2, -s3];
    let velocity = [c1 + 4.0 * c2, -s1 + 4.0 * s2, -3.0 * c3];
    let acceleration = [-s1 - 8.0 * s2, -c1 + 8.0 * c2, 9.0 * s3];
    let binormal = normalized(cross(velocity, acceleration));
    let normal = normalized(cross(binormal, velocity));
    (center, normal, binormal)
}

fn pair(t: f64) -> [f64; 2] {
    [t.sin(), t.cos()]
}

fn cross(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| {
        let (l, m) = ((k + 1) % 3, (k + 2) % 3);
        a[l] * b[m] - a[m] * b[l]
    })
}

fn normalized(a: Vector) -> Vector {
    let length = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    a.map(|x| x / length)
}
