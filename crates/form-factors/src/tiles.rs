//! Patches in eights: what the estimators treat together.

use crate::part::Part;
use arrayvec::ArrayVec;
use radiosity_geometry::{DVec3, Face, FaceId, Grid, Mesh, Walls};
use radiosity_simd::LANES;
use std::ops::Range;

/// Up to eight patches that lie close together, by index, in order.
#[derive(Clone, Debug)]
pub(crate) struct Tile {
    pub(crate) patches: ArrayVec<usize, LANES>,
    pub(crate) part: Part,
}

/// Tiles that share a face, or a single one of small faces.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub(crate) tiles: Range<usize>,
    pub(crate) patches: Range<usize>,
    pub(crate) part: Part,
}

/// A short run of tiles that hold consecutive patches.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Strip {
    pub(crate) tiles: Range<usize>,
    pub(crate) patches: Range<usize>,
}

/// All patches of a mesh, each in one tile. All patches of a strip come before those of the next,
/// and a group consists of whole strips.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tiling {
    pub(crate) tiles: Vec<Tile>,
    pub(crate) groups: Vec<Group>,
    pub(crate) strips: Vec<Strip>,
}

impl Tiling {
    pub(crate) fn new(mesh: &Mesh, walls: &Walls) -> Tiling {
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
        tiling.strips = strips(&tiling.tiles);
        tiling
    }

    /// A face of its own, in blocks.
    fn push_large(&mut self, mesh: &Mesh, id: FaceId, face: &Face) {
        let first = self.tiles.len();
        for patches in blocks(face) {
            let part = Part::around_on_face(id, face, corners(mesh, &patches));
            self.tiles.push(Tile { patches, part });
        }
        self.groups.push(Group {
            tiles: first..self.tiles.len(),
            patches: face.patches(),
            part: Part::on_face(id, face, face.polygon.padded_corners()),
        });
    }

    /// Patches of small faces, which this leaves empty.
    fn push_small(&mut self, mesh: &Mesh, walls: &Walls, small: &mut ArrayVec<usize, LANES>) {
        let patches = std::mem::take(small);
        let Some(&first) = patches.first() else {
            return;
        };
        let wall = |patch: usize| walls.of_face[mesh.patches[patch].face.index()];
        let part = if patches.iter().all(|&patch| wall(patch) == wall(first)) {
            Part::around_on_face(wall(first), mesh.face_of(first), corners(mesh, &patches))
        } else {
            Part::around(corners(mesh, &patches))
        };
        let at = self.tiles.len();
        self.groups.push(Group {
            tiles: at..at + 1,
            patches: first..first + patches.len(),
            part: part.clone(),
        });
        self.tiles.push(Tile { patches, part });
    }
}

fn strips(tiles: &[Tile]) -> Vec<Strip> {
    let mut strips: Vec<Strip> = Vec::new();
    let (mut first_tile, mut first_patch) = (0, 0);
    let (mut last, mut seen) = (0, 0);
    for (k, tile) in tiles.iter().enumerate() {
        seen += tile.patches.len();
        last = tile.patches.iter().copied().fold(last, usize::max);
        if seen == last + 1 {
            strips.push(Strip {
                tiles: first_tile..k + 1,
                patches: first_patch..seen,
            });
            (first_tile, first_patch) = (k + 1, seen);
        }
    }
    strips
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
mod tests {
    use super::*;
    use radiosity_geometry::{Divisions, PolygonMesh, Shape, Surface, subdivide};

    fn surface(shape: Shape, a: u32, b: u32) -> Surface {
        Surface {
            shape,
            divisions: Some(Divisions::Count { a, b }),
        }
    }

    fn rectangle(a: f64, b: f64) -> Shape {
        Shape::Parallelogram {
            corner: DVec3::ZERO,
            edge_a: a * DVec3::X,
            edge_b: b * DVec3::Y,
        }
    }

    /// A zigzag strip of nine quads of four patches each.
    fn strip() -> Shape {
        let position = |k: usize| DVec3::new((k / 2) as f64, (k % 2) as f64, (k / 2 % 2) as f64);
        let face = |k: u32| vec![2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1];
        Shape::Mesh(PolygonMesh {
            positions: (0..20).map(position).collect(),
            faces: (0..9).map(face).collect(),
        })
    }

    #[test]
    fn every_patch_is_in_one_tile_and_groups_keep_order() {
        let triangle = Shape::Triangle([DVec3::ZERO, DVec3::X, DVec3::Y]);
        let surfaces = [
            surface(rectangle(1.0, 1.0), 12, 12),
            surface(triangle, 5, 5),
            surface(strip(), 2, 2),
            surface(rectangle(1.0, 1.0), 1, 2),
            surface(rectangle(5.0, 1.0), 7, 9),
        ];
        let mesh = subdivide(&surfaces, Divisions::uniform(1)).unwrap();
        let tiling = Tiling::new(&mesh, &Walls::new(&mesh));
        let mut seen = vec![false; mesh.patches.len()];
        let mut next = 0;
        for group in &tiling.groups {
            assert_eq!(group.tiles.start, next);
            next = group.tiles.end;
            let patches = || {
                tiling.tiles[group.tiles.clone()]
                    .iter()
                    .flat_map(|t| &t.patches)
            };
            let (first, last) = (*patches().min().unwrap(), *patches().max().unwrap());
            assert!(seen[..first].iter().all(|&seen| seen));
            assert!(!seen[first..].iter().any(|&seen| seen));
            patches().for_each(|&patch| seen[patch] = true);
            assert!(seen[first..=last].iter().all(|&seen| seen));
        }
        assert_eq!(next, tiling.tiles.len());
        assert!(seen.iter().all(|&seen| seen));
    }

    #[test]
    fn strips_hold_consecutive_patches() {
        let surfaces = [surface(rectangle(1.0, 1.0), 12, 12), surface(strip(), 2, 2)];
        let mesh = subdivide(&surfaces, Divisions::uniform(1)).unwrap();
        let tiling = Tiling::new(&mesh, &Walls::new(&mesh));
        let (mut tile, mut patch) = (0, 0);
        for strip in &tiling.strips {
            assert_eq!((strip.tiles.start, strip.patches.start), (tile, patch));
            (tile, patch) = (strip.tiles.end, strip.patches.end);
            let mut patches: Vec<usize> = tiling.tiles[strip.tiles.clone()]
                .iter()
                .flat_map(|tile| tile.patches.iter().copied())
                .collect();
            patches.sort_unstable();
            assert!(patches.into_iter().eq(strip.patches.clone()));
        }
        assert_eq!((tile, patch), (tiling.tiles.len(), mesh.patches.len()));
        // Tiles of two rows of twelve cells, and then of eight patches.
        assert_eq!(tiling.strips.len(), 6 + 36_usize.div_ceil(8));
    }

    #[test]
    fn blocks_waste_few_lanes_and_are_compact() {
        let tiles = |a: f64, b: f64, along_a: u32, along_b: u32| {
            let surfaces = [surface(rectangle(a, b), along_a, along_b)];
            let mesh = subdivide(&surfaces, Divisions::uniform(1)).unwrap();
            Tiling::new(&mesh, &Walls::new(&mesh)).tiles
        };
        let second = |tiles: &[Tile]| tiles[0].patches[1..3].to_vec();
        assert_eq!(tiles(1.0, 1.0, 12, 12).len(), 18);
        // Two rows of four, or, where cells are long, four rows of two.
        assert_eq!(second(&tiles(1.0, 1.0, 8, 8)), [1, 2]);
        assert_eq!(second(&tiles(1.0, 3.0, 8, 8)), [1, 8]);
        assert_eq!(tiles(1.0, 1.0, 1, 16).len(), 2);
    }

    #[test]
    fn tiles_of_slivers_are_around_them() {
        for height in [1e-3, 1e-6, 1e-8] {
            let triangle = [DVec3::ZERO, DVec3::X, DVec3::new(0.4, height, 0.0)];
            let surfaces = [surface(Shape::Triangle(triangle), 3, 3)];
            let mesh = subdivide(&surfaces, Divisions::uniform(1)).unwrap();
            for tile in Tiling::new(&mesh, &Walls::new(&mesh)).tiles {
                let bounds = tile.part.bounds().grown(1e-15);
                assert!(corners(&mesh, &tile.patches).all(|corner| bounds.contains(corner)));
                assert!(bounds.extent().y < 2.0 * height);
            }
        }
    }

    #[test]
    fn small_faces_share_tiles() {
        let mesh = subdivide(&[surface(strip(), 2, 2)], Divisions::uniform(1)).unwrap();
        let tiles = Tiling::new(&mesh, &Walls::new(&mesh)).tiles;
        assert_eq!(tiles.len(), 5);
        assert!(tiles[0].part.face.is_none());
        assert!(tiles[4].part.face.is_some());
    }
}
