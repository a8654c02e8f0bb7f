//! Patches in eights: what the estimators treat together.

use crate::culling::convex_bound::ConvexBound;
use arrayvec::ArrayVec;
use radiosity_geometry::{DVec3, Face, FaceId, Grid, MergedFaces, Mesh};
use radiosity_simd::LANES;
use std::ops::Range;

/// Up to eight patches that lie close together, by index, in order.
#[derive(Clone, Debug)]
pub(crate) struct Tile {
    pub(crate) patches: ArrayVec<usize, LANES>,
    pub(crate) bound: ConvexBound,
}

/// Tiles that share a face, or a single one of small faces.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub(crate) tiles: Range<usize>,
    pub(crate) patches: Range<usize>,
    pub(crate) bound: ConvexBound,
}

/// A short run of tiles that hold consecutive patches.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct RowRun {
    pub(crate) tiles: Range<usize>,
    pub(crate) patches: Range<usize>,
}

/// All patches of a mesh, each in one tile. All patches of a run of rows come before those of the
/// next, and a group consists of whole runs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tiling {
    pub(crate) tiles: Vec<Tile>,
    pub(crate) groups: Vec<Group>,
    pub(crate) row_runs: Vec<RowRun>,
}

impl Tiling {
    pub(crate) fn new(mesh: &Mesh, walls: &MergedFaces) -> Tiling {
        let mut tiling = Tiling::default();
        let mut small = ArrayVec::new();
        for (k, face) in mesh.faces.iter().enumerate() {
            let continues = k > 0
                && (mesh.faces[k - 1].surface == face.surface
                    || walls.of_face[k - 1] == walls.of_face[k]);
            let is_large = face.grid.cells() >= LANES;
            if !continues || is_large {
                tiling.push_small(mesh, walls, &mut small);
            }
            if is_large {
                tiling.push_large(mesh, walls.of_face[k], face);
                continue;
            }
            for patch in face.patches() {
                small.push(patch);
                if small.is_full() {
                    tiling.push_small(mesh, walls, &mut small);
                }
            }
        }
        tiling.push_small(mesh, walls, &mut small);
        tiling.row_runs = row_runs(&tiling.tiles);
        tiling
    }

    /// A face of its own, in blocks.
    fn push_large(&mut self, mesh: &Mesh, id: FaceId, face: &Face) {
        let first = self.tiles.len();
        for patches in blocks(face) {
            let bound = ConvexBound::around_on_face(id, face, corners(mesh, &patches));
            self.tiles.push(Tile { patches, bound });
        }
        self.groups.push(Group {
            tiles: first..self.tiles.len(),
            patches: face.patches(),
            bound: ConvexBound::on_face(id, face, face.polygon.padded_corners()),
        });
    }

    /// Patches of small faces, which this leaves empty.
    fn push_small(&mut self, mesh: &Mesh, walls: &MergedFaces, small: &mut ArrayVec<usize, LANES>) {
        let patches = std::mem::take(small);
        let Some(&first) = patches.first() else {
            return;
        };
        let wall = |patch: usize| walls.of_face[mesh.patches[patch].face.index()];
        let bound = if patches.iter().all(|&patch| wall(patch) == wall(first)) {
            ConvexBound::around_on_face(wall(first), mesh.face_of(first), corners(mesh, &patches))
        } else {
            ConvexBound::around(corners(mesh, &patches))
        };
        let at = self.tiles.len();
        self.groups.push(Group {
            tiles: at..at + 1,
            patches: first..first + patches.len(),
            bound: bound.clone(),
        });
        self.tiles.push(Tile { patches, bound });
    }
}

fn row_runs(tiles: &[Tile]) -> Vec<RowRun> {
    let mut row_runs: Vec<RowRun> = Vec::new();
    let (mut first_tile, mut first_patch) = (0, 0);
    let (mut last, mut seen) = (0, 0);
    for (k, tile) in tiles.iter().enumerate() {
        seen += tile.patches.len();
        last = tile.patches.iter().copied().fold(last, usize::max);
        if seen == last + 1 {
            row_runs.push(RowRun {
                tiles: first_tile..k + 1,
                patches: first_patch..seen,
            });
            (first_tile, first_patch) = (k + 1, seen);
        }
    }
    row_runs
}

fn corners(mesh: &Mesh, patches: &[usize]) -> impl Iterator<Item = DVec3> {
    let patches = patches.iter();
    patches.flat_map(|&patch| mesh.patches[patch].polygon.corners().iter().copied())
}

/// The patches of a face, in blocks of cells.
fn blocks(face: &Face) -> Vec<ArrayVec<usize, LANES>> {
    let Grid::Quad { a, b } = face.grid else {
        let patches: Vec<usize> = face.patches().collect();
        let chunks = patches.chunks(LANES);
        return chunks
            .map(|chunk| chunk.iter().copied().collect())
            .collect();
    };
    let (a, b) = (a as usize, b as usize);
    let (height, width) = block_size(face, a, b);
    let mut blocks = Vec::new();
    for first_a in (0..a).step_by(height) {
        for first_b in (0..b).step_by(width) {
            let rows = first_a..a.min(first_a + height);
            let row = |row: usize| (first_b..b.min(first_b + width)).map(move |k| row * b + k);
            let patch = |cell: usize| face.first_patch + cell;
            blocks.push(rows.flat_map(row).map(patch).collect());
        }
    }
    blocks
}

/// Cells along either edge of blocks of eight: those that make the fewest blocks, and of these the
/// most compact.
fn block_size(face: &Face, a: usize, b: usize) -> (usize, usize) {
    let [corner, end_a, _, end_b] = *face.polygon.padded_corners();
    let (edge_a, edge_b) = (corner.distance(end_a), corner.distance(end_b));
    let blocks = |&(height, width): &(usize, usize)| a.div_ceil(height) * b.div_ceil(width);
    let perimeter = |&(height, width): &(usize, usize)| {
        height as f64 * edge_a / a as f64 + width as f64 * edge_b / b as f64
    };
    let sizes = [(1, 8), (2, 4), (4, 2), (8, 1)];
    let better = |x: &(usize, usize), y: &(usize, usize)| {
        let by_perimeter = perimeter(x).total_cmp(&perimeter(y));
        blocks(x).cmp(&blocks(y)).then(by_perimeter)
    };
    sizes.into_iter().min_by(better).expect("there are four")
}

#[cfg(test)]
mod tests;
