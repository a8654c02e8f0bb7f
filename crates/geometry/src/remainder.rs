//! Convex polygons without the convex polygons that lie on them.

use crate::polygon::Polygon;
use glam::DVec3;

/// The part of a planar convex polygon that other ones in its plane, turning the same way, do
/// not cover, in polygons of three or four corners. What is narrower than `tolerance` is rounding.
pub fn remainder(
    whole: &[DVec3],
    normal: DVec3,
    holes: &[&[DVec3]],
    tolerance: f64,
) -> Vec<Polygon> {
    let mut pieces = vec![whole.to_vec()];
    for hole in holes {
        let around = |piece: Vec<DVec3>| match outside(piece.clone(), hole, normal, tolerance) {
            (beyond, Some(_)) => beyond,
            // What has nothing in common with the hole stays in one piece.
            (_, None) => vec![piece],
        };
        pieces = pieces.into_iter().flat_map(around).collect();
        pieces = pieces
            .iter()
            .filter_map(|piece| tidy(piece, normal, tolerance))
            .collect();
    }
    pieces.iter().flat_map(|piece| fan(piece)).collect()
}

/// Whether two planar convex polygons in one plane, turning the same way, overlap by more than
/// `tolerance`.
pub(crate) fn overlap(a: &[DVec3], b: &[DVec3], normal: DVec3, tolerance: f64) -> bool {
    let (_, common) = outside(a.to_vec(), b, normal, tolerance);
    common.is_some_and(|common| tidy(&common, normal, tolerance).is_some())
}

/// A convex polygon in polygons of three or four corners, all of which have its first.
pub fn fan(corners: &[DVec3]) -> Vec<Polygon> {
    let (first, rest) = (corners[0], &corners[1..]);
    let pieces = rest[..rest.len() - 1].chunks(2).zip(rest[1..].chunks(2));
    let piece = |(from, to): (&[DVec3], &[DVec3])| match *to {
        [middle, last] => Polygon::quad([first, from[0], middle, last]),
        _ => Polygon::triangle([first, from[0], to[0]]),
    };
    pieces.map(piece).collect()
}

/// What of a polygon is outside of a hole, in pieces, and what is inside: what is beyond the hole's
/// first edge, of the rest what is beyond the second, and so on.
fn outside(
    piece: Vec<DVec3>,
    hole: &[DVec3],
    normal: DVec3,
    tolerance: f64,
) -> (Vec<Vec<DVec3>>, Option<Vec<DVec3>>) {
    let mut beyond = Vec::new();
    let mut rest = Some(piece);
    for (k, &corner) in hole.iter().enumerate() {
        let along = (hole[(k + 1) % hole.len()] - corner).normalize_or_zero();
        let Some(piece) = rest else {
            break;
        };
        let (left, right) = split(&piece, corner, normal.cross(along), tolerance);
        beyond.extend(right);
        rest = left;
    }
    (beyond, rest)
}

/// Both sides of a line: the one that the unit vector `inward` points to, and the other. Corners
/// nearer to the line than `tolerance` are on it.
fn split(
    polygon: &[DVec3],
    on_line: DVec3,
    inward: DVec3,
    tolerance: f64,
) -> (Option<Vec<DVec3>>, Option<Vec<DVec3>>) {
    let heights = polygon.iter().map(|p| inward.dot(p - on_line));
    let on_or_off = |h: f64| if h.abs() <= tolerance { 0.0 } else { h };
    let heights: Vec<f64> = heights.map(on_or_off).collect();
    let (mut left, mut right) = (Vec::new(), Vec::new());
    for (k, (&corner, &height)) in polygon.iter().zip(&heights).enumerate() {
        let next = (k + 1) % polygon.len();
        if height >= 0.0 {
            left.push(corner);
        }
        if height <= 0.0 {
            right.push(corner);
        }
        if height * heights[next] < 0.0 {
            let t = height / (height - heights[next]);
            let crossing = corner + t * (polygon[next] - corner);
            left.push(crossing);
            right.push(crossing);
        }
    }
    let has = |sign: f64| heights.iter().any(|h| h * sign > 0.0);
    (has(1.0).then_some(left), has(-1.0).then_some(right))
}

/// A polygon without the corners that lie on the line between their neighbours; none if it is a
/// sliver.
fn tidy(polygon: &[DVec3], normal: DVec3, tolerance: f64) -> Option<Vec<DVec3>> {
    let mut corners = polygon.to_vec();
    let mut k = 0;
    while corners.len() >= 3 && k < corners.len() {
        let [before, after] =
            [corners.len() - 1, 1].map(|step| corners[(k + step) % corners.len()]);
        let across = after - before;
        let height = across.cross(corners[k] - before).length();
        if height <= tolerance * across.length() {
            corners.remove(k);
            // Its neighbours may now be on a line.
            k = 0;
        } else {
            k += 1;
        }
    }
    let edges = (0..corners.len()).map(|k| corners[k].distance(corners[(k + 1) % corners.len()]));
    let longest = edges.fold(0.0, f64::max);
    let is_sliver = corners.len() < 3 || 2.0 * area_around(&corners, normal) <= tolerance * longest;
    (!is_sliver).then_some(corners)
}

/// The area of a polygon, positive if it turns counter-clockwise around the normal.
pub fn area_around(polygon: &[DVec3], normal: DVec3) -> f64 {
    let from = polygon[0];
    let around = polygon
        .windows(2)
        .map(|edge| (edge[0] - from).cross(edge[1] - from));
    0.5 * normal.dot(around.sum::<DVec3>())
}

#[cfg(test)]
mod tests {
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
            prop_assert!((total(&rest) - 1.0 + 2.0 * width * height).abs() < 1e-12);
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
}
