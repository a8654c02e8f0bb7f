//! What holds for any scene: symmetries, and agreement with the plainest possible loop.

mod plain;
mod squares;

use plain::Plain;
use proptest::prelude::*;
use radiosity_form_factors::Estimator;
use radiosity_geometry::{DVec3, Divisions, Mesh, PolygonMesh, Shape, Surface, subdivide};
use squares::{mesh_of, regular, run, square};

/// The regular rule computes in single precision, relative to a point among eight patches: distances
/// between touching patches, of a sixth of an edge or more, are exact to `24 * 2^-24`, and the kernel
/// goes with the square of heights and distances.
const SINGLE: f64 = 2.0 * 24.0 / (1 << 24) as f64;

#[test]
fn what_stands_between_blocks() {
    let (floor, light) = (
        square([0.0; 2], 1.0, 0.0, true),
        square([0.0; 2], 1.0, 2.0, false),
    );
    let open = regular(&mesh_of(&[floor.clone(), light.clone()], 1), 4).factor(0, 1);
    let with = |blocker: Shape| {
        let mesh = mesh_of(&[floor.clone(), light.clone(), blocker], 1);
        regular(&mesh, 4).factor(0, 1)
    };
    for up in [true, false] {
        assert_eq!(
            with(square([0.0; 2], 3.0, 1.0, up)),
            0.0,
            "both sides block"
        );
    }
    // What one half of the middle plane lets through, the other half blocks.
    let [left, right] = [-5.01, 4.99].map(|x| with(square([x, 0.0], 10.0, 1.0, true)));
    assert!(left > 0.0 && right > 0.0);
    assert!(
        (left + right - open).abs() < 1e-6 * open,
        "{left} + {right} is not {open}"
    );
    // The total area is another one, and with it the rounding of storage.
    let beyond = with(square([0.0; 2], 3.0, 2.5, true));
    assert!(
        (beyond - open).abs() < 1.3e-7 * open,
        "behind is not between"
    );
}

#[test]
fn only_fronts_exchange() {
    let squares = |up0, up1| {
        let pair = [
            square([0.0; 2], 1.0, 0.0, up0),
            square([0.0; 2], 1.0, 1.0, up1),
        ];
        regular(&mesh_of(&pair, 2), 2)
            .exchange
            .values()
            .iter()
            .copied()
            .fold(0.0, f32::max)
    };
    assert!(squares(true, false) > 0.0);
    assert_eq!(
        [
            squares(true, true),
            squares(false, true),
            squares(false, false)
        ],
        [0.0; 3]
    );
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
fn room() -> Vec<Shape> {
    let mut shapes = vec![
        square([0.0; 2], 2.0, 0.0, true),
        square([0.05, 0.1], 2.0, 1.7, false),
        square([0.3, -0.2], 0.7, 0.6, true),
        square([0.31, -0.23], 0.72, 0.55, false),
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
    let mesh = mesh_of(&room(), 3);
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
    let position = |k: usize| {
        let at = |bit: usize| f64::from(u8::from(k >> bit & 1 != 0)) - 0.5;
        DVec3::new(at(0), at(1), 1.5 + at(2))
    };
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let cube = Shape::Mesh(PolygonMesh {
        positions: (0..8).map(position).collect(),
        faces: faces.map(|face| face.to_vec()).to_vec(),
    });
    let mesh = mesh_of(&[square([0.0; 2], 0.8, 0.0, true), cube], 4);
    let factors = regular(&mesh, 2);
    let plain = Plain::new(&mesh, 2);
    let monte_carlo = run(
        &mesh,
        Estimator::MonteCarlo {
            points: 2,
            pairs: 1000,
            seed: 1,
        },
    );
    let accurate = run(&mesh, Estimator::Accurate { tolerance: 1e-3 });
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
        for other in [&monte_carlo, &accurate] {
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
        let crossing = [DVec3::Z, DVec3::X].map(|edge| Shape::Parallelogram {
            corner: -0.5 * (along + edge),
            edge_a: along,
            edge_b: edge,
        });
        let other = Shape::Parallelogram {
            corner: -0.5 * (along + across),
            edge_a: along,
            edge_b: across,
        };
        let [a, b] = crossing;
        let factors = regular(&mesh_of(&[a, b, other], 1), 3);
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
    let shape = |k: usize| match *mesh.patches[k].polygon.corners() {
        [a, b, c] => Shape::Triangle([a, b, c]),
        [a, b, c, d] => Shape::Quad([a, b, c, d]),
        _ => unreachable!("patches have three or four corners"),
    };
    regular(&mesh_of(&[shape(i), shape(j)], 1), n).factor(0, 1)
}

/// Only one number is stored per pair, computed from the later patch's side. With the surfaces
/// in reverse order it is computed from the other side, and must be the same.
#[test]
fn exchange_is_the_same_from_either_side() {
    let shapes = room();
    let reversed: Vec<Shape> = shapes.iter().rev().cloned().collect();
    let (here, there) = (mesh_of(&shapes, 3), mesh_of(&reversed, 3));
    let (a, b) = (regular(&here, 3), regular(&there, 3));
    let find = |patch: usize| {
        let is_it = |p: &radiosity_geometry::Patch| p.polygon == here.patches[patch].polygon;
        there.patches.iter().position(is_it).unwrap()
    };
    let places: Vec<usize> = (0..here.patches.len()).map(find).collect();
    for i in 0..places.len() {
        for j in 0..i {
            let (forth, back) = (a.factor(i, j), b.factor(places[i], places[j]));
            assert!(
                (forth - back).abs() <= SINGLE * forth,
                "{i} {j}: {forth} {back}"
            );
        }
    }
}

#[test]
fn row_sums_are_sums_of_rows() {
    let mesh = mesh_of(&room(), 2);
    let factors = regular(&mesh, 2);
    for i in 0..mesh.patches.len() {
        let sum: f64 = (0..mesh.patches.len()).map(|j| factors.factor(i, j)).sum();
        assert!((factors.rows[i].fronts - sum).abs() < 1e-13);
    }
}

#[test]
fn thread_counts_leave_no_trace() {
    let mesh = mesh_of(&room(), 5);
    let monte_carlo = Estimator::MonteCarlo {
        points: 2,
        pairs: 6,
        seed: 3,
    };
    let accurate = Estimator::Accurate { tolerance: 1e-3 };
    for estimator in [Estimator::Regular { points: 2 }, monte_carlo, accurate] {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            let found = pool.install(|| run(&mesh, estimator));
            (found.exchange.values().to_vec(), found.rows)
        };
        let one = with(1);
        assert_eq!(one, with(2));
        assert_eq!(one, with(7));
    }
}

#[test]
fn seeds_matter_to_monte_carlo_alone() {
    let mesh = mesh_of(&room(), 2);
    let with = |seed| {
        let estimator = Estimator::MonteCarlo {
            points: 2,
            pairs: 4,
            seed,
        };
        run(&mesh, estimator).exchange.values().to_vec()
    };
    assert_eq!(with(1), with(1));
    assert_ne!(with(1), with(2));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Form factors are pure numbers: turning, moving and scaling a scene changes none of them.
    /// Coordinates up to 100 keep 14 digits; segments that graze an edge could flip, and there are
    /// none in this scene.
    #[test]
    fn rigid_motions_and_scale_change_nothing(
        axis in [-1.0f64..1.0, -1.0f64..1.0, 0.1f64..1.0], angle in 0.0f64..6.3,
        shift in [-50.0f64..50.0, -50.0f64..50.0, -50.0f64..50.0], scale in 0.01f64..20.0
    ) {
        let rotation = |v: DVec3| {
            let k = DVec3::from(axis).normalize();
            let (sin, cos) = angle.sin_cos();
            cos * v + sin * k.cross(v) + (1.0 - cos) * k.dot(v) * k
        };
        let moved = |v: DVec3| scale * rotation(v) + DVec3::from(shift);
        let move_shape = |shape: &Shape| match shape {
            Shape::Parallelogram { corner, edge_a, edge_b } => Shape::Parallelogram {
                corner: moved(*corner),
                edge_a: scale * rotation(*edge_a),
                edge_b: scale * rotation(*edge_b),
            },
            Shape::Triangle(corners) => Shape::Triangle(corners.map(moved)),
            Shape::Quad(corners) => Shape::Quad(corners.map(moved)),
            Shape::Mesh(_) => unreachable!("the room has none"),
        };
        let there: Vec<Shape> = room().iter().map(move_shape).collect();
        let (here, there) = (mesh_of(&room(), 2), mesh_of(&there, 2));
        let (a, b) = (regular(&here, 2), regular(&there, 2));
        for (x, y) in a.exchange.values().iter().zip(b.exchange.values()) {
            prop_assert!(f64::from((x - y).abs()) <= SINGLE * f64::from(x.max(*y)) + 1e-9, "{} {}", x, y);
        }
    }
}
