//! Narrow triangles: as few patches as their area and length ask for, and vertices where neighbours
//! have theirs.

use crate::sliver::{Sliver, any_sliver};
use proptest::prelude::*;
use radiosity_geometry::{
    DVec2, DVec3, Divisions, FaceId, Grid, Mesh, Patch, PolygonMesh, Shape, count_patches,
    subdivide,
};
use radiosity_test_kit::surface;
use std::collections::HashSet;

fn at(patch: &Patch, on_patch: DVec2) -> DVec3 {
    let polygon = &patch.polygon;
    if polygon.is_triangle() {
        polygon.barycentric(on_patch.x, on_patch.y)
    } else {
        polygon.bilinear(on_patch.x, on_patch.y)
    }
}

/// The ends of all edges of patches, to the digits that rounding leaves.
fn edges(mesh: &Mesh) -> Vec<[[i64; 3]; 2]> {
    let place = |point: DVec3| (point * 1e9).round().to_array().map(|x| x as i64);
    let of_patch = |patch: &Patch| {
        let corners = patch.polygon.corners().to_vec();
        let next = |k: usize| corners[(k + 1) % corners.len()];
        let ends = |k: usize| [place(corners[k]), place(next(k))];
        (0..corners.len()).map(ends).collect::<Vec<_>>()
    };
    mesh.patches.iter().flat_map(of_patch).collect()
}

/// How many edges of patches lie along an edge of the face, if they follow each other from its one
/// end to its other.
fn pieces(mesh: &Mesh, edge: usize) -> usize {
    let Grid::Narrow(grid) = mesh.faces[0].grid else {
        panic!("{:?}", mesh.faces[0].grid);
    };
    let corners = mesh.faces[0].polygon.corners();
    let [from, to] = [corners[edge], corners[(edge + 1) % 3]];
    let pieces = grid.along_edge(edge);
    for (k, (cell, ends)) in pieces.iter().enumerate() {
        for (end, place) in ends.iter().zip([k, k + 1]) {
            let expected = from.lerp(to, place as f64 / pieces.len() as f64);
            let found = mesh.patches[*cell].polygon.corners()[*end];
            assert!(found.distance(expected) < 1e-12);
        }
    }
    pieces.len()
}

fn powers_of_two(length: f64, max_edge: f64) -> usize {
    ((length / max_edge).ceil() as usize).next_power_of_two()
}

#[test]
fn a_skirting_board_takes_a_patch_for_each_of_its_pieces() {
    let corners = [[0.0, 0.0], [12.0, 0.0], [12.0, 0.15], [0.0, 0.15]];
    let mesh = PolygonMesh {
        positions: corners.map(|[x, z]| DVec3::new(x, 2.0, z)).to_vec(),
        faces: vec![vec![0, 1, 2], vec![2, 3, 0]],
    };
    let surface = surface(Shape::Mesh(mesh));
    // 32 pieces on either long edge of either triangle.
    assert_eq!(count_patches(&[surface], Divisions::MaxEdge(0.5)), Ok(64));
}

#[test]
fn halves_of_squares_and_wider_triangles_are_cut_alike_along_all_edges() {
    for tip in [[0.5, 0.75_f64.sqrt()], [0.5, 0.5], [0.3, 0.6], [0.1, 0.9]] {
        for max_edge in [0.3, 0.1, 0.03] {
            let sliver = Sliver {
                corners: [
                    DVec3::new(0.1, 0.7, 0.0),
                    DVec3::new(1.1, 0.7, 0.0),
                    DVec3::new(0.1 + tip[0], 0.7 + tip[1], 0.0),
                ],
                max_edge,
            };
            let longest = sliver.length(sliver.longest_edge());
            let n = (longest / max_edge * (1.0 - 1e-9)).ceil() as u32;
            assert_eq!(sliver.alone().faces[0].grid, Grid::Triangle { n });
            let n = n.next_power_of_two();
            assert_eq!(sliver.in_mesh().faces[0].grid, Grid::Triangle { n });
        }
    }
}

#[test]
fn slanted_quads_of_meshes_are_halved_and_others_stay() {
    let cut = |corners: [[f64; 2]; 4]| {
        let mesh = PolygonMesh {
            positions: corners.map(|[x, y]| DVec3::new(x, y, 1.0)).to_vec(),
            faces: vec![vec![0, 1, 2, 3]],
        };
        let surfaces = [surface(Shape::Mesh(mesh))];
        let mesh = subdivide(&surfaces, Divisions::MaxEdge(0.3)).unwrap();
        let count = count_patches(&surfaces, Divisions::MaxEdge(0.3));
        assert_eq!(count, Ok(mesh.patches.len()));
        mesh
    };
    let slanted = [
        [[0.0, 0.0], [7.0, -0.1], [14.0, 0.0], [7.0, 0.1]],
        [[0.0, 0.0], [9.0, 0.0], [16.0, 0.4], [7.0, 0.4]],
        [[0.0, 0.0], [9.0, 0.0], [9.0, 0.2], [8.0, 0.25]],
    ];
    for corners in slanted {
        let mesh = cut(corners);
        assert!(mesh.faces.iter().all(|face| face.input_index == 0));
        assert_eq!(mesh.faces.len(), 2);
        let longest = mesh.faces.iter().map(|face| face.polygon.longest_edge());
        // Counts are powers of two, so pieces may be half as long as allowed.
        let pieces = 2.0 * longest.fold(0.0, f64::max) / 0.3;
        let most = 4.0 * pieces.max(mesh.total_area() / (0.15 * 0.15));
        assert!((mesh.patches.len() as f64) < most);
        let longest = mesh
            .patches
            .iter()
            .map(|patch| patch.polygon.longest_edge());
        assert!(longest.fold(0.0, f64::max) <= 0.3);
    }
    let strip = cut([[0.0, 0.0], [9.0, 0.0], [9.0, 0.2], [0.0, 0.2]]);
    assert_eq!(strip.faces[0].grid, Grid::Quad { a: 32, b: 1 });
    let leaning = cut([[0.0, 0.0], [3.0, 0.0], [5.0, 1.0], [2.0, 1.0]]);
    assert_eq!(leaning.faces[0].grid, Grid::Quad { a: 16, b: 8 });
}

/// A few are cut finer, so that all their edges are short enough.
#[test]
fn edges_are_cut_as_their_own_lengths_ask_for() {
    let mut finer = 0;
    for k in 0..2000 {
        let fraction = |step: f64| (f64::from(k) * step).fract();
        let (foot, height) = (
            fraction(0.618_034),
            0.001 + 0.4 * fraction(0.754_878).powi(2),
        );
        let tip = DVec3::new(foot.clamp(0.1, 0.9), height, 0.0);
        let sliver = Sliver {
            corners: [DVec3::ZERO, DVec3::X, tip],
            max_edge: 0.2 * (-4.0 * fraction(0.569_840)).exp2(),
        };
        let mesh = sliver.in_mesh();
        let asked = |edge| powers_of_two(sliver.length(edge), sliver.max_edge);
        let found: Vec<usize> = (0..3).map(|edge| pieces(&mesh, edge)).collect();
        assert!((0..3).all(|edge| found[edge].is_multiple_of(asked(edge))));
        finer += usize::from((0..3).any(|edge| found[edge] != asked(edge)));
    }
    assert!(finer < 10, "{finer}");
}

proptest! {
    /// Patches tile the triangle, edge to edge, face its way, are as short as asked for and few.
    #[test]
    fn patches_fit_together_and_are_few(sliver in any_sliver()) {
        for mesh in [sliver.alone(), sliver.in_mesh()] {
            let face = &mesh.faces[0];
            prop_assert!((mesh.total_area() / face.polygon.area() - 1.0).abs() < 1e-9);
            for patch in &mesh.patches {
                prop_assert!(patch.normal.dot(patch.polygon.normal()) > 1.0 - 1e-9);
                prop_assert!(patch.area > 0.0);
                prop_assert!(patch.polygon.longest_edge() <= sliver.max_edge * (1.0 + 1e-9));
            }
            let all: HashSet<[[i64; 3]; 2]> = edges(&mesh).into_iter().collect();
            let free = all.iter().filter(|[from, to]| !all.contains(&[*to, *from])).count();
            prop_assert_eq!(free, (0..3).map(|edge| pieces(&mesh, edge)).sum());
            let longest = sliver.longest_edge();
            let count = pieces(&mesh, longest) as f64;
            let size = sliver.length(longest) / count;
            let most = 4.0 * count.max(face.polygon.area() / (size * size));
            prop_assert!(mesh.patches.len() as f64 <= most);
        }
    }

    /// A point is located in a patch that holds it, at the coordinates that give the point.
    #[test]
    fn points_are_located_in_their_patch(sliver in any_sliver(), s in 0.0..1.0, t in 0.0..1.0) {
        let (s, t): (f64, f64) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
        let mesh = sliver.in_mesh();
        let inside = |at: DVec2, is_triangle: bool| {
            let all_within = at.min_element() >= 0.0 && at.max_element() <= 1.0;
            all_within && (!is_triangle || at.x + at.y <= 1.0 + 1e-12)
        };
        let centroids = mesh.patches.iter().map(|patch| patch.centroid);
        for point in centroids.chain([mesh.faces[0].polygon.barycentric(s, t)]) {
            let found = mesh.locate(FaceId(0), point);
            let patch = &mesh.patches[found.patch];
            prop_assert!(inside(found.on_patch, patch.polygon.is_triangle()));
            prop_assert!(at(patch, found.on_patch).distance(point) < 1e-9);
        }
        for (index, patch) in mesh.patches.iter().enumerate() {
            prop_assert_eq!(mesh.locate(FaceId(0), patch.centroid).patch, index);
        }
    }
}
