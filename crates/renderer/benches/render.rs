//! Both pictures of a small room, by interpolant: cells of rectangles, vertices of triangles.

#![allow(missing_docs, reason = "criterion's macros write public items")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use radiosity_geometry::{Camera, DVec3, Divisions, Mesh, Shape, Surface, subdivide};
use radiosity_renderer::{Fields, ImageParams, Renderer, Shading};

const BOTH: [Shading; 2] = [Shading::Constant, Shading::Smooth];

/// The inside of a box, as rectangles or as triangles.
fn room(triangles: bool) -> Mesh {
    let walls: [[[f64; 3]; 4]; 5] = [
        [
            [0.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
            [3.0, 2.0, 0.0],
            [0.0, 2.0, 0.0],
        ],
        [
            [0.0, 0.0, 4.0],
            [3.0, 0.0, 4.0],
            [3.0, 0.0, 0.0],
            [0.0, 0.0, 0.0],
        ],
        [
            [0.0, 2.0, 0.0],
            [3.0, 2.0, 0.0],
            [3.0, 2.0, 4.0],
            [0.0, 2.0, 4.0],
        ],
        [
            [0.0, 0.0, 4.0],
            [0.0, 0.0, 0.0],
            [0.0, 2.0, 0.0],
            [0.0, 2.0, 4.0],
        ],
        [
            [3.0, 0.0, 0.0],
            [3.0, 0.0, 4.0],
            [3.0, 2.0, 4.0],
            [3.0, 2.0, 0.0],
        ],
    ];
    let shapes = walls.iter().flat_map(|wall| {
        let [a, b, c, d] = wall.map(DVec3::from);
        if triangles {
            vec![Shape::Triangle([a, b, c]), Shape::Triangle([c, d, a])]
        } else {
            vec![Shape::Quad([a, b, c, d])]
        }
    });
    let surface = |shape| Surface {
        shape,
        divisions: None,
    };
    let surfaces: Vec<Surface> = shapes.map(surface).collect();
    subdivide(&surfaces, Divisions::uniform(12)).expect("the room is well-formed")
}

fn pictures(criterion: &mut Criterion) {
    let position = DVec3::new(1.5, 1.0, 7.0);
    let camera = Camera::new(position, DVec3::NEG_Z, DVec3::Y, 35.0, 0.0).expect("it can look");
    let params = ImageParams {
        width: 160,
        height: 120,
        ..ImageParams::default()
    };
    let mut group = criterion.benchmark_group("samples");
    group.throughput(Throughput::Elements(160 * 120 * 16));
    for (name, triangles) in [("rectangles", false), ("triangles", true)] {
        let mesh = room(triangles);
        let value = |k: usize| [0.1 + (k % 7) as f32, 1.0, 0.5];
        let radiosity: Vec<[f32; 3]> = (0..mesh.patches.len()).map(value).collect();
        let same = vec![[0.5; 3]; radiosity.len()];
        let fields = Fields {
            sources: &same,
            emission: &same,
            reflectance: &same,
            shown: &radiosity,
            indirect: &same,
            direct: &same,
            direct_gain: &same,
            gathered_gain: &same,
            visible: &vec![1.0; radiosity.len()],
        };
        group.bench_function(name, |b| {
            b.iter(|| {
                Renderer::new(&mesh, &fields, &ImageParams::default(), &BOTH)
                    .render(&camera, &params)
            });
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = pictures
}
criterion_main!(benches);
