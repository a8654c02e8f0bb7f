//! Random pairs of polygons with nothing between them, against adaptive quadrature.
//!
//! The oracle shares nothing with what it judges: Lambert's formula for the factor from a point to
//! a polygon, integrated over triangles that are cut until a rule of degree five agrees with
//! itself.

use crate::estimated::accurate;
use radiosity_geometry::{DVec3, Divisions, subdivide};
use radiosity_test_kit::random::vector;
use radiosity_test_kit::{self as kit, surfaces};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f64::consts::TAU;

type Polygon = Vec<DVec3>;

/// Radon's rule of degree five on a triangle: barycentric coordinates and weights.
const RADON: [(f64, f64, f64); 7] = {
    const A: f64 = 0.470_142_064_105_115_1;
    const B: f64 = 0.101_286_507_323_456_33;
    const OF_A: f64 = 0.132_394_152_788_506_2;
    const OF_B: f64 = 0.125_939_180_544_827_14;
    [
        (1.0 / 3.0, 1.0 / 3.0, 0.225),
        (A, A, OF_A),
        (A, 1.0 - 2.0 * A, OF_A),
        (1.0 - 2.0 * A, A, OF_A),
        (B, B, OF_B),
        (B, 1.0 - 2.0 * B, OF_B),
        (1.0 - 2.0 * B, B, OF_B),
    ]
};

fn normal(polygon: &[DVec3]) -> DVec3 {
    (polygon[1] - polygon[0])
        .cross(polygon[2] - polygon[0])
        .normalize()
}

/// The part of a polygon in front of another's plane.
fn in_front(polygon: &[DVec3], plane: &[DVec3]) -> Polygon {
    let n = normal(plane);
    let height = |p: DVec3| {
        let height = n.dot(p - plane[0]);
        // Corners that the two share are on the plane.
        if height.abs() < 1e-12 { 0.0 } else { height }
    };
    let mut kept = Polygon::new();
    for (k, &a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        if height(a) >= 0.0 {
            kept.push(a);
        }
        if height(a) * height(b) < 0.0 {
            kept.push(a + height(a) / (height(a) - height(b)) * (b - a));
        }
    }
    kept
}

/// The share of the light of a surface element that arrives at a polygon in front of it (Lambert
/// 1760): a sum over edges.
fn from_point(p: DVec3, n: DVec3, polygon: &[DVec3]) -> f64 {
    let edge = |k: usize| {
        let (a, b) = (polygon[k] - p, polygon[(k + 1) % polygon.len()] - p);
        let cross = a.cross(b);
        let length = cross.length();
        if length == 0.0 {
            return 0.0;
        }
        // Seen from the point, the front of the polygon turns clockwise.
        -length.atan2(a.dot(b)) * n.dot(cross) / length
    };
    (0..polygon.len()).map(edge).sum::<f64>() / TAU
}

struct Oracle<'a> {
    normal: DVec3,
    to: &'a [DVec3],
}

impl Oracle<'_> {
    fn rule(&self, [a, b, c]: [DVec3; 3]) -> f64 {
        let area = 0.5 * (b - a).cross(c - a).length();
        let at = |&(u, v, weight): &(f64, f64, f64)| {
            weight * from_point(a + u * (b - a) + v * (c - a), self.normal, self.to)
        };
        area * RADON.iter().map(at).sum::<f64>()
    }

    fn integral(&self, triangle: [DVec3; 3], whole: f64, error: f64, depth: u32) -> f64 {
        let [a, b, c] = triangle;
        let [ab, bc, ca] = [a + b, b + c, c + a].map(|sum| 0.5 * sum);
        let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
        let values = parts.map(|part| self.rule(part));
        let sum: f64 = values.iter().sum();
        // What happens near a short edge shows only where triangles are as short.
        let is_small = depth >= ALWAYS;
        if is_small && (sum - whole).abs() < error || depth == DEEPEST {
            return sum;
        }
        let finer = |k: usize| self.integral(parts[k], values[k], 0.5 * error, depth + 1);
        (0..4).map(finer).sum()
    }
}

/// So often triangles are cut always, and at most.
const ALWAYS: u32 = 5;
const DEEPEST: u32 = 16;

/// `A_i F_ij` to about 1e-8.
fn exact(i: &[DVec3], j: &[DVec3]) -> f64 {
    let (part_i, part_j) = (in_front(i, j), in_front(j, i));
    if part_i.len() < 3 || part_j.len() < 3 {
        return 0.0;
    }
    let oracle = Oracle {
        normal: normal(i),
        to: &part_j,
    };
    let triangles = (1..part_i.len() - 1).map(|k| [part_i[0], part_i[k], part_i[k + 1]]);
    triangles
        .map(|t| oracle.integral(t, oracle.rule(t), 1e-8, 0))
        .sum()
}

/// A triangle or a trapezoid, from a corner and its first edge.
fn polygon(rng: &mut Pcg64Mcg, corner: DVec3, edge: DVec3) -> Polygon {
    let other = vector(rng, 2.0);
    match rng.random() {
        true => vec![corner, corner + edge, corner + other],
        false => {
            let shorter = (0.2 + 0.8 * rng.random::<f64>()) * edge;
            vec![
                corner,
                corner + edge,
                corner + other + shorter,
                corner + other,
            ]
        }
    }
}

/// How the second polygon lies to the first.
const KINDS: [&str; 4] = [
    "apart or across",
    "one corner",
    "an edge",
    "part of an edge",
];

fn pair(rng: &mut Pcg64Mcg, kind: usize) -> [Polygon; 2] {
    let (corner, edge) = (vector(rng, 1.0), vector(rng, 2.0));
    let i = polygon(rng, corner, edge);
    let free = vector(rng, 2.0);
    let j = match kind {
        0 => {
            let corner = vector(rng, 3.0);
            polygon(rng, corner, free)
        }
        1 => polygon(rng, corner, free),
        2 => polygon(rng, corner + edge, -edge),
        _ => {
            let (from, to) = (1.5 * rng.random::<f64>(), rng.random::<f64>() - 0.5);
            polygon(rng, corner + from * edge, (to - from) * edge)
        }
    };
    [i, j]
}

/// No polygon stands between a point of the other and its own points, so factors are unoccluded.
#[test]
fn unoccluded_pairs_are_exact() {
    let mut rng = Pcg64Mcg::seed_from_u64(5);
    for (kind, name) in KINDS.into_iter().enumerate() {
        let (mut count, mut seen, mut worst) = (0, 0, 0.0_f64);
        while count < 150 {
            let [i, j] = pair(&mut rng, kind);
            let pair = surfaces([&i, &j].map(|corners| kit::polygon(corners)));
            let Ok(mesh) = subdivide(&pair, Divisions::uniform(1)) else {
                continue;
            };
            let made = accurate(&mesh, 1e-5);
            let expected = exact(&i, &j);
            let smaller = mesh.patches[0].area.min(mesh.patches[1].area);
            let found = made.factor(0, 1) * mesh.patches[0].area;
            worst = worst.max((found - expected).abs() / smaller.max(0.1));
            count += 1;
            seen += usize::from(expected > 1e-3);
        }
        println!("{name}: {seen} of {count} see each other, worst error {worst:.1e}");
        assert!(seen > 20, "{name}: {seen}");
        assert!(worst < 1e-6, "{name}: {worst}");
    }
}
