//! Whole solutions by each method, and lights recombined.

#![allow(missing_docs, reason = "criterion's macros write public items")]

use criterion::{Criterion, criterion_group, criterion_main};
use radiosity_matrix::{DenseExchange, SymmetricMatrix, packed_len};
use radiosity_solver::{Params, System, solve, superpose};

fn solutions(criterion: &mut Criterion) {
    for size in [1728, 6912] {
        let row_sum_one = 1.0 / (size * (size - 1)) as f32;
        let matrix = SymmetricMatrix::new(size, vec![row_sum_one; packed_len(size)])
            .expect("one value per pair");
        let mut light = vec![[0.0; 3]; size];
        light[size / 2] = [1.0, 0.5, 0.25];
        let system = System {
            exchange: &DenseExchange::new(matrix, vec![1.0; size]),
            reflectance: &vec![[0.5, 0.7, 0.9]; size],
            lights: &[light],
        };
        let mut group = criterion.benchmark_group(format!("{size} patches"));
        for (name, params) in Params::default().by_each_method() {
            group.bench_function(name, |b| {
                b.iter(|| solve(&system, &params));
            });
        }
        group.finish();
    }
}

fn relighting(criterion: &mut Criterion) {
    let lights = vec![vec![[1.0, 0.5, 0.25]; 10_000]; 4];
    let dimming = [[0.1, 0.2, 0.3]; 4];
    criterion.bench_function("superpose, 10,000 patches and 4 lights", |b| {
        b.iter(|| superpose(&lights, &dimming));
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = solutions, relighting
}
criterion_main!(benches);
