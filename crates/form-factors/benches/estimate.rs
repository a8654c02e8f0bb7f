//! The estimators per pair of patches: in one room, and where one kernel does nearly all of the
//! work.

#![allow(missing_docs, reason = "criterion's macros write public items")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use radiosity_form_factors::{Estimation, Estimator};
use radiosity_geometry::{Divisions, Mesh, Surface, subdivide};
use radiosity_test_kit::{cut, parallelogram, surface, surfaces};

/// A closed room with a screen across half of it.
fn room() -> Mesh {
    let shapes = [
        parallelogram([0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 2.0, 0.0]),
        parallelogram([0.0, 0.0, 4.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]),
        parallelogram([0.0, 2.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 4.0]),
        parallelogram([0.0, 0.0, 4.0], [0.0, 0.0, -4.0], [0.0, 2.0, 0.0]),
        parallelogram([3.0, 0.0, 0.0], [0.0, 0.0, 4.0], [0.0, 2.0, 0.0]),
        parallelogram([3.0, 0.0, 4.0], [-3.0, 0.0, 0.0], [0.0, 2.0, 0.0]),
        parallelogram([1.0, 0.0, 2.1], [1.5, 0.0, 0.0], [0.0, 1.2, 0.0]),
    ];
    cut(shapes, 6)
}

/// Two squares of 256 patches that face each other, and as many small screens halfway between.
fn squares(distance: f64, screens: usize) -> Mesh {
    let mut surfaces = surfaces([
        parallelogram([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        parallelogram([0.0, 0.0, distance], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
    ]);
    surfaces.extend((0..screens).map(|k| {
        let from = 0.1 + 0.8 * k as f64 / screens as f64;
        let height = 0.5 * distance;
        let screen = parallelogram([from, from, height], [0.1, 0.0, 0.0], [0.02, 0.1, 0.0]);
        Surface {
            divisions: Some(Divisions::Uncut),
            ..surface(screen)
        }
    }));
    subdivide(&surfaces, Divisions::uniform(16)).expect("the squares are well-formed")
}

/// Far away reduced points and Gauss's rules, near by all points and contours, behind screens
/// marks and lines.
fn kernels(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("pairs of two squares");
    group.throughput(Throughput::Elements(256 * 256));
    let modes = [
        ("regular", Estimator::Regular { points: 3 }),
        ("accurate", Estimator::Accurate { tolerance: 0.01 }),
    ];
    let cases = [
        ("far", squares(2.0, 0)),
        ("near", squares(0.1, 0)),
        ("screened", squares(2.0, 3)),
    ];
    for (case, mesh) in &cases {
        for (mode, estimator) in modes {
            let id = BenchmarkId::new(mode, case);
            group.bench_function(id, |b| b.iter(|| Estimation::new(mesh, estimator).run()));
        }
    }
    group.finish();
}

fn estimators(criterion: &mut Criterion) {
    let mesh = room();
    let n = mesh.patches.len() as u64;
    let mut group = criterion.benchmark_group("pairs of patches");
    group.throughput(Throughput::Elements(n * (n - 1) / 2));
    let modes = [
        ("regular 3x3", Estimator::Regular { points: 3 }),
        ("accurate 0.01", Estimator::Accurate { tolerance: 0.01 }),
        (
            "monte-carlo 81",
            Estimator::MonteCarlo {
                points: 3,
                pairs: 81,
                seed: 1,
            },
        ),
    ];
    for (name, estimator) in modes {
        group.bench_function(name, |b| b.iter(|| Estimation::new(&mesh, estimator).run()));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = estimators, kernels
}
criterion_main!(benches);
