//! Plates, squares and needles beside much larger faces, against closed forms.

use super::*;
use radiosity_geometry::Shape;
use radiosity_test_kit::closed_forms::parallel_rectangles;
use radiosity_test_kit::{mesh_of, parallelogram};

/// A parallelogram, or a triangle, as one patch.
fn element(shape: Shape) -> PatchQuadrature {
    PatchQuadrature::new(&mesh_of([shape]).patches[0])
}

fn rectangle(corner: [f64; 3], edge_a: [f64; 3], edge_b: [f64; 3]) -> PatchQuadrature {
    element(parallelogram(corner, edge_a, edge_b))
}

/// `F` of `i` towards `j`, and its error.
fn factor(i: &PatchQuadrature, j: &PatchQuadrature, tolerance: f64) -> [f64; 2] {
    let found = exchange(i, j, tolerance);
    [found.value, found.error].map(|x| x / i.area())
}

fn assert_near([found, error]: [f64; 2], exact: f64, bound: f64) {
    assert!(
        (found - exact).abs() <= error,
        "{found} +- {error}, not {exact}"
    );
    assert!(error <= bound, "{error}");
}

/// A plate of 1 above a ground of any size, looking down: what it does not see of the ground is
/// beyond its edges, by `1 / (pi r^2)` all around (the leading term for a square of half-edge r: 4
/// / (pi r^2) times an integral that is bounded by 1).
#[test]
fn plates_over_a_large_ground_see_nothing_else() {
    for half in [1e2, 1e4, 1e6, 1e8] {
        let ground = rectangle(
            [-half, -half, 0.0],
            [2.0 * half, 0.0, 0.0],
            [0.0, 2.0 * half, 0.0],
        );
        for [x, y, z] in [
            [-0.5, -0.5, 1.0],
            [0.3 * half, -0.7 * half, 0.01],
            [-0.2, 0.3, 1e-3],
        ] {
            let plate = rectangle([x, y, z], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]);
            let [found, error] = factor(&plate, &ground, 1e-12 * half);
            let beyond = 100.0 * (1.0 + z * z) / (half * half);
            assert!(
                (found - 1.0).abs() <= error + beyond,
                "{half} {found} +- {error}"
            );
            assert!(error < 1e-7, "{error}");
        }
    }
}

/// A square of 1 that stands in the middle of an edge of a large floor, at a right angle. Of an
/// infinitely long strip of width w it sees `(1 + w - sqrt(1 + w^2)) / (2 * 1)` (crossed strings);
/// here the strip ends at a distance of w to either side, beyond which it would see less than
/// `2 / w`.
#[test]
fn squares_at_the_edge_of_larger_ones_see_half_of_everything() {
    for size in [1e3, 1e5, 1e7] {
        let small = rectangle([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let floor = rectangle([-size, 0.0, 0.0], [2.0 * size, 0.0, 0.0], [0.0, size, 0.0]);
        let [found, error] = factor(&small, &floor, 1e-12 * size);
        let strip = 0.5 * (1.0 + size - size.hypot(1.0));
        assert!(
            (found - strip).abs() <= error + 2.0 / size,
            "{found} +- {error}, {strip}"
        );
        assert!(error < 1e-7, "{error}");
    }
}

/// Near and far from the origin, the same.
#[test]
fn plates_face_each_other_anywhere() {
    let exact = parallel_rectangles([[0.0, 1.0]; 2], [[0.0, 1.0]; 2], 1.0);
    for away in [0.0, 1e3, 1e6] {
        let low = rectangle([away, away, -away], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let high = rectangle([away, away, 1.0 - away], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]);
        assert_near(factor(&low, &high, 1e-12 * away), exact, 1e-7);
    }
}

/// A needle sees as much of a wall in front of it as a point does, and says how well it knows.
#[test]
fn needles_tell_their_rounding() {
    for width in [1e-3, 1e-6, 1e-9] {
        let needle = element(Shape::Triangle([
            DVec3::new(0.25, 0.5, 0.5),
            DVec3::new(0.75, 0.5, 0.5),
            DVec3::new(0.5, 0.5 + width, 0.5),
        ]));
        let wall = rectangle([0.0, 0.0, 1.5], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]);
        let [found, error] = factor(&needle, &wall, 1e-12);
        // By points along the needle, weighted by its width there.
        let count = 2000;
        let (mut sum, mut weights) = (0.0, 0.0);
        for k in 0..count {
            let along = (f64::from(k) + 0.5) / f64::from(count);
            let weight = 1.0 - (2.0 * along - 1.0).abs();
            let point = DVec3::new(0.25 + 0.5 * along, 0.5 + width * weight / 2.0, 0.5);
            let tiny = rectangle(
                [point.x, point.y, point.z],
                [1e-3, 0.0, 0.0],
                [0.0, 1e-3, 0.0],
            );
            sum += weight * factor(&tiny, &wall, 1e-12)[0];
            weights += weight;
        }
        let exact = sum / weights;
        assert!(
            (found - exact).abs() <= error + 1e-5,
            "{width}: {found} +- {error}, {exact}"
        );
        assert!(error < 1e-3, "{width}: {error}");
    }
}
