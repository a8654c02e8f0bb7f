//! A pass over the stored half for one and four triples of vectors.

#![allow(missing_docs, reason = "criterion's macros write public items")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use radiosity_matrix::{SymmetricMatrix, packed_len};

fn sweeps(criterion: &mut Criterion) {
    for size in [1728, 6912] {
        let values = vec![1.0 / size as f32; packed_len(size)];
        let matrix = SymmetricMatrix::new(size, values).expect("one value per pair");
        let mut group = criterion.benchmark_group(format!("{size} rows"));
        group.throughput(Throughput::Bytes(4 * packed_len(size) as u64));
        for triples in [1, 4] {
            let mut x = vec![[1.0; 3]; size * triples];
            group.bench_with_input(BenchmarkId::new("sweep", triples), &triples, |b, _| {
                b.iter(|| matrix.sweep(&mut x, triples, &mut |_, _, _| ()));
            });
        }
        let vector = vec![1.0; size];
        group.bench_function("product in double precision", |b| {
            b.iter(|| matrix.product(&vector));
        });
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = sweeps
}
criterion_main!(benches);
