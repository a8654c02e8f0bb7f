//! How fast rays find what they meet, on a few large faces and on a mesh.

#![allow(missing_docs, reason = "criterion's macros write public items")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use radiosity_geometry::{
    DVec3, Divisions, Mesh, Occluders, PolygonMesh, Ray, Shape, Surface, subdivide,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f64::consts::{PI, TAU};

const RAYS: usize = 4096;

/// A closed sphere of nearly `4 n^2` faces, front inside.
fn sphere(n: u32) -> Mesh {
    let mut positions = Vec::new();
    for i in 0..=n {
        for j in 0..2 * n {
            let (polar, azimuth) = (
                PI * f64::from(i) / f64::from(n),
                PI * f64::from(j) / f64::from(n),
            );
            let (s, c) = polar.sin_cos();
            positions.push(DVec3::new(s * azimuth.cos(), s * azimuth.sin(), c));
        }
    }
    let mut faces = Vec::new();
    for i in 0..n {
        for j in 0..2 * n {
            let at = |i: u32, j: u32| i * 2 * n + j % (2 * n);
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if i + 1 < n {
                faces.push(vec![c, b, a]);
            }
            if i > 0 {
                faces.push(vec![d, c, a]);
            }
        }
    }
    let shape = Shape::Mesh(PolygonMesh { positions, faces });
    let surface = Surface {
        shape,
        divisions: None,
    };
    subdivide(&[surface], Divisions::uniform(1)).expect("a sphere is a good mesh")
}

fn rays() -> Vec<Ray> {
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    let mut direction = || {
        let z: f64 = 2.0 * rng.random::<f64>() - 1.0;
        let azimuth = TAU * rng.random::<f64>();
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * azimuth.cos(), r * azimuth.sin(), z)
    };
    (0..RAYS)
        .map(|_| Ray::new(0.5 * direction(), direction()))
        .collect()
}

fn visibility(criterion: &mut Criterion) {
    let rays = rays();
    for n in [3, 134] {
        let mesh = sphere(n);
        let occluders = Occluders::new(&mesh);
        let mut group = criterion.benchmark_group(format!("{} faces", mesh.faces.len()));
        group.throughput(Throughput::Elements(RAYS as u64));
        group.bench_function("closest hit", |b| {
            b.iter(|| {
                let hit = |ray: &&Ray| occluders.closest_hit(ray, 0.0, 9.0, None).is_some();
                rays.iter().filter(hit).count()
            });
        });
        group.bench_function("any hit", |b| {
            b.iter(|| {
                rays.iter()
                    .filter(|ray| occluders.any_hit(ray, 0.0, 9.0, None))
                    .count()
            });
        });
        group.finish();
    }
    let mesh = sphere(134);
    criterion.bench_function("build over 71,000 faces", |b| {
        b.iter(|| Occluders::new(&mesh));
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = visibility
}
criterion_main!(benches);
