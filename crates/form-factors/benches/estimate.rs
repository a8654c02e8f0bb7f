//! The estimators on one room, per pair of patches.

#![allow(missing_docs, reason = "criterion's macros write public items")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use radiosity_form_factors::{Estimator, estimate};
use radiosity_geometry::{DVec3, Divisions, Mesh, Shape, Surface, subdivide};

/// A closed room with a screen across half of it.
fn room() -> Mesh {
    let parallelogram = |corner: [f64; 3], edge_a: [f64; 3], edge_b: [f64; 3]| Surface {
        shape: Shape::Parallelogram {
            corner: DVec3::from(corner),
            edge_a: DVec3::from(edge_a),
            edge_b: DVec3::from(edge_b),
        },
        divisions: None,
    };
    let surfaces = [
        parallelogram([0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 2.0, 0.0]),
        parallelogram([0.0, 0.0, 4.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]),
        parallelogram([0.0, 2.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 4.0]),
        parallelogram([0.0, 0.0, 4.0], [0.0, 0.0, -4.0], [0.0, 2.0, 0.0]),
        parallelogram([3.0, 0.0, 0.0], [0.0, 0.0, 4.0], [0.0, 2.0, 0.0]),
        parallelogram([3.0, 0.0, 4.0], [-3.0, 0.0, 0.0], [0.0, 2.0, 0.0]),
        parallelogram([1.0, 0.0, 2.1], [1.5, 0.0, 0.0], [0.0, 1.2, 0.0]),
    ];
    subdivide(&surfaces, Divisions::uniform(6)).expect("the room is well-formed")
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
        group.bench_function(name, |b| b.iter(|| estimate(&mesh, estimator, &|_| ())));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = estimators
}
criterion_main!(benches);
