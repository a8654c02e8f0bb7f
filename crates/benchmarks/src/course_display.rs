//! The pictures of the course's program, as slow as they were: what speeds are compared with.
//!
//! A transcription of the loop structure of that C++ program, not the program: each picture has
//! rays of its own, four for each of 2 x 2 sub-pixels at tent-distributed places, each tried
//! against all rectangles; the patch-constant picture looks up the patch, the smooth one 4 x 4
//! patches around.

use crate::baseline::{Baseline, Ray};
use radiosity::geometry::{DVec3, Grid, Mesh};
use std::f64::consts::PI;

const SIZE: (u32, u32) = (640, 480);
const SUBPIXELS: u32 = 2;
const SAMPLES: u32 = 4;
/// The course's camera.
const POSITION: DVec3 = DVec3::new(50.0, 52.0, 295.6);
const DIRECTION: DVec3 = DVec3::new(0.0, -0.042_612, -1.0);
const FILM_HEIGHT: f64 = 0.5135;
/// Rays begin so far from the camera.
const NEAR: f64 = 130.0;

/// Renders a picture; returns the sum of its pixels, so that none of it is left out.
pub(crate) fn render(mesh: &Mesh, radiosity: &[[f32; 3]], is_smooth: bool) -> f64 {
    let scene = Baseline::new(mesh);
    let direction = DIRECTION.normalize();
    let across = DVec3::X * (FILM_HEIGHT * f64::from(SIZE.0) / f64::from(SIZE.1));
    let up = across.cross(direction).normalize() * FILM_HEIGHT;
    let mut random = Random(0x1234_5678_330e);
    let mut sum = 0.0;
    for y in 0..SIZE.1 {
        for x in 0..SIZE.0 {
            let mut pixel = DVec3::ZERO;
            for part in 0..SUBPIXELS * SUBPIXELS {
                let place = |size: u32, at: u32, sub: u32, shift: f64| {
                    let in_pixel = (f64::from(sub) + 0.5 + shift) / f64::from(SUBPIXELS);
                    (f64::from(at) + in_pixel) / f64::from(size) - 0.5
                };
                for _ in 0..SAMPLES {
                    let (dx, dy) = (random.tent(), random.tent());
                    let towards = direction
                        + place(SIZE.0, x, part % SUBPIXELS, dx) * across
                        + place(SIZE.1, y, part / SUBPIXELS, dy) * up;
                    let ray = Ray {
                        origin: POSITION + NEAR * towards,
                        direction: towards.normalize(),
                    };
                    pixel += seen(mesh, &scene, radiosity, &ray, is_smooth) / PI;
                }
            }
            sum += pixel.element_sum();
        }
    }
    sum
}

/// The radiosity that a ray sees.
fn seen(
    mesh: &Mesh,
    scene: &Baseline<'_>,
    radiosity: &[[f32; 3]],
    ray: &Ray,
    is_smooth: bool,
) -> DVec3 {
    let Some((index, t)) = scene.closest(ray) else {
        return DVec3::ZERO;
    };
    let face = &mesh.faces[index];
    let Grid::Quad { a, b } = face.grid else {
        return DVec3::ZERO;
    };
    let [corner, along_a, _, along_b] = *face.polygon.padded_corners();
    let (edge_a, edge_b) = (along_a - corner, along_b - corner);
    let offset = ray.origin + t * ray.direction - corner;
    let u = f64::from(a) * offset.dot(edge_a) / edge_a.length_squared();
    let v = f64::from(b) * offset.dot(edge_b) / edge_b.length_squared();
    let cell = |i: i64, j: i64| -> DVec3 {
        let i = i.clamp(0, i64::from(a) - 1) as usize;
        let j = j.clamp(0, i64::from(b) - 1) as usize;
        DVec3::from(radiosity[face.first_patch + i * b as usize + j].map(f64::from))
    };
    if !is_smooth {
        return cell(u as i64, v as i64);
    }
    let (i, j) = ((u - 0.5) as i64, (v - 0.5) as i64);
    let (s, t) = (u - 0.5 - i as f64, v - 0.5 - j as f64);
    let rows = [-1, 0, 1, 2].map(|k| {
        let row = [-1, 0, 1, 2].map(|l| cell(i + k, j + l));
        cubic(row, t)
    });
    cubic(rows, s)
}

/// Catmull and Rom's spline between the middle two of four values.
fn cubic([a, b, c, d]: [DVec3; 4], t: f64) -> DVec3 {
    b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))
}

/// The C library's `erand48`.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = (self.0.wrapping_mul(0x0005_deec_e66d).wrapping_add(11)) & ((1 << 48) - 1);
        self.0 as f64 / (1u64 << 48) as f64
    }

    fn tent(&mut self) -> f64 {
        let twice = 2.0 * self.uniform();
        if twice < 1.0 {
            twice.sqrt() - 1.0
        } else {
            1.0 - (2.0 - twice).sqrt()
        }
    }
}
