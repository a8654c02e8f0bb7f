//! Grids of quads and triangles: how many walls they make.

use super::*;
use crate::{Divisions, PolygonMesh, Shape, Surface, subdivide};

fn mesh(positions: Vec<DVec3>, faces: Vec<Vec<u32>>) -> Mesh {
    let surface = Surface {
        shape: Shape::Mesh(PolygonMesh { positions, faces }),
        divisions: None,
    };
    subdivide(&[surface], Divisions::uniform(1)).unwrap()
}

/// Squares of a grid, but for those left out, each of one or two faces.
fn grid(a: u32, b: u32, triangles: bool, left_out: &[(u32, u32)]) -> Mesh {
    let turned = |x: f64, y: f64| DVec3::new(0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, 0.1 * x);
    let row = |i: u32| (0..=b).map(move |j| turned(f64::from(i), f64::from(j)));
    let mut faces = Vec::new();
    for (i, j) in (0..a).flat_map(|i| (0..b).map(move |j| (i, j))) {
        let at = |i: u32, j: u32| i * (b + 1) + j;
        let [p, q, r, s] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        if left_out.contains(&(i, j)) {
            continue;
        }
        if triangles {
            faces.extend([vec![p, q, r], vec![p, r, s]]);
        } else {
            faces.push(vec![p, q, r, s]);
        }
    }
    mesh((0..=a).flat_map(row).collect(), faces)
}

fn check(mesh: &Mesh, expected: usize) {
    let walls = MergedFaces::new(mesh);
    assert_eq!(walls.polygons.len(), expected);
    let area: f64 = walls.polygons.iter().map(Polygon::area).sum();
    assert!((area - mesh.total_area()).abs() < 1e-12 * area);
    for (face, wall) in mesh.faces.iter().zip(&walls.of_face) {
        let wall = &walls.polygons[wall.index()];
        assert!(wall.normal().dot(face.normal) > 1.0 - 1e-12);
        let (normal, centroid) = (wall.normal(), face.polygon.centroid());
        let inside = |[a, b]: [DVec3; 2]| normal.cross(b - a).dot(centroid - a) > 0.0;
        assert!(edges(wall).all(inside));
    }
}

#[test]
fn grids_become_one() {
    check(&grid(5, 7, false, &[]), 1);
    check(&grid(4, 3, true, &[]), 1);
}

#[test]
fn holes_stay_open() {
    check(&grid(3, 3, false, &[(1, 1)]), 4);
}

#[test]
fn folds_and_other_fronts_stay_apart() {
    let p = DVec3::new;
    let positions = vec![
        p(0.0, 0.0, 0.0),
        p(1.0, 0.0, 0.0),
        p(1.0, 1.0, 0.0),
        p(0.0, 1.0, 0.0),
        p(2.0, 0.0, 0.001),
        p(2.0, 1.0, 0.001),
    ];
    let folded = vec![vec![0, 1, 2, 3], vec![1, 4, 5, 2]];
    check(&mesh(positions.clone(), folded), 2);
    let two_sided = vec![vec![0, 1, 2, 3], vec![3, 2, 1, 0]];
    check(&mesh(positions, two_sided), 2);
}
