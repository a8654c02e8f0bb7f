//! How finely faces are cut: counts and edge lengths into grids.

use crate::discretization::Divisions;
use crate::mesh::{Grid, SurfaceId};
use crate::polygon::Polygon;
use crate::polygon_mesh::split_quad;
use crate::shape::Shape;
use crate::subdivide::narrow::NarrowGrid;
use crate::subdivide::{MAX_PATCHES, MeshError, Surface};

/// A polygon, or its halves, with their grids: a quad of a mesh is halved where its own grid would
/// have too many cells.
pub(crate) fn with_grids(
    id: SurfaceId,
    surface: &Surface,
    polygon: Polygon,
    divisions: Divisions,
) -> Result<Vec<(Polygon, Grid)>, MeshError> {
    let whole = grid(id, surface, &polygon, divisions)?;
    let by_length = matches!(divisions, Divisions::MaxEdge(_));
    match (&surface.shape, whole) {
        (Shape::Mesh(_), Grid::Quad { a, b }) if by_length && is_wasteful(&polygon, [a, b]) => {
            let halves =
                split_quad(*polygon.padded_corners()).map(|halves| halves.map(Polygon::triangle));
            let halves = halves.into_iter().flatten();
            halves
                .map(|half| Ok((half, grid(id, surface, &half, divisions)?)))
                .collect()
        }
        _ => Ok(vec![(polygon, whole)]),
    }
}

/// Whether cells of a quad are more than four times what cells of area `e^2` or, where it is
/// thinner, length `e` would be, `e` being the length of cells along the longest edge: it is
/// slanted, or nearly a narrow triangle.
fn is_wasteful(quad: &Polygon, [a, b]: [u32; 2]) -> bool {
    let cells = f64::from(a) * f64::from(b);
    let size = quad.longest_edge() / f64::from(a.max(b));
    a.min(b) > 4 && cells * size * size > 4.0 * quad.area()
}

fn grid(
    id: SurfaceId,
    surface: &Surface,
    polygon: &Polygon,
    divisions: Divisions,
) -> Result<Grid, MeshError> {
    match divisions {
        Divisions::Uncut if polygon.is_triangle() => Ok(Grid::Triangle { n: 0 }),
        Divisions::Uncut => Ok(Grid::Quad { a: 0, b: 0 }),
        Divisions::Count { a: 0, .. } | Divisions::Count { b: 0, .. } => {
            Err(MeshError::NoDivisions { surface: id })
        }
        Divisions::Count { a, b } if polygon.is_triangle() => {
            if a != b {
                return Err(MeshError::TwoCountsOnTriangle { surface: id, a, b });
            }
            Ok(Grid::Triangle { n: a })
        }
        Divisions::Count { a, b } => Ok(Grid::Quad { a, b }),
        Divisions::MaxEdge(length) if length > 0.0 => {
            let is_mesh = matches!(surface.shape, Shape::Mesh(_));
            Ok(grid_by_length(polygon, length, is_mesh))
        }
        Divisions::MaxEdge(_) => Err(MeshError::NoDivisions { surface: id }),
    }
}

fn grid_by_length(polygon: &Polygon, max_edge: f64, powers_of_two: bool) -> Grid {
    let count = |length: f64, max_edge: f64| {
        // An edge of exactly n lengths, up to rounding, takes n cells. Saturating is harmless:
        // such counts are refused as too many patches.
        let cells = (length / max_edge * (1.0 - 1e-12)).ceil().max(1.0) as u32;
        if powers_of_two {
            cells.checked_next_power_of_two().unwrap_or(u32::MAX)
        } else {
            cells
        }
    };
    if polygon.is_triangle() {
        let n = count(polygon.longest_edge(), max_edge);
        return if is_narrow(polygon, n) {
            Grid::Narrow(NarrowGrid::new(polygon, max_edge, count))
        } else {
            Grid::Triangle { n }
        };
    }
    let [p, q, r, s] = *polygon.padded_corners();
    let count = |length| count(length, max_edge);
    Grid::Quad {
        a: count((q - p).length().max((r - s).length())),
        b: count((s - p).length().max((r - q).length())),
    }
}

/// Whether `n^2` patches of a triangle are more than four times what patches of area `e^2` or,
/// where it is thinner, length `e` would be, `e` being an `n`th of the longest edge. Up to
/// rounding: halves of squares are not narrow.
fn is_narrow(polygon: &Polygon, n: u32) -> bool {
    let square = polygon.longest_edge() * polygon.longest_edge();
    (5..=MAX_PATCHES as u32).contains(&n) && 4.0 * polygon.area() < (1.0 - 1e-9) * square
}
