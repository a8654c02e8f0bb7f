//! Frames, doors and rounded walls: what is left has the area that is not taken.

use super::*;
use proptest::prelude::*;

/// Relative to the size of polygons.
const TOLERANCE: f64 = 1e-5;

fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Vec<DVec3> {
    let at = |x, y| DVec3::new(x, y, 2.0);
    vec![
        at(x, y),
        at(x + width, y),
        at(x + width, y + height),
        at(x, y + height),
    ]
}

/// The faces that remain of the unit square, checked to be usable.
fn faces(holes: &[Vec<DVec3>]) -> Vec<Vec<DVec3>> {
    let holes: Vec<&[DVec3]> = holes.iter().map(Vec::as_slice).collect();
    let rest = remainder(&rectangle(0.0, 0.0, 1.0, 1.0), DVec3::Z, &holes, TOLERANCE);
    let corners = rest.iter().map(|polygon| polygon.corners().to_vec());
    corners.collect()
}

fn total(faces: &[Vec<DVec3>]) -> f64 {
    faces.iter().map(|face| area_around(face, DVec3::Z)).sum()
}

#[test]
fn a_window_leaves_a_frame() {
    let frame = faces(&[rectangle(0.25, 0.25, 0.5, 0.5)]);
    assert_eq!(frame.len(), 4);
    assert!((total(&frame) - 0.75).abs() < 1e-12);
}

#[test]
fn a_door_touches_the_edge() {
    let wall = faces(&[rectangle(0.25, 0.0, 0.5, 0.5)]);
    assert_eq!(wall.len(), 3);
    assert!((total(&wall) - 0.75).abs() < 1e-12);
}

#[test]
fn polygons_of_more_corners_become_several_faces() {
    // A triangle cuts off all but pieces of up to five corners.
    let at = |x, y| DVec3::new(x, y, 2.0);
    let pieces = faces(&[vec![at(0.3, 0.4), at(0.6, 0.3), at(0.5, 0.7)]]);
    assert!(pieces.iter().all(|face| matches!(face.len(), 3 | 4)));
    let hole = area_around(&[at(0.3, 0.4), at(0.6, 0.3), at(0.5, 0.7)], DVec3::Z);
    assert!((total(&pieces) - 1.0 + hole).abs() < 1e-12);
}

/// Each hole cuts what it overlaps, and nothing else.
#[test]
fn pieces_are_as_many_as_holes_ask_for() {
    let place = |k: u32| f64::from(k) / 10.0 + 0.03 * f64::from(k * 7 % 5) / 5.0;
    let tiles = (0..10).flat_map(|i| (0..10).map(move |j| (i, j)));
    let holes = tiles.map(|(i, j)| rectangle(place(i), place(j), 0.05, 0.04));
    let rest = faces(&holes.collect::<Vec<_>>());
    assert!((total(&rest) - 1.0 + 100.0 * 0.002).abs() < 1e-9);
    assert!(rest.len() < 800, "{}", rest.len());
}

#[test]
fn nothing_is_left_of_what_is_covered() {
    let halves = [rectangle(0.0, 0.0, 0.5, 1.0), rectangle(0.5, 0.0, 0.5, 1.0)];
    assert!(faces(&halves).is_empty());
}

proptest! {
    /// As files write them: a wall with a door that reaches to its edge and a window beside it,
    /// at any angle, in any number of digits.
    #[test]
    fn walls_of_rounded_numbers_have_no_slivers(
        angle in 0.0f64..6.3, digits in 6i32..12, door in 0.1f64..0.5, offset in 0.0f64..1.0,
    ) {
        let (sin, cos) = angle.sin_cos();
        let rounded = |x: f64| (x * 10f64.powi(digits)).round() / 10f64.powi(digits);
        let turned = |p: DVec3| {
            let at = DVec3::new(5.0 * (cos * p.x + offset), 5.0 * sin * p.x, 2.7 * p.y);
            at.to_array().map(rounded).into()
        };
        let part = |x, y, width, height| -> Vec<DVec3> {
            rectangle(x, y, width, height).into_iter().map(turned).collect()
        };
        let wall = part(0.0, 0.0, 1.0, 1.0);
        let holes = [part(0.1, 0.0, door, 0.8), part(0.1 + door, 0.4, 0.3, 0.4)];
        let normal = (wall[1] - wall[0]).cross(wall[3] - wall[0]).normalize();
        let holes: Vec<&[DVec3]> = holes.iter().map(Vec::as_slice).collect();
        let polygons = remainder(&wall, normal, &holes, 5.0 * TOLERANCE);
        let sum: f64 = polygons.iter().map(Polygon::area).sum();
        let expected = 13.5 * (1.0 - 0.8 * door - 0.12);
        // As many edges as there may be, each off by the tolerance.
        prop_assert!((sum - expected).abs() < 20.0 * 5.0 * 5.0 * TOLERANCE, "{sum} {expected}");
        for polygon in polygons {
            let width = 2.0 * polygon.area() / polygon.longest_edge();
            prop_assert!(width > 1e-3, "{width}");
        }
    }

    #[test]
    fn the_rest_and_disjoint_holes_make_the_whole(
        x in 0.0f64..0.4, y in 0.0f64..0.9, width in 0.01f64..0.1, height in 0.01f64..0.1,
        x2 in 0.5f64..0.9, y2 in 0.0f64..0.9,
    ) {
        let holes = [rectangle(x, y, width, height), rectangle(x2, y2, width, height)];
        let rest = faces(&holes);
        // Between a hole and the border there may be a sliver, which is left out: no wider than the
        // tolerance, and no longer than the wall.
        let gaps = [x, y, y2, 1.0 - x2 - width, 1.0 - y - height, 1.0 - y2 - height];
        let slivers = gaps.iter().filter(|gap| gap.abs() <= TOLERANCE).count();
        let bound = 1e-12 + slivers as f64 * TOLERANCE;
        prop_assert!((total(&rest) - 1.0 + 2.0 * width * height).abs() < bound);
        // No point of a hole is inside of a face.
        let center = DVec3::new(x + 0.5 * width, y + 0.5 * height, 2.0);
        for face in rest {
            let inside = (0..face.len()).all(|k| {
                let edge = face[(k + 1) % face.len()] - face[k];
                DVec3::Z.cross(edge).dot(center - face[k]) > 0.0
            });
            prop_assert!(!inside);
        }
    }
}
