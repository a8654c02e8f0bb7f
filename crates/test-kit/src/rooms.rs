//! Random rooms in which things stand, hang and lean near the walls, by kind.

use crate::cuboid::{cuboid, inside_out};
use crate::meshes::mesh_of;
use radiosity_geometry::{DVec3, Mesh, Shape};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// What is in a room besides walls.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A thin plate in the middle.
    Plate,
    /// A screen that stands on the floor near a wall.
    Screen,
    /// Eight slats across a wall, at an angle to it.
    Louvres,
    /// Boards that touch a wall.
    Shelves,
    /// Cabinets that touch walls and floor, and a table on four legs.
    Furniture,
    /// Boxes at any angle, one of them on the floor.
    Boxes,
}

/// All of them.
pub const KINDS: [Kind; 6] = [
    Kind::Plate,
    Kind::Screen,
    Kind::Louvres,
    Kind::Shelves,
    Kind::Furniture,
    Kind::Boxes,
];

/// Numbers of one room.
struct Numbers(Pcg64Mcg);

impl Numbers {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.random::<f64>()
    }
}

/// A room of one patch a wall.
pub fn room(kind: Kind, seed: u64) -> Mesh {
    let mut numbers = Numbers(Pcg64Mcg::seed_from_u64(seed));
    let size = DVec3::new(
        numbers.between(3.0, 6.0),
        numbers.between(3.0, 6.0),
        numbers.between(2.0, 3.5),
    );
    let mut faces = inside_out(cuboid(DVec3::ZERO, size)).to_vec();
    faces.extend(things(kind, size, &mut numbers));
    mesh_of(faces.into_iter().map(Shape::Quad))
}

fn things(kind: Kind, room: DVec3, numbers: &mut Numbers) -> Vec<[DVec3; 4]> {
    let v = DVec3::new;
    match kind {
        Kind::Plate => {
            let turn = numbers.between(0.0, 1.0);
            turned(v(1.0, 1.0, 1.2), v(2.3, 2.1, 1.2001), turn).to_vec()
        }
        Kind::Screen => {
            let (from_wall, top) = (numbers.between(0.05, 0.5), numbers.between(0.8, 1.8));
            let (left, right) = (numbers.between(0.1, 0.8), numbers.between(0.1, 1.0));
            let high = v(room.x - right, from_wall + 0.03, top);
            cuboid(v(left, from_wall, 0.0), high).to_vec()
        }
        Kind::Louvres => (0..8)
            .flat_map(|k| slat(0.3 + 0.2 * f64::from(k), room))
            .collect(),
        Kind::Shelves => (0..4)
            .flat_map(|k| {
                let z = 0.4 + 0.4 * f64::from(k);
                let (left, right) = (numbers.between(0.3, 0.8), numbers.between(1.6, 2.6));
                cuboid(
                    v(0.0, left, z),
                    v(numbers.between(0.2, 0.4), right, z + 0.02),
                )
            })
            .collect(),
        Kind::Furniture => furniture(room, numbers),
        Kind::Boxes => (0..3)
            .flat_map(|k| {
                let (x, y) = (
                    numbers.between(0.8, room.x - 0.8),
                    numbers.between(0.8, room.y - 0.8),
                );
                let z = f64::from(k) * numbers.between(0.0, 0.5);
                let turn = numbers.between(0.0, 1.5);
                turned(v(x - 0.4, y - 0.3, z), v(x + 0.4, y + 0.3, z + 0.8), turn)
            })
            .collect(),
    }
}

/// Both sides of a slat.
fn slat(z: f64, room: DVec3) -> [[DVec3; 4]; 2] {
    let (left, right) = (0.3, room.x - 0.3);
    let across = 0.15 * DVec3::new(0.0, 0.76, 0.65);
    let thick = 0.003 * DVec3::new(0.0, 0.65, -0.76);
    let (a, b) = (DVec3::new(left, 0.1, z), DVec3::new(right, 0.1, z));
    let side = [a, b, b + across, a + across];
    let [a, b, c, d] = side.map(|corner| corner + thick);
    [side, [d, c, b, a]]
}

fn furniture(room: DVec3, numbers: &mut Numbers) -> Vec<[DVec3; 4]> {
    let v = DVec3::new;
    let mut size = |low: f64, high: f64| numbers.between(low, high);
    let cabinet = v(size(0.4, 1.0), size(0.4, 1.0), size(0.6, 1.8));
    let chest = v(size(0.4, 0.9), size(0.4, 1.0), size(0.5, 1.2));
    let table = v(size(1.2, 1.6), size(1.2, 1.6), 0.0);
    let at_wall = v(room.x - chest.x, 1.0, 0.0);
    let top = table + v(0.0, 0.0, 0.7);
    let legs = [(0.0, 0.0), (0.95, 0.0), (0.0, 0.65), (0.95, 0.65)];
    let leg = |(x, y): (f64, f64)| {
        let foot = table + v(x, y, 0.0);
        cuboid(foot, foot + v(0.05, 0.05, 0.7))
    };
    let things = [
        cuboid(DVec3::ZERO, cabinet),
        cuboid(at_wall, at_wall + chest),
        cuboid(top, top + v(1.0, 0.7, 0.03)),
    ];
    [things.as_flattened(), legs.map(leg).as_flattened()].concat()
}

/// The faces of a cuboid, turned around its upright axis.
fn turned(low: DVec3, high: DVec3, turn: f64) -> [[DVec3; 4]; 6] {
    let center = 0.5 * (low + high);
    let (sin, cos) = turn.sin_cos();
    let moved = |corner: DVec3| {
        let d = corner - center;
        center + DVec3::new(d.x * cos - d.y * sin, d.x * sin + d.y * cos, d.z)
    };
    cuboid(low, high).map(|face| face.map(moved))
}
