//! What stands between blocks, whatever is culled: against the plainest possible loop.

use crate::estimated::{accurate, monte_carlo, regular};
use crate::plain::{Plain, SINGLE};
use radiosity_geometry::{DVec3, Divisions, Mesh, PolygonMesh, Shape, Surface, subdivide};
use radiosity_test_kit::Facing::{self, Down, Up};
use radiosity_test_kit::{cuboid_mesh, cut, mesh_of, parallelogram, polygon, square};

#[test]
fn what_stands_between_blocks() {
    let (floor, light) = (
        square([0.0; 2], 1.0, 0.0, Up),
        square([0.0; 2], 1.0, 2.0, Down),
    );
    let open = regular(&mesh_of([floor.clone(), light.clone()]), 4).factor(0, 1);
    let with = |blocker: Shape| {
        let mesh = mesh_of([floor.clone(), light.clone(), blocker]);
        regular(&mesh, 4).factor(0, 1)
    };
    for facing in [Up, Down] {
        assert_eq!(
            with(square([0.0; 2], 3.0, 1.0, facing)),
            0.0,
            "both sides block"
        );
    }
    // What one half of the middle plane lets through, the other half blocks.
    let [left, right] = [-5.01, 4.99].map(|x| with(square([x, 0.0], 10.0, 1.0, Up)));
    assert!(left > 0.0 && right > 0.0);
    assert!(
        (left + right - open).abs() < 1e-6 * open,
        "{left} + {right} is not {open}"
    );
    // The total area is another one, and with it the rounding of storage.
    let beyond = with(square([0.0; 2], 3.0, 2.5, Up));
    assert!(
        (beyond - open).abs() < 1.3e-7 * open,
        "behind is not between"
    );
}

#[test]
fn only_fronts_exchange() {
    let most = |below: Facing, above: Facing| {
        let pair = [
            square([0.0; 2], 1.0, 0.0, below),
            square([0.0; 2], 1.0, 1.0, above),
        ];
        let found = regular(&cut(pair, 2), 2);
        found
            .exchange
            .matrix()
            .values()
            .iter()
            .copied()
            .fold(0.0, f32::max)
    };
    assert!(most(Up, Down) > 0.0);
    assert_eq!([most(Up, Up), most(Down, Up), most(Down, Down)], [0.0; 3]);
}

#[test]
fn faces_of_one_mesh_see_each_other_and_a_flat_face_does_not_see_itself() {
    let positions = [
        [0.0, 0.0, 1.0],
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 1.0],
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
    ]
    .map(DVec3::from)
    .to_vec();
    let faces = vec![vec![0, 1, 4, 3], vec![1, 2, 5, 4]];
    let surface = Surface {
        shape: Shape::Mesh(PolygonMesh { positions, faces }),
        divisions: Some(Divisions::uniform(2)),
    };
    let mesh = subdivide(&[surface], Divisions::uniform(1)).unwrap();
    let factors = regular(&mesh, 2);
    for i in 0..8 {
        for j in 0..8 {
            let same_face = mesh.patches[i].face == mesh.patches[j].face;
            assert_eq!(factors.factor(i, j) == 0.0, same_face, "{i} {j}");
        }
    }
}

/// A little room with a table in it, at no round angle.
pub(crate) fn cluttered() -> Vec<Shape> {
    let mut shapes = vec![
        square([0.0; 2], 2.0, 0.0, Up),
        square([0.05, 0.1], 2.0, 1.7, Down),
        square([0.3, -0.2], 0.7, 0.6, Up),
        square([0.31, -0.23], 0.72, 0.55, Down),
        Shape::Triangle([
            DVec3::new(-1.0, -0.9, 0.1),
            DVec3::new(-1.0, 1.1, 0.2),
            DVec3::new(-1.1, 0.2, 1.5),
        ]),
    ];
    shapes.push(Shape::Quad([
        DVec3::new(1.0, -1.0, 0.1),
        DVec3::new(1.0, -0.9, 1.4),
        DVec3::new(1.0, 0.8, 1.1),
        DVec3::new(1.0, 1.0, 0.1),
    ]));
    shapes
}

#[test]
fn culling_changes_nothing() {
    let mesh = cut(cluttered(), 3);
    let n = 3;
    let factors = regular(&mesh, n);
    let plain = Plain::new(&mesh, n);
    // The same patches with nothing in between: what occlusion takes away.
    let mut shadowed = 0;
    for i in 0..mesh.patches.len() {
        for j in 0..mesh.patches.len() {
            let (found, expected) = (factors.factor(i, j), plain.factor(i, j));
            assert!(
                (found - expected).abs() <= SINGLE * expected,
                "{i} {j}: {found} {expected}"
            );
            shadowed += usize::from(expected < 0.999 * alone(&mesh, n, i, j));
        }
    }
    assert!(shadowed > 200, "occlusion must be exercised: {shadowed}");
}

/// The faces of a small mesh share a tile, and are taken apart again.
#[test]
fn small_faces_do_not_hide_themselves() {
    let cube = Shape::Mesh(cuboid_mesh([-0.5, -0.5, 1.0], [0.5, 0.5, 2.0]));
    let mesh = cut([square([0.0; 2], 0.8, 0.0, Up), cube], 4);
    let factors = regular(&mesh, 2);
    let plain = Plain::new(&mesh, 2);
    let others = [monte_carlo(&mesh, [2, 1000], 1), accurate(&mesh, 1e-3)];
    let below = mesh.patches.len() - 6..mesh.patches.len();
    for i in below {
        let mut expected = 0.0;
        for j in 0..mesh.patches.len() {
            let (found, plain) = (factors.factor(i, j), plain.factor(i, j));
            assert!(
                (found - plain).abs() <= 1e-5 * plain + 1e-9,
                "{i} {j}: {found} {plain}"
            );
            expected += plain;
        }
        // Two points along an edge are coarse here, and random ones noisy.
        for other in &others {
            let fronts = other.rows[i].fronts;
            assert!(
                (fronts - expected).abs() < 0.2 * expected + 1e-6,
                "{fronts} {expected}"
            );
        }
    }
    assert!(factors.rows.iter().any(|row| row.fronts > 0.1));
}

/// Points of patches that cross coincide, and their kernel is rounding.
#[test]
fn crossing_patches_exchange_finite_light() {
    for degrees in [10.0_f64, 35.0, 60.0, 90.0, 123.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (along, across) = (DVec3::new(cos, sin, 0.3), DVec3::new(-sin, cos, 0.7));
        let around = |a: DVec3, b: DVec3| parallelogram(-0.5 * (a + b), a, b);
        let crossing = [DVec3::Z, DVec3::X, across].map(|edge| around(along, edge));
        let factors = regular(&mesh_of(crossing), 3);
        assert!(
            factors.rows.iter().all(|row| row.fronts < 10.0),
            "{:?}",
            factors.rows
        );
    }
}

/// The factor of two patches with nothing else in the scene.
fn alone(mesh: &Mesh, n: u32, i: usize, j: usize) -> f64 {
    if mesh.patches[i].face == mesh.patches[j].face {
        return 0.0;
    }
    let shape = |k: usize| polygon(mesh.patches[k].polygon.corners());
    regular(&mesh_of([shape(i), shape(j)]), n).factor(0, 1)
}
