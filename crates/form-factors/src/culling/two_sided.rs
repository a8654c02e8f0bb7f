//! Which walls are made of two faces in one place, each the reverse of the other.

use radiosity_geometry::{DVec3, Face, MergedFaces, Mesh};
use std::collections::HashMap;

/// Cells that faces are looked up in are so many times as large as the rounding of coordinates.
const CELL: f64 = 1000.0;

/// Of each wall, whether every face of it has a reverse: a face with the same corners, up to
/// `tolerance`, that faces the other way.
pub(crate) fn have_reverse(mesh: &Mesh, walls: &MergedFaces, tolerance: f64) -> Vec<bool> {
    let mut places: HashMap<[i64; 3], Vec<&Face>> = HashMap::new();
    for face in &mesh.faces {
        let cell = cell_of(middle(face), tolerance);
        places.entry(cell).or_default().push(face);
    }
    let mut all = vec![true; walls.polygons.len()];
    for (face, wall) in mesh.faces.iter().zip(&walls.of_face) {
        let around = (0..8).map(|corner| {
            let side = |axis: i32| f64::from(2 * (corner >> axis & 1) - 1);
            cell_of(
                middle(face) + tolerance * DVec3::new(side(0), side(1), side(2)),
                tolerance,
            )
        });
        let mut near = around.filter_map(|cell| places.get(&cell)).flatten();
        all[wall.index()] &= near.any(|other| is_reverse(face, other, tolerance));
    }
    all
}

fn middle(face: &Face) -> DVec3 {
    let corners = face.polygon.corners();
    corners.iter().sum::<DVec3>() / corners.len() as f64
}

fn cell_of(point: DVec3, tolerance: f64) -> [i64; 3] {
    (point / (CELL * tolerance))
        .to_array()
        .map(|x| x.floor() as i64)
}

fn is_reverse(face: &Face, other: &Face, tolerance: f64) -> bool {
    let [corners, others] = [face, other].map(|face| face.polygon.corners());
    let is_shared = |&corner: &DVec3| {
        let mut others = others.iter();
        others.any(|other| (*other - corner).abs().max_element() <= tolerance)
    };
    face.normal.dot(other.normal) < 0.0
        && corners.len() == others.len()
        && corners.iter().all(is_shared)
}
