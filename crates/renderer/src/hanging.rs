//! Hanging vertices: where neighbouring faces are cut into different numbers of patches, each has
//! vertices within patch edges of the other. Along a shared edge only the vertices that all
//! sides have are free; the interpolant is linear between them.

use radiosity_geometry::{Face, Grid};
use std::collections::HashMap;

/// A vertex on the straight line between two others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hanging {
    pub(crate) vertex: u32,
    /// The nearest vertices along the edge that all sides have.
    pub(crate) ends: [u32; 2],
    /// Where between them, in (0, 1).
    pub(crate) t: f32,
}

/// All hanging vertices along edges that faces share. `corners` are the vertices of each patch;
/// two faces share an edge if its ends are the same vertices.
pub(crate) fn hanging_vertices(faces: &[&Face], corners: &[[u32; 4]]) -> Vec<Hanging> {
    let mut edges: HashMap<[u32; 2], Vec<Vec<u32>>> = HashMap::new();
    let mut order = Vec::new();
    for face in faces {
        for side in 0..face.polygon.corners().len() {
            let mut line = side_vertices(face, side, corners);
            if line.first() > line.last() {
                line.reverse();
            }
            let ends = [line[0], line[line.len() - 1]];
            let lines = edges.entry(ends).or_default();
            if lines.is_empty() {
                order.push(ends);
            }
            lines.push(line);
        }
    }
    order
        .iter()
        .flat_map(|ends| along_edge(&edges[ends]))
        .collect()
}

/// The vertices of a face along one of its sides, both ends included.
fn side_vertices(face: &Face, side: usize, corners: &[[u32; 4]]) -> Vec<u32> {
    let ends = [side, (side + 1) % face.polygon.corners().len()];
    let along =
        |count: u32, cell: &dyn Fn(u32) -> usize| (0..count).map(|k| (cell(k), ends)).collect();
    // Cells, and the ends of their edges among their corners.
    let edges: Vec<(usize, [usize; 2])> = match (face.grid, side) {
        (Grid::Quad { a, b }, 0) => along(a, &|k| quad_cell(b, k, 0)),
        (Grid::Quad { a, b }, 1) => along(b, &|k| quad_cell(b, a - 1, k)),
        (Grid::Quad { a, b }, 2) => along(a, &|k| quad_cell(b, a - 1 - k, b - 1)),
        (Grid::Quad { b, .. }, _) => along(b, &|k| quad_cell(b, 0, b - 1 - k)),
        (Grid::Triangle { n }, 0) => along(n, &|k| upright_cell(n, k, 0)),
        (Grid::Triangle { n }, 1) => along(n, &|k| upright_cell(n, n - 1 - k, k)),
        (Grid::Triangle { n }, _) => along(n, &|k| upright_cell(n, 0, n - 1 - k)),
        (Grid::Narrow(grid), _) => grid.along_edge(side),
    };
    let corner = |cell: usize, index: usize| corners[face.first_patch + cell][index];
    let mut vertices: Vec<u32> = edges
        .iter()
        .map(|&(cell, [from, _])| corner(cell, from))
        .collect();
    vertices.extend(edges.last().map(|&(cell, [_, to])| corner(cell, to)));
    vertices
}

fn quad_cell(b: u32, i: u32, j: u32) -> usize {
    (i * b + j) as usize
}

fn upright_cell(n: u32, i: u32, j: u32) -> usize {
    (i * (2 * n - i) + 2 * j) as usize
}

/// The hanging vertices of one shared edge, given each face's vertices along it.
fn along_edge(lines: &[Vec<u32>]) -> Vec<Hanging> {
    let common = lines.iter().fold(0, |g, line| gcd(g, line.len() - 1));
    let mut hanging = Vec::new();
    for line in lines {
        let steps = (line.len() - 1) / common;
        for (k, &vertex) in line.iter().enumerate() {
            let (segment, rest) = (k / steps, k % steps);
            if rest > 0 {
                hanging.push(Hanging {
                    vertex,
                    ends: [line[segment * steps], line[(segment + 1) * steps]],
                    t: rest as f32 / steps as f32,
                });
            }
        }
    }
    hanging
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}
