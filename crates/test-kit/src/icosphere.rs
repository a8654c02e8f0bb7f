//! Spheres of triangles.

use radiosity_geometry::{DVec3, PolygonMesh};

/// A closed sphere of radius 1 with `20 * 4^levels` triangles, front outside.
pub fn icosphere(levels: u32) -> PolygonMesh {
    let g = (1.0 + 5f64.sqrt()) / 2.0;
    let mut positions: Vec<DVec3> = Vec::new();
    for (a, b) in [(1.0, g), (-1.0, g), (1.0, -g), (-1.0, -g)] {
        positions.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]].map(DVec3::from));
    }
    let mut faces: Vec<Vec<u32>> = Vec::new();
    for a in 0..12u32 {
        for b in 0..12 {
            for c in 0..12 {
                let [p, q, r] = [a, b, c].map(|i| positions[i as usize]);
                let adjacent = [(p, q), (q, r), (r, p)]
                    .iter()
                    .all(|(x, y)| (x.distance(*y) - 2.0).abs() < 1e-9);
                let outward = (q - p).cross(r - p).dot(p) > 0.0;
                if a < b && a < c && adjacent && outward {
                    faces.push(vec![a, b, c]);
                }
            }
        }
    }
    for position in &mut positions {
        *position = position.normalize();
    }
    for _ in 0..levels {
        (positions, faces) = refined(positions, &faces);
    }
    PolygonMesh { positions, faces }
}

fn refined(mut positions: Vec<DVec3>, faces: &[Vec<u32>]) -> (Vec<DVec3>, Vec<Vec<u32>>) {
    let mut middles = std::collections::HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let sum = positions[a as usize] + positions[b as usize];
            positions.push(sum.normalize());
            positions.len() as u32 - 1
        })
    };
    let mut finer = Vec::new();
    for face in faces {
        let [a, b, c] = [face[0], face[1], face[2]];
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        finer.extend([
            vec![a, ab, ca],
            vec![b, bc, ab],
            vec![c, ca, bc],
            vec![ab, bc, ca],
        ]);
    }
    (positions, finer)
}
