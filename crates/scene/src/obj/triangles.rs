//! Polygons of any number of corners as triangles, by earcut.

use super::ROUNDING;
use super::outline::Outline;
use radiosity_geometry::{DVec3, has_area};

/// The triangles of a polygon, which may have reflex corners; `None` if it crosses itself. Corners
/// on its edges are corners of triangles, too.
pub(super) fn triangles(outline: &Outline, positions: &[DVec3]) -> Option<Vec<Vec<u32>>> {
    let corners = &outline.corners;
    let count = corners.len();
    let mut triangles = Vec::new();
    for places in cut(&scaled(corners, positions))? {
        let on_edge = |k: usize| {
            let (from, to) = (places[k], places[(k + 1) % 3]);
            let on_edge = (to == (from + 1) % count).then(|| outline.on_edges.get(from));
            on_edge.flatten().map_or(&[][..], Vec::as_slice)
        };
        let on_edges = [0, 1, 2].map(on_edge);
        fan(places.map(|place| corners[place]), on_edges, &mut triangles);
    }
    triangles.retain(|triangle| has_area(triangle.map(|corner| positions[corner as usize])));
    Some(triangles.into_iter().map(Vec::from).collect())
}

/// The corners around the first one, in units of the polygon's size, so that no digits are lost.
fn scaled(corners: &[u32], positions: &[DVec3]) -> Vec<[f64; 3]> {
    let at = |&corner: &u32| positions[corner as usize] - positions[corners[0] as usize];
    let sizes = corners.iter().map(|corner| at(corner).abs().max_element());
    let size = sizes.fold(0.0, f64::max);
    corners
        .iter()
        .map(|corner| (at(corner) / size).to_array())
        .collect()
}

/// The triangles of a polygon that turns at each corner.
fn cut(points: &[[f64; 3]]) -> Option<Vec<[usize; 3]>> {
    let mut flat = Vec::new();
    if !earcut::utils3d::project3d_to_2d(points, points.len(), &mut flat) {
        return None;
    }
    let mut found: Vec<usize> = Vec::new();
    earcut::Earcut::new().earcut(flat.iter().copied(), &[], &mut found);
    let triangles: Vec<[usize; 3]> = found.as_chunks().0.to_vec();
    let areas = triangles
        .iter()
        .map(|t| doubled_area(&t.map(|k| flat[k])).abs());
    let (sum, whole) = (areas.sum::<f64>(), doubled_area(&flat).abs());
    ((sum - whole).abs() <= ROUNDING * whole).then_some(triangles)
}

/// Twice the area of a plane polygon, positive counter-clockwise.
fn doubled_area(corners: &[[f64; 2]]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let cross = |([ax, ay], [bx, by]): (&[f64; 2], &[f64; 2])| ax * by - ay * bx;
    corners.iter().zip(next).map(cross).sum()
}

/// Cuts a triangle so that the points on its edges are corners: by lines from the corner opposite
/// to the first edge that has any.
fn fan(corners: [u32; 3], on_edges: [&[u32]; 3], triangles: &mut Vec<[u32; 3]>) {
    let Some(k) = on_edges.iter().position(|points| !points.is_empty()) else {
        triangles.push(corners);
        return;
    };
    let [a, b, c] = [0, 1, 2].map(|n| corners[(k + n) % 3]);
    let [on_ab, on_bc, on_ca] = [0, 1, 2].map(|n| on_edges[(k + n) % 3]);
    let (first, last) = (on_ab[0], on_ab[on_ab.len() - 1]);
    fan([a, first, c], [&[], &[], on_ca], triangles);
    let inner = on_ab.array_windows().map(|&[from, to]| [from, to, c]);
    triangles.extend(inner);
    fan([last, b, c], [&[], on_bc, &[]], triangles);
}
