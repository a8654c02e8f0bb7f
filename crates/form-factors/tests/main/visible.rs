//! How much of a patch can be seen.

use crate::estimated::regular;
use radiosity_form_factors::FormFactors;
use radiosity_geometry::{DVec3, Divisions, Shape, Surface, subdivide};
use radiosity_test_kit::{self as kit, parallelogram};

fn surface(corner: DVec3, edge_a: DVec3, edge_b: DVec3, divisions: u32) -> Surface {
    Surface {
        divisions: Some(Divisions::uniform(divisions)),
        ..kit::surface(parallelogram(corner, edge_a, edge_b))
    }
}

/// A floor of 2 x 2 patches of size 1, and other things.
fn estimated(others: Vec<Surface>) -> FormFactors {
    let mut surfaces = vec![surface(DVec3::ZERO, 2.0 * DVec3::X, 2.0 * DVec3::Y, 2)];
    surfaces.extend(others);
    made(&surfaces)
}

fn made(surfaces: &[Surface]) -> FormFactors {
    let mesh = subdivide(surfaces, Divisions::uniform(1)).unwrap();
    regular(&mesh, 2)
}

fn visible(others: Vec<Surface>) -> [f64; 4] {
    let made = estimated(others);
    std::array::from_fn(|patch| made.rows[patch].visible)
}

/// The walls and the lid of a box on the floor, their fronts outside.
fn cuboid(corner: DVec3, [x, y, z]: [f64; 3]) -> Vec<Surface> {
    let [x, y, z] = [x * DVec3::X, y * DVec3::Y, z * DVec3::Z];
    vec![
        surface(corner + z, x, y, 1),
        surface(corner, x, z, 1),
        surface(corner + y, z, x, 1),
        surface(corner, z, y, 1),
        surface(corner + x, y, z, 1),
    ]
}

/// More walls than are tried in turn, below the floor.
fn many_more() -> Vec<Surface> {
    let below = |k: u32| DVec3::new(0.0, 0.0, -1.0 - f64::from(k));
    (0..40)
        .map(|k| surface(below(k), DVec3::X, DVec3::Y, 1))
        .collect()
}

/// Cells are 1/8 of an edge; of those that an edge of the box cuts across, a part counts as seen.
#[test]
fn what_stands_on_a_patch_hides_what_is_under_it() {
    assert_eq!(visible(Vec::new()), [1.0; 4]);
    // All of patch (0, 1), and 0.6 x 0.7 of patch (0, 0).
    let mut boxes = cuboid(DVec3::new(0.0, 1.0, 0.0), [1.0, 1.0, 0.7]);
    boxes.extend(cuboid(DVec3::new(0.2, 0.25, 0.0), [0.6, 0.7, 0.5]));
    let [partly, covered, beside, far] = visible(boxes);
    // 2,048 points of a lattice, of which those near the edges of the box are left to chance: each
    // tells 1/2,048, and along a circumference of 2.6 there are 2.6 times the root of 2,048. The
    // walls of the other box are seen from their fronts.
    let chance = (2.6 * 2048f64.sqrt()).sqrt() / 2048.0;
    assert!(
        (partly - (1.0 - 0.6 * 0.7)).abs() < 4.0 * chance,
        "{partly}"
    );
    assert_eq!([covered, beside, far], [0.0, 1.0, 1.0]);
}

/// A box in a corner of a room: where it touches the walls, their fronts tell nothing.
#[test]
fn a_box_in_a_corner_hides_what_is_under_it() {
    let walls = [
        surface(DVec3::ZERO, 2.0 * DVec3::Z, 2.0 * DVec3::X, 1),
        surface(DVec3::ZERO, 2.0 * DVec3::Y, 2.0 * DVec3::Z, 1),
    ];
    for others in [Vec::new(), many_more()] {
        let size = [0.75, 1.0, 1.5];
        let scene = [walls.to_vec(), cuboid(DVec3::ZERO, size), others].concat();
        let [under, beside @ ..] = visible(scene);
        // As above, along an edge of 1.
        let chance = 2048f64.powf(0.25) / 2048.0;
        assert!((under - 0.25).abs() <= 4.0 * chance, "{under}");
        assert_eq!(beside, [1.0; 3]);
    }
}

/// A box between two pillars, in front of a wall, all of the same height.
#[test]
fn a_box_in_a_niche_hides_what_is_under_it() {
    let floor = surface(DVec3::X, DVec3::X, 2.0 * DVec3::Y, 2);
    let wall = surface(DVec3::ZERO, 2.0 * DVec3::Z, 3.0 * DVec3::X, 1);
    let pillar = |x: f64| cuboid(DVec3::new(x, 0.0, 0.0), [1.0, 1.2, 1.5]);
    let between = cuboid(DVec3::new(1.0, 0.0, 0.0), [1.0, 1.0, 1.5]);
    for others in [Vec::new(), many_more()] {
        let niche = [vec![floor.clone(), wall.clone()], pillar(0.0), pillar(2.0)].concat();
        let made = made(&[niche, between.clone(), others].concat());
        let visible: [f64; 4] = std::array::from_fn(|patch| made.rows[patch].visible);
        // Under the box, and in front of it.
        assert_eq!(visible, [0.0, 1.0, 0.0, 1.0]);
    }
}

/// With another corner and other edges.
fn changed(surface: &Surface, change: impl Fn([DVec3; 3]) -> [DVec3; 3]) -> Surface {
    let Shape::Parallelogram {
        corner,
        edge_a,
        edge_b,
    } = surface.shape
    else {
        unreachable!("all are parallelograms")
    };
    let [corner, edge_a, edge_b] = change([corner, edge_a, edge_b]);
    Surface {
        shape: parallelogram(corner, edge_a, edge_b),
        ..surface.clone()
    }
}

fn reversed(surface: &Surface) -> Surface {
    changed(surface, |[corner, a, b]| [corner + a, -a, b])
}

/// Where planes are the same up to rounding alone.
fn turned(surface: &Surface) -> Surface {
    let z = DVec3::new(0.6, -0.3, 0.7).normalize();
    let (x, y) = z.any_orthonormal_pair();
    let turn = |v: DVec3| v.x * x + v.y * y + v.z * z;
    let moved = DVec3::new(3.1, -4.7, 0.3);
    changed(surface, |[corner, a, b]| [corner + moved, a, b].map(turn))
}

/// A room of 2 x 2 x 3, the 2 x 2 patches of its floor first.
fn room() -> Vec<Surface> {
    let outside = cuboid(DVec3::ZERO, [2.0, 2.0, 3.0]);
    let floor = surface(DVec3::ZERO, 2.0 * DVec3::X, 2.0 * DVec3::Y, 2);
    [floor]
        .into_iter()
        .chain(outside.iter().map(reversed))
        .collect()
}

/// A room whose walls are made of two faces each is as any other.
#[test]
fn walls_of_two_faces_show_their_fronts() {
    let outside: Vec<Surface> = room().iter().map(reversed).collect();
    // Seen from behind, it is all that some patches of the ceiling see but walls.
    let plate = surface(DVec3::new(0.2, 0.2, 2.0), 1.5 * DVec3::X, 1.5 * DVec3::Y, 1);
    let rooms = [room(), [room(), vec![reversed(&plate)]].concat()];
    for (inside, others) in rooms
        .iter()
        .flat_map(|inside| [(inside, Vec::new()), (inside, many_more())])
    {
        let count = inside.len() + 3;
        let all = [inside.clone(), outside.clone(), others].concat();
        for turn in [Surface::clone, turned] {
            let plain = made(&inside.iter().map(turn).collect::<Vec<_>>());
            let doubled = made(&all.iter().map(turn).collect::<Vec<_>>());
            for (row, plain) in doubled.rows.iter().zip(&plain.rows) {
                assert_eq!((row.visible, row.background), (plain.visible, 0.0));
                assert!((row.backs - plain.backs).abs() <= 1.0 / 256.0, "{row:?}");
            }
            // Those of the floor may see the things below it.
            for row in &doubled.rows[count + 4..count + 9] {
                assert_eq!((row.fronts, row.background), (0.0, 1.0));
            }
        }
    }
}

/// Just in front of a ceiling a plate hides it, and just behind it does not.
#[test]
fn small_gaps_count() {
    let plate = |z: f64| surface(DVec3::new(0.0, 0.0, z), 2.0 * DVec3::X, 2.0 * DVec3::Y, 1);
    let backs = |z: f64, others: Vec<Surface>| {
        let made = made(&[room(), vec![plate(z)], others].concat());
        made.rows[..4].iter().map(|row| row.backs).sum::<f64>() / 4.0
    };
    for others in [Vec::new(), many_more()] {
        // Less than single precision may round off products with distances in this room. By the
        // factor of equal parallel squares at a distance of 1.5 of their edges.
        assert!((backs(3.0 - 2e-6, others.clone()) - 0.1166).abs() < 0.01);
        assert_eq!(backs(3.0 + 2e-6, others.clone()), 0.0);
        assert_eq!(backs(3.0, others), 0.0);
    }
}

/// A plate with a gap below it: nothing can be seen but at its border.
#[test]
fn a_cover_hides_what_it_covers() {
    let plate = surface(DVec3::new(0.5, 0.0, 1e-3), 0.5 * DVec3::X, DVec3::Y, 1);
    let [half, ..] = visible(vec![plate]);
    // As above, along an edge of 1.
    let chance = 2048f64.powf(0.25) / 2048.0;
    assert!((half - 0.5).abs() <= 4.0 * chance, "{half}");
}

/// A wall beside a patch, seen from behind, and a table over it, which light comes under.
#[test]
fn backs_in_sight_hide_nothing() {
    let wall = surface(DVec3::ZERO, 2.0 * DVec3::X, 5.0 * DVec3::Z, 1);
    let table = surface(DVec3::new(0.0, 0.0, 0.4), DVec3::X, DVec3::Y, 1);
    for (other, backs) in [(wall, 0.2), (table, 0.4)] {
        let made = estimated(vec![other]);
        assert!(made.rows[0].backs > backs, "{}", made.rows[0].backs);
        assert!(made.rows[..4].iter().all(|row| row.visible == 1.0));
    }
}
