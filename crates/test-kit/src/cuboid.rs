//! The faces of cuboids.

use radiosity_geometry::{DVec3, PolygonMesh};

/// The corners of its faces by number: bit 0 is x, bit 1 is y, bit 2 is z.
const FACES: [[usize; 4]; 6] = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
];

/// The faces of a cuboid along the axes, seen from outside: below, above, and around. Change the
/// corners to turn it.
pub fn cuboid(low: impl Into<DVec3>, high: impl Into<DVec3>) -> [[DVec3; 4]; 6] {
    let corners = corners(low.into(), high.into());
    FACES.map(|face| face.map(|corner| corners[corner]))
}

/// The same as one surface, whose faces share corners.
pub fn cuboid_mesh(low: impl Into<DVec3>, high: impl Into<DVec3>) -> PolygonMesh {
    let face = |corners: [usize; 4]| corners.map(|corner| corner as u32).to_vec();
    PolygonMesh {
        positions: corners(low.into(), high.into()).to_vec(),
        faces: FACES.map(face).to_vec(),
    }
}

fn corners(low: DVec3, high: DVec3) -> [DVec3; 8] {
    let ends = [low, high];
    std::array::from_fn(|k| {
        let [x, y, z] = [k & 1, k >> 1 & 1, k >> 2];
        DVec3::new(ends[x].x, ends[y].y, ends[z].z)
    })
}

/// The same faces, seen from the other side: a room instead of a box.
pub fn inside_out<const COUNT: usize>(faces: [[DVec3; 4]; COUNT]) -> [[DVec3; 4]; COUNT] {
    faces.map(|[a, b, c, d]| [d, c, b, a])
}
