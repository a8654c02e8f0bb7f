//! Rows of the accurate estimator know their errors, in hard pairs and in random scenes.

use crate::estimated::{accurate, monte_carlo};
use radiosity_geometry::{DVec3, Mesh, Shape};
use radiosity_test_kit::random::vector;
use radiosity_test_kit::{Mean, mesh_of, parallelogram};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// Corners that are off a common plane by rounding, as in mesh files of six digits: either quad's
/// plane crosses all four edges of the other.
#[test]
fn twisted_quads_are_clipped() {
    let quad = |x: f64, lift: f64| {
        let corner = |dx: f64, y: f64, z: f64| DVec3::new(x + dx, y, z);
        Shape::Quad([
            corner(0.0, 0.0, lift),
            corner(1.0, 0.0, -lift),
            corner(1.0, 1.0, lift),
            corner(0.0, 1.0, -lift),
        ])
    };
    let found = accurate(&mesh_of([quad(0.0, 1e-6), quad(1.5, -1e-6)]), 1e-4);
    assert!((0.0..1e-5).contains(&found.factor(0, 1)));
}

/// A blocker between patches of which little is in front of the other, and between near ones:
/// at any tolerance within six estimated errors (of eight shifts: once in 2,000 times not) of the
/// mean of many random pairs.
#[test]
fn hard_pairs_know_their_errors() {
    let floor = parallelogram([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    // From x = 1.5 a wall looks back at the floor; of it only the top is above.
    let wall = |below: f64, height: f64| {
        parallelogram([1.5, 0.0, -below], [0.0, 0.0, height], [0.0, 1.0, 0.0])
    };
    let above =
        |z: f64, edge: f64| parallelogram([0.0, 0.0, z], [0.0, edge, 0.0], [edge, 0.0, 0.0]);
    let upright = parallelogram([1.2, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.3]);
    let level = |z: f64| parallelogram([0.2, 0.3, z], [0.4, 0.0, 0.0], [0.0, 0.9, 0.0]);
    let cases = [
        [floor.clone(), wall(0.5, 1.0), upright.clone()],
        [floor.clone(), wall(0.93, 1.0), upright],
        [floor.clone(), above(0.8, 1.0), level(0.4)],
        [floor, above(1.0, 2.0), level(0.3)],
    ];
    for shapes in cases {
        let mesh = mesh_of(shapes);
        let Mean {
            value: mean,
            error: noise,
        } = mean_of_random_pairs(&mesh);
        for tolerance in [0.1, 1e-2, 1e-3, 1e-4] {
            let found = accurate(&mesh, tolerance);
            let estimate = found.rows[0].error.unwrap();
            let error = (found.factor(0, 1) - mean).abs();
            println!(
                "{tolerance}: {mean:.6} +- {noise:.1e}: off by {error:.1e}, \
                 estimated {estimate:.1e}"
            );
            assert!(error < 6.0 * estimate + 3.0 * noise);
        }
    }
}

/// The mean factor of the first two patches over runs of plain Monte Carlo.
fn mean_of_random_pairs(mesh: &Mesh) -> Mean {
    Mean::of((0..16).map(|seed| monte_carlo(mesh, [8, 100_000], seed).factor(0, 1)))
}

/// Over random scenes rows know their errors.
#[test]
fn rows_know_their_errors() {
    let (mut within, mut ratios) = (0, Vec::new());
    for seed in 0..200 {
        let mesh = mesh_of(random_scene(seed));
        // Lines have no bias: what is off is what their samples miss.
        let (rough, fine) = (accurate(&mesh, 1e-2), accurate(&mesh, 1e-4));
        for i in 0..mesh.patches.len() {
            let difference = |j: usize| (rough.factor(i, j) - fine.factor(i, j)).abs();
            let error: f64 = (0..mesh.patches.len()).map(difference).sum();
            let estimate = rough.rows[i].error.unwrap();
            if estimate > 0.0 {
                within += usize::from(error <= 2.0 * estimate);
                ratios.push(error / estimate);
            }
        }
    }
    ratios.sort_by(f64::total_cmp);
    let share = within as f64 / ratios.len() as f64;
    let median = ratios[ratios.len() / 2];
    println!(
        "{} rows: {:.1} % within twice their estimate, median ratio {median:.2}",
        ratios.len(),
        100.0 * share
    );
    assert!(share > 0.95, "{share}");
    assert!(median > 0.2, "{median}");
}

/// Triangles and parallelograms in a room's worth of space, none of them special.
fn random_scene(seed: u64) -> Vec<Shape> {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let shape = |k: u32| {
        let [corner, a, b] = [4.0, 3.0, 3.0].map(|size| vector(&mut rng, size));
        if k.is_multiple_of(2) {
            Shape::Triangle([corner, corner + a, corner + b])
        } else {
            parallelogram(corner, a, b)
        }
    };
    (0..16).map(shape).collect()
}
