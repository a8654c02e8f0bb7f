//! A whole solution, against one product with the matrix.

#![allow(missing_docs, reason = "criterion's macros write public items")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use radiosity_matrix::{SymmetricMatrix, packed_len};
use radiosity_solver::{Params, System, solve};

fn solutions(criterion: &mut Criterion) {
    for size in [1728, 6912] {
        let row_sum_one = 1.0 / (size * (size - 1)) as f32;
        let exchange = SymmetricMatrix::new(size, vec![row_sum_one; packed_len(size)])
            .expect("one value per pair");
        let system = System {
            exchange: &exchange,
            areas: &vec![1.0; size],
            emission: &vec![[1.0, 0.5, 0.25]; size],
            reflectance: &vec![[0.5, 0.7, 0.9]; size],
        };
        let mut group = criterion.benchmark_group(format!("{size} patches"));
        group.throughput(Throughput::Bytes(4 * packed_len(size) as u64));
        let product = system.emission.to_vec();
        group.bench_function("product", |b| b.iter(|| system.irradiance(&product)));
        group.bench_function("solve to 1e-6", |b| {
            b.iter(|| solve(&system, &Params::default(), &mut |_| ()));
        });
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = solutions
}
criterion_main!(benches);
