//! Weights of rows, against those of all pairs.

use super::*;
use radiosity_geometry::{DVec3, Divisions, Mesh, Shape, Surface, subdivide};

const TOLERANCE: f64 = 0.01;

/// A room of 4 x 4 x 4 with an octahedron in it.
fn mesh() -> Mesh {
    let surface = |shape, cells| Surface {
        shape,
        divisions: Some(Divisions::uniform(cells)),
    };
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let wall = |axis: usize, side: f64| {
        let (mut a, mut b) = (axes[(axis + 1) % 3], axes[(axis + 2) % 3]);
        if side > 0.0 {
            (a, b) = (b, a);
        }
        let shape = Shape::Parallelogram {
            corner: 2.0 * (side * axes[axis] - a - b),
            edge_a: 4.0 * a,
            edge_b: 4.0 * b,
        };
        surface(shape, 8)
    };
    let walls = (0..6).map(|k| wall(k % 3, if k < 3 { -1.0 } else { 1.0 }));
    let side = |k: usize| {
        let tip = |axis: usize| {
            if k >> axis & 1 == 0 {
                axes[axis]
            } else {
                -axes[axis]
            }
        };
        let [a, mut b, mut c] = [0, 1, 2].map(tip);
        if k.count_ones() % 2 == 1 {
            (b, c) = (c, b);
        }
        surface(Shape::Triangle([a, b, c]), 5)
    };
    let surfaces: Vec<Surface> = walls.chain((0..8).map(side)).collect();
    subdivide(&surfaces, Divisions::uniform(1)).unwrap()
}

/// The parts of the tolerance that the partly hidden pairs of a row have, by patch.
fn parts_of_rows(mesh: &TiledMesh<'_>, accurate: &Accurate) -> Vec<f64> {
    let count = mesh.mesh.patches.len();
    let mut parts = vec![0.0; count];
    for (i, j) in (0..count).flat_map(|i| (0..i).map(move |j| (i, j))) {
        if accurate.is_partly_hidden(mesh, [i, j], &Blockers::Tree) {
            let clear = accurate.near([i, j], mesh).value;
            let ends = [i, j].map(|patch| (patch, accurate.areas[patch]));
            let error = accurate.budget.of_pair(ends, clear);
            for (patch, area) in ends {
                parts[patch] += error / (area * TOLERANCE);
            }
        }
    }
    parts
}

#[test]
fn parts_of_a_row_sum_to_its_tolerance() {
    let mesh = mesh();
    let tiled = TiledMesh::new(&mesh);
    let parts = parts_of_rows(&tiled, &Accurate::new(&tiled, TOLERANCE));
    let most = parts.iter().copied().fold(0.0, f64::max);
    let some: Vec<f64> = parts.into_iter().filter(|part| *part > 0.0).collect();
    let mean = some.iter().sum::<f64>() / some.len() as f64;
    // Weights are estimates. A pair has the smaller part of its two rows: not all of a row's is
    // used.
    assert!(most < 1.1, "{most}");
    assert!(mean > 0.5, "{mean}");
}
