//! Faces that lie on others take their light, and nothing counts twice.

use crate::estimated;
use radiosity_form_factors::FormFactors;
use radiosity_geometry::{DVec3, Mesh, Shape};
use radiosity_test_kit::{cut, polygon};

/// A rotation, so that no plane is one of coordinates.
fn turned(x: f64, y: f64, z: f64) -> DVec3 {
    x * DVec3::new(0.8, 0.48, -0.36)
        + y * DVec3::new(-0.6, 0.64, -0.48)
        + z * DVec3::new(0.0, 0.6, 0.8)
}

/// On the floor or the ceiling, to which it is turned; corners are counter-clockwise seen from
/// above.
fn flat(z: f64, corners: &[[f64; 2]]) -> Shape {
    let mut corners: Vec<DVec3> = corners.iter().map(|&[x, y]| turned(x, y, z)).collect();
    if z > 0.0 {
        corners.reverse();
    }
    polygon(&corners)
}

fn rectangle(z: f64, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> Shape {
    flat(z, &[[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
}

const WIDTH: f64 = 4.0;
const DEPTH: f64 = 3.0;
const HEIGHT: f64 = 2.5;
const FLOOR: usize = 0;
const CEILING: usize = 1;

/// A closed room: floor, ceiling, and four walls.
fn room() -> Vec<Shape> {
    let wall = |[x0, y0]: [f64; 2], [x1, y1]: [f64; 2]| {
        Shape::Quad([
            turned(x1, y1, 0.0),
            turned(x0, y0, 0.0),
            turned(x0, y0, HEIGHT),
            turned(x1, y1, HEIGHT),
        ])
    };
    vec![
        rectangle(0.0, [0.0, WIDTH], [0.0, DEPTH]),
        rectangle(HEIGHT, [0.0, WIDTH], [0.0, DEPTH]),
        wall([0.0, 0.0], [WIDTH, 0.0]),
        wall([WIDTH, 0.0], [WIDTH, DEPTH]),
        wall([WIDTH, DEPTH], [0.0, DEPTH]),
        wall([0.0, DEPTH], [0.0, 0.0]),
    ]
}

const TOLERANCE: f64 = 1e-4;

fn accurate(mesh: &Mesh) -> FormFactors {
    estimated::accurate(mesh, TOLERANCE)
}

/// Areas and `S = A F` between surfaces.
fn by_surface(
    mesh: &Mesh,
    found: &FormFactors,
) -> (Vec<f64>, impl Fn(usize, usize) -> f64 + use<>) {
    let part_of: Vec<usize> = mesh.patches.iter().map(|p| p.surface.index()).collect();
    let aggregate = found.aggregate(&part_of, 1 + part_of.iter().max().unwrap());
    let areas = aggregate.areas.clone();
    (areas.clone(), move |a: usize, b: usize| {
        areas[a] * aggregate.factor(a, b)
    })
}

/// Rows of a closed scene sum to 1 within their errors, or to nothing where patches are covered.
fn check_rows(mesh: &Mesh, found: &FormFactors) {
    for ((row, area), patch) in found.rows.iter().zip(&found.areas).zip(&mesh.patches) {
        assert!(*area <= patch.area * (1.0 + 1e-9));
        let expected = if *area > 0.0 { 1.0 } else { 0.0 };
        let error = 3.0 * row.error.unwrap() + 1e-6;
        let surface = patch.surface;
        assert!((row.fronts - expected).abs() < error, "{surface:?} {row:?}");
    }
    let room = 2.0 * (WIDTH * DEPTH + WIDTH * HEIGHT + DEPTH * HEIGHT);
    assert!((found.areas.iter().sum::<f64>() - room).abs() < 1e-7);
}

#[test]
fn a_flush_panel_takes_its_place_on_the_ceiling() {
    let mut shapes = room();
    let (x, y) = ([0.9, 2.3], [0.4, 2.1]);
    shapes.push(rectangle(HEIGHT, x, y));
    let mesh = cut(shapes.clone(), 5);
    let found = accurate(&mesh);
    check_rows(&mesh, &found);
    let (areas, exchange) = by_surface(&mesh, &found);
    assert!((areas[6] - 1.4 * 1.7).abs() < 1e-9);
    // The panel sees the floor as if there were no ceiling, and both together what the whole
    // ceiling does.
    let alone = cut([shapes[FLOOR].clone(), shapes[6].clone()], 5);
    let (_, of_panel) = by_surface(&alone, &accurate(&alone));
    let empty = cut(room(), 5);
    let (_, of_room) = by_surface(&empty, &accurate(&empty));
    let bound = 2.0 * TOLERANCE * WIDTH * DEPTH;
    assert!((exchange(6, FLOOR) - of_panel(1, 0)).abs() < bound);
    assert!(
        (exchange(6, FLOOR) + exchange(CEILING, FLOOR) - of_room(CEILING, FLOOR)).abs() < bound
    );
    assert_eq!(exchange(6, CEILING), 0.0);
}

#[test]
fn of_equal_walls_one_counts() {
    for second in [
        rectangle(0.0, [0.0, WIDTH], [0.0, DEPTH]),
        // Begins at another corner.
        flat(
            0.0,
            &[[WIDTH, DEPTH], [0.0, DEPTH], [0.0, 0.0], [WIDTH, 0.0]],
        ),
    ] {
        let mut shapes = room();
        shapes.push(second);
        let mesh = cut(shapes, 4);
        let found = accurate(&mesh);
        check_rows(&mesh, &found);
        let (areas, exchange) = by_surface(&mesh, &found);
        assert_eq!(areas[FLOOR], 0.0);
        assert_eq!(exchange(FLOOR, CEILING), 0.0);
        assert!(exchange(6, CEILING) > 0.0);
    }
}

/// Rugs of three and four corners that overlap each other, reach over the edges of patches, and lie
/// behind a screen.
#[test]
fn what_lies_on_each_other_behind_a_screen_adds_up() {
    let mut shapes = room();
    shapes.push(rectangle(0.0, [0.5, 3.1], [0.7, 2.6]));
    shapes.push(flat(0.0, &[[0.3, 0.2], [3.3, 1.1], [1.2, 2.9]]));
    shapes.push(rectangle(0.0, [1.0, 1.5], [1.0, 1.5]));
    let screen = [[0.8, 0.9], [2.2, 1.9]].map(|[x, y]| [turned(x, y, 0.3), turned(x, y, 1.4)]);
    let [[a, d], [b, c]] = screen;
    shapes.extend([Shape::Quad([a, b, c, d]), Shape::Quad([d, c, b, a])]);
    let mesh = cut(shapes, 3);
    let found = accurate(&mesh);
    let screen = 2.0 * (b - a).length() * (d - a).length();
    let room = 2.0 * (WIDTH * DEPTH + WIDTH * HEIGHT + DEPTH * HEIGHT);
    assert!((found.areas.iter().sum::<f64>() - room - screen).abs() < 1e-7);
    let rows = found
        .rows
        .iter()
        .zip(&found.areas)
        .filter(|(_, area)| **area > 0.0);
    let off: Vec<bool> = rows
        .map(|(row, _)| (row.fronts - 1.0).abs() > 2.0 * row.error.unwrap() + 1e-6)
        .collect();
    // Errors are estimates: 1 in 20 may be twice as large.
    assert!(20 * off.iter().filter(|off| **off).count() <= off.len());
}

/// The other estimators take patches as they are, as the course does.
#[test]
fn the_regular_rule_takes_whole_patches() {
    let mut shapes = room();
    shapes.push(rectangle(HEIGHT, [0.9, 2.3], [0.4, 2.1]));
    let mesh = cut(shapes, 2);
    let found = estimated::regular(&mesh, 3);
    let areas: Vec<f64> = mesh.patches.iter().map(|patch| patch.area).collect();
    assert_eq!(found.areas, areas);
}
