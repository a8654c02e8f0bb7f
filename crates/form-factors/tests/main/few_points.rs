//! Far apart, few points stand for all of the regular ones: against the plain sum over all.

use crate::estimated::regular;
use crate::plain::Plain;
use radiosity_geometry::{DVec3, PolygonMesh, Shape};
use radiosity_test_kit::random::{spanned, vector};
use radiosity_test_kit::{mesh_of, parallelogram};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f64::consts::{FRAC_PI_4, SQRT_2};

/// How many radii of their points patches are apart where few begin to stand for all.
const NEAR: f64 = 10.8;
/// The largest difference is that of a plank from a square that it faces squarely, with three
/// points along their edges: in the direction of an edge, the fourth moment of all points is larger
/// by `2/729` edge^4 than that of few, and the fourth derivative of the kernel is `72 / d^4` times
/// the kernel. In units of the radius `r` of the points, edges of `3 r` (one) and `3 / sqrt(2) r`
/// (two) make `(r / d)^4` of the factor, which is `9/2 r^2 / (pi d^2)`. Higher derivatives take
/// away a tenth. More points have larger radii.
const LARGEST: f64 = 9.03e-7;

/// The largest difference of both factors between two shapes.
fn difference(shapes: [Shape; 2], points: u32) -> f64 {
    let mesh = mesh_of(shapes);
    let found = regular(&mesh, points);
    let plain = Plain::new(&mesh, points);
    let error = |(i, j)| (found.factor(i, j) - plain.factor(i, j)).abs();
    [(0, 1), (1, 0)].map(error).into_iter().fold(0.0, f64::max)
}

/// A triangle or a parallelogram within about two units of a point, whose front sees another point.
fn shape(rng: &mut Pcg64Mcg, center: DVec3, seen: DVec3) -> Shape {
    let (a, b) = (vector(rng, 2.0), vector(rng, 2.0));
    let (a, b) = facing(a, b, seen - center);
    spanned(rng, center, a, b)
}

/// Two edges in the order in which the front of what they span faces a direction.
fn facing(a: DVec3, b: DVec3, direction: DVec3) -> (DVec3, DVec3) {
    match a.cross(b).dot(direction) < 0.0 {
        true => (b, a),
        false => (a, b),
    }
}

fn around(center: DVec3, edge_a: DVec3, edge_b: DVec3) -> Shape {
    parallelogram(center - 0.5 * (edge_a + edge_b), edge_a, edge_b)
}

/// A rectangle, as far across as a unit square, in a random direction that faces another.
fn rectangle(rng: &mut Pcg64Mcg, center: DVec3, seen: DVec3) -> Shape {
    let normal = ((seen - center).normalize() + vector(rng, 2.0)).normalize();
    let a = normal.cross(vector(rng, 2.0)).normalize();
    let (sin, cos) = rng.random_range(0.01..FRAC_PI_4).sin_cos();
    let (long, short) = (SQRT_2 * cos * a, SQRT_2 * sin * normal.cross(a));
    let (a, b) = facing(long, short, seen - center);
    around(center, a, b)
}

#[test]
fn few_points_make_what_all_do() {
    let mut rng = Pcg64Mcg::seed_from_u64(5);
    let mut worst: f64 = 0.0;
    for points in [3, 4, 5] {
        let radius = 0.5_f64.sqrt() * (1.0 - 1.0 / f64::from(points));
        for _ in 0..2000 {
            let direction = vector(&mut rng, 2.0).normalize();
            let near = 1.001 * NEAR * radius * direction;
            let rectangles = [DVec3::ZERO, near].map(|at| rectangle(&mut rng, at, near - at));
            worst = worst.max(difference(rectangles, points));
            let far = rng.random_range(5.0..16.0) * direction;
            let shapes = [DVec3::ZERO, far].map(|at| shape(&mut rng, at, far - at));
            worst = worst.max(difference(shapes, points));
        }
    }
    println!("by {worst:.2e} at most");
    assert!(worst < LARGEST, "{worst:.2e}");
}

/// Tiles of small faces hold patches that few points stand for beside some that they do not, and
/// some that are near beside some that are far.
#[test]
fn patches_of_a_tile_go_each_its_own_way() {
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    let groups = [0.0, 7.0].map(|height| {
        let mut group = PolygonMesh::default();
        for k in 0..15 {
            let at = height * DVec3::Z + vector(&mut rng, 2.0) * DVec3::new(3.0, 3.0, 1.0);
            let (a, b) = (vector(&mut rng, 2.0), vector(&mut rng, 2.0));
            let (a, b) = facing(a, b, (3.5 - height) * DVec3::Z);
            let corners = match k % 3 {
                0 => vec![at, at + a, at + b],
                1 => vec![at, at + a, at + a + b, at + b],
                _ => vec![at, at + a, at + 0.5 * a + b, at + b],
            };
            let first = group.positions.len() as u32;
            let last = first + corners.len() as u32;
            group.faces.push((first..last).collect());
            group.positions.extend(corners);
        }
        Shape::Mesh(group)
    });
    let mesh = mesh_of(groups);
    let found = regular(&mesh, 3);
    let plain = Plain::new(&mesh, 3);
    let pairs = (0..30).flat_map(|i| (0..i).map(move |j| (i, j)));
    let errors = pairs.map(|(i, j)| (found.factor(i, j) - plain.factor(i, j)).abs());
    let errors: Vec<f64> = errors.collect();
    let worst = errors.iter().copied().fold(0.0, f64::max);
    println!("tiles: {worst:.2e} at most");
    assert!(worst < LARGEST, "{worst:.2e}");
    let few = errors.iter().filter(|&&error| error > 1e-9).count();
    assert!(few > 10, "{few} differ");
}

/// What is derived above, where it is reached: were all points summed, there would be no
/// difference.
#[test]
fn the_largest_difference_is_reached() {
    let at = 1.001 * NEAR * 2.0_f64.sqrt() / 3.0 * DVec3::Z;
    let plank_and_square = [
        around(DVec3::ZERO, 1.413 * DVec3::X, 0.05 * DVec3::Y),
        around(at, DVec3::Y, DVec3::X),
    ];
    let found = difference(plank_and_square, 3);
    assert!(found > 0.85 * LARGEST && found < LARGEST, "{found:.2e}");
}
