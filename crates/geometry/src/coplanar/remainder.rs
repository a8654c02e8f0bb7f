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
mod tests;
