//! Every patch is in one tile, and tiles waste little.

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
fn zigzag() -> Shape {
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
        surface(zigzag(), 2, 2),
        surface(rectangle(1.0, 1.0), 1, 2),
        surface(rectangle(5.0, 1.0), 7, 9),
    ];
    let mesh = subdivide(&surfaces, Divisions::uniform(1)).unwrap();
    let tiling = Tiling::new(&mesh, &MergedFaces::new(&mesh));
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
fn row_runs_hold_consecutive_patches() {
    let surfaces = [
        surface(rectangle(1.0, 1.0), 12, 12),
        surface(zigzag(), 2, 2),
    ];
    let mesh = subdivide(&surfaces, Divisions::uniform(1)).unwrap();
    let tiling = Tiling::new(&mesh, &MergedFaces::new(&mesh));
    let (mut tile, mut patch) = (0, 0);
    for row_run in &tiling.row_runs {
        assert_eq!((row_run.tiles.start, row_run.patches.start), (tile, patch));
        (tile, patch) = (row_run.tiles.end, row_run.patches.end);
        let mut patches: Vec<usize> = tiling.tiles[row_run.tiles.clone()]
            .iter()
            .flat_map(|tile| tile.patches.iter().copied())
            .collect();
        patches.sort_unstable();
        assert!(patches.into_iter().eq(row_run.patches.clone()));
    }
    assert_eq!((tile, patch), (tiling.tiles.len(), mesh.patches.len()));
    // Tiles of two rows of twelve cells, and then of eight patches.
    assert_eq!(tiling.row_runs.len(), 6 + 36_usize.div_ceil(8));
}

#[test]
fn blocks_waste_few_lanes_and_are_compact() {
    let tiles = |a: f64, b: f64, along_a: u32, along_b: u32| {
        let surfaces = [surface(rectangle(a, b), along_a, along_b)];
        let mesh = subdivide(&surfaces, Divisions::uniform(1)).unwrap();
        Tiling::new(&mesh, &MergedFaces::new(&mesh)).tiles
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
        for tile in Tiling::new(&mesh, &MergedFaces::new(&mesh)).tiles {
            let bounds = tile.bound.bounds().grown(1e-15);
            assert!(corners(&mesh, &tile.patches).all(|corner| bounds.contains(corner)));
            assert!(bounds.extent().y < 2.0 * height);
        }
    }
}

#[test]
fn small_faces_share_tiles() {
    let mesh = subdivide(&[surface(zigzag(), 2, 2)], Divisions::uniform(1)).unwrap();
    let tiles = Tiling::new(&mesh, &MergedFaces::new(&mesh)).tiles;
    assert_eq!(tiles.len(), 5);
    assert!(tiles[0].bound.face.is_none());
    assert!(tiles[4].bound.face.is_some());
}
