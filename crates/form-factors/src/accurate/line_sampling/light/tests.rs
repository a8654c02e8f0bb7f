//! The light on parts of a line, against the kernel.

use super::*;
use crate::accurate::gauss;
use crate::kernel::kernel;
use crate::sampling::patch_sampler::points;
use radiosity_geometry::{Divisions, Mesh, Polygon, Shape, Surface, subdivide};
use radiosity_simd::{InstructionSet, Kernel};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f64::consts::PI;

/// Pieces into which a line is cut.
const PIECES: usize = 16;

/// The light on each piece of a line, which is half as long as the longest of a fan, from the
/// middle of a patch.
struct Pieces<'a>([&'a PatchSampler; 2], &'a Fan);

impl Kernel for Pieces<'_> {
    type Output = [f64; PIECES];

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> [f64; PIECES] {
        let Pieces([from, across], fan) = self;
        let half = simd.splat_f64(0.5);
        let p = points(simd, from, half, half);
        let light = light(simd, (from, &p), (across.normal, fan), half);
        let mut pieces = [0.0; PIECES];
        for (k, piece) in pieces.iter_mut().enumerate() {
            let bound = |k: usize| simd.splat_f64(k as f64 / PIECES as f64);
            let from = bound(k).max(light.bright.from).min(light.bright.to);
            let to = bound(k + 1).min(light.bright.to).max(from);
            *piece = light.over(simd, Interval { from, to }).lanes()[0];
        }
        pieces
    }
}

/// The same by Gauss's rule on the kernel.
fn expected(mesh: &Mesh, fan: &Fan) -> [f64; PIECES] {
    /// Parts of a piece, since the kernel has a kink where it becomes zero.
    const PARTS: usize = 32;
    let [i, j] = [0, 1].map(|k: usize| &mesh.patches[k]);
    let p = i.polygon.bilinear(0.5, 0.5);
    let [start, end] = fan.sides.map(|side| fan.apex + 0.5 * side);
    let area = 0.5 * fan.sides[0].cross(fan.sides[1]).length();
    let at = |s: f64| PI * area * kernel(p, i.normal, start.lerp(end, s), j.normal);
    let width = 1.0 / (PIECES * PARTS) as f64;
    let part = |part: usize| {
        let points = gauss::rule(8).iter();
        points
            .map(|(x, weight)| width * weight * at(width * (part as f64 + x)))
            .sum::<f64>()
    };
    std::array::from_fn(|piece| (piece * PARTS..(piece + 1) * PARTS).map(part).sum())
}

fn vector(rng: &mut Pcg64Mcg, size: f64) -> DVec3 {
    let mut coordinate = || size * (rng.random::<f64>() - 0.5);
    DVec3::new(coordinate(), coordinate(), coordinate())
}

/// Of trapezoids at any angle, near each other and across each other's planes. Gauss's rule misses
/// up to 1e-4 of what little is in front of a point, at the kink.
#[test]
fn light_is_the_integral_of_the_kernel() {
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    let mut count = 0;
    while count < 1000 {
        let surfaces = [vector(&mut rng, 0.1), vector(&mut rng, 4.0)].map(|corner| {
            let (a, b) = (vector(&mut rng, 2.0), vector(&mut rng, 2.0));
            let shorter = (0.1 + 0.9 * rng.random::<f64>()) * a;
            Surface {
                shape: Shape::Quad([corner, corner + a, corner + b + shorter, corner + b]),
                divisions: None,
            }
        });
        let Ok(mesh) = subdivide(&surfaces, Divisions::uniform(1)) else {
            continue;
        };
        let [i, j] = [0, 1].map(|k: usize| &mesh.patches[k]);
        let targets = [i, j].map(|patch| PatchSampler::new(&patch.polygon, patch.normal));
        let fan = &targets[1].fans[count % 2];
        let expected = expected(&mesh, fan);
        let total: f64 = expected.iter().sum();
        let (p, q) = (
            i.polygon.bilinear(0.5, 0.5),
            fan.apex + 0.25 * (fan.sides[0] + fan.sides[1]),
        );
        let squarely = j.area / p.distance_squared(q);
        if total < 1e-3 * squarely || p.distance(q) < 0.3 * j.polygon.longest_edge() {
            continue;
        }
        for set in InstructionSet::available() {
            let found = set.run(Pieces([&targets[0], &targets[1]], fan));
            for (found, expected) in std::iter::zip(found, expected) {
                assert!(
                    (found - expected).abs() < 1e-4 * total,
                    "{found} {expected} {total}"
                );
            }
        }
        count += 1;
    }
}

/// The mean light of places drawn along a line, and the light on all of it.
struct Drawn<'a>([&'a PatchSampler; 2]);

impl Kernel for Drawn<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> [f64; 2] {
        const PLACES: usize = 1000;
        let Drawn([from, across]) = self;
        let half = simd.splat_f64(0.5);
        let p = points(simd, from, half, half);
        let light = light(simd, (from, &p), (across.normal, &across.fans[0]), half);
        let mut sum = 0.0;
        if light.bright.from.less(light.bright.to) == 0 {
            return [0.0; 2];
        }
        for k in 0..PLACES {
            let way = simd.splat_f64((k as f64 + 0.5) / PLACES as f64);
            let (at, drawn) = light.at(simd, way);
            assert!(light.bright.from.less(at) != 0 && at.less(light.bright.to) != 0);
            sum += drawn.lanes()[0] / PLACES as f64;
        }
        [sum, light.over(simd, light.bright).lanes()[0]]
    }
}

/// Places are drawn with the density that their light is divided by, from any point.
#[test]
fn drawn_places_add_up_to_the_line() {
    let mut rng = Pcg64Mcg::seed_from_u64(4);
    for _ in 0..200 {
        let [corner, a, b] = [4.0, 2.0, 2.0].map(|size| vector(&mut rng, size));
        let triangles = [
            [DVec3::ZERO, DVec3::X, DVec3::Y],
            [corner, corner + a, corner + b],
        ];
        let targets = triangles.map(|corners| {
            let polygon = Polygon::triangle(corners);
            PatchSampler::new(&polygon, polygon.normal())
        });
        for set in InstructionSet::available() {
            let [drawn, light] = set.run(Drawn([&targets[0], &targets[1]]));
            assert!(
                (drawn - light).abs() <= 1e-5 * light.abs(),
                "{drawn} {light}"
            );
        }
    }
}
