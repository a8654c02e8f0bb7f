//! Walls with panels, rugs and copies of themselves on them, at an angle to all axes.

use super::*;
use crate::{Divisions, Mesh, Occluders, PolygonMesh, Ray, Shape, Surface, subdivide};
use proptest::prelude::*;

/// Turns what lies in the plane `z = 0` into a plane at an angle to all axes.
fn turned(x: f64, y: f64) -> DVec3 {
    DVec3::new(0.8 * x, 0.48 * x + 0.6 * y, -0.36 * x + 0.8 * y) + DVec3::new(2.0, -1.0, 0.7)
}

fn rectangle([x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> Shape {
    Shape::Quad([
        turned(x0, y0),
        turned(x1, y0),
        turned(x1, y1),
        turned(x0, y1),
    ])
}

/// The unit square of so many squares along each edge, of two triangles each.
fn grid(n: u32) -> Shape {
    let at = |i: u32, j: u32| i * (n + 1) + j;
    let place = |i: u32| f64::from(i) / f64::from(n);
    let points = (0..=n).flat_map(|i| (0..=n).map(move |j| turned(place(i), place(j))));
    let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let triangles = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [vec![a, b, c], vec![a, c, d]]
    });
    Shape::Mesh(PolygonMesh {
        positions: points.collect(),
        faces: triangles.collect(),
    })
}

fn reversed(shape: &Shape) -> Shape {
    match *shape {
        Shape::Quad([a, b, c, d]) => Shape::Quad([d, c, b, a]),
        _ => unreachable!("only quads are reversed here"),
    }
}

fn mesh(shapes: Vec<Shape>, cells: u32) -> Mesh {
    let surface = |shape| Surface {
        shape,
        divisions: None,
    };
    let surfaces: Vec<Surface> = shapes.into_iter().map(surface).collect();
    subdivide(&surfaces, Divisions::uniform(cells)).unwrap()
}

/// Of each surface, the area that no other lies on.
fn free_areas(mesh: &Mesh) -> Vec<f64> {
    let surfaces = 1 + mesh
        .faces
        .iter()
        .map(|face| face.surface.index())
        .max()
        .unwrap();
    let mut areas = vec![0.0; surfaces];
    for patch in &mesh.patches {
        let free = mesh.covers.free_part(&mesh.faces, patch);
        let area = free.map_or(patch.area, |parts| parts.iter().map(Polygon::area).sum());
        areas[patch.surface.index()] += area;
    }
    areas
}

fn assert_near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
}

#[test]
fn the_smaller_lies_on_the_larger() {
    let panel = || rectangle([0.2, 0.6], [0.3, 0.5]);
    let wall = || rectangle([0.0, 1.0], [0.0, 1.0]);
    assert_near(&free_areas(&mesh(vec![wall(), panel()], 4)), &[0.92, 0.08]);
    assert_near(&free_areas(&mesh(vec![panel(), wall()], 4)), &[0.08, 0.92]);
}

#[test]
fn it_does_not_matter_how_finely_a_wall_is_cut() {
    let panel = rectangle([0.2, 0.6], [0.3, 0.5]);
    assert_near(&free_areas(&mesh(vec![grid(20), panel], 3)), &[0.92, 0.08]);
}

#[test]
fn the_later_of_two_equal_faces_counts() {
    let wall = || rectangle([0.0, 1.0], [0.0, 1.0]);
    assert_near(&free_areas(&mesh(vec![wall(), wall()], 3)), &[0.0, 1.0]);
    let three = vec![wall(), wall(), wall()];
    assert_near(&free_areas(&mesh(three, 3)), &[0.0, 0.0, 1.0]);
    assert_near(&free_areas(&mesh(vec![grid(3), grid(3)], 1)), &[0.0, 1.0]);
    // The same corners, named in another order.
    let Shape::Quad([a, b, c, d]) = wall() else {
        unreachable!()
    };
    assert_near(
        &free_areas(&mesh(vec![wall(), Shape::Quad([c, d, a, b])], 3)),
        &[0.0, 1.0],
    );
}

/// A lamp in the place of one square of a ceiling, whose edges it shares, before the ceiling and
/// after it.
#[test]
fn what_shares_edges_with_a_mesh_lies_on_it_in_any_order() {
    let third = 1.0 / 3.0;
    let lamp = || rectangle([third, 2.0 * third], [third, 2.0 * third]);
    let [whole, part] = [8.0 / 9.0, 1.0 / 9.0];
    assert_near(&free_areas(&mesh(vec![grid(3), lamp()], 1)), &[whole, part]);
    assert_near(&free_areas(&mesh(vec![lamp(), grid(3)], 1)), &[part, whole]);
}

#[test]
fn huge_and_tiny_faces_have_an_order() {
    for scale in [1e-20, 1e20] {
        let scaled = |shape: Shape| match shape {
            Shape::Quad(corners) => Shape::Quad(corners.map(|corner| scale * corner)),
            _ => unreachable!("only quads are scaled here"),
        };
        let lamp = scaled(rectangle([0.2, 0.6], [0.3, 0.5]));
        let wall = scaled(rectangle([0.0, 1.0], [0.0, 1.0]));
        let areas = free_areas(&mesh(vec![lamp, wall], 1));
        assert!(
            (areas[0] / (scale * scale) - 0.08).abs() < 1e-9,
            "{areas:?}"
        );
    }
}

#[test]
fn what_faces_the_other_way_or_lies_elsewhere_covers_nothing() {
    let wall = rectangle([0.0, 1.0], [0.0, 1.0]);
    let beside = rectangle([1.0, 1.5], [0.0, 1.0]);
    let two_sided = mesh(vec![wall.clone(), reversed(&wall)], 2);
    assert!(two_sided.covers.covered().is_empty());
    assert!(
        mesh(vec![wall.clone(), beside], 2)
            .covers
            .covered()
            .is_empty()
    );
    assert!(mesh(vec![grid(8)], 1).covers.covered().is_empty());
    let Shape::Quad(corners) = rectangle([0.2, 0.4], [0.2, 0.4]) else {
        unreachable!()
    };
    let lifted = Shape::Quad(corners.map(|corner| corner + DVec3::new(0.0, 0.0, 1e-9)));
    assert!(mesh(vec![wall, lifted], 2).covers.covered().is_empty());
}

#[test]
fn rays_meet_what_lies_on_top() {
    let shapes = vec![
        rectangle([0.3, 0.5], [0.3, 0.5]),
        rectangle([0.0, 1.0], [0.0, 1.0]),
        rectangle([0.2, 0.6], [0.2, 0.6]),
    ];
    let mesh = mesh(shapes, 1);
    let occluders = Occluders::new(&mesh);
    let normal = mesh.faces[0].normal;
    for k in 4..37 {
        let place = f64::from(k) / 40.0;
        let ray = Ray::new(
            turned(place, place) + 3.0 * normal,
            DVec3::new(-0.01, 0.02, 0.0) - normal,
        );
        let hit = occluders
            .closest_hit(&ray, 0.0, f64::INFINITY, None)
            .unwrap();
        let at = ray.at(hit.t);
        let is_in = |low: f64, high: f64| {
            let along = [DVec3::new(0.8, 0.48, -0.36), DVec3::new(0.0, 0.6, 0.8)];
            along.iter().all(|axis| {
                let x = axis.dot(at - turned(0.0, 0.0));
                low < x && x < high
            })
        };
        let expected = if is_in(0.3, 0.5) {
            0
        } else if is_in(0.2, 0.6) {
            2
        } else {
            1
        };
        assert_eq!(hit.face.index(), expected, "{place}");
    }
}

proptest! {
    /// Whatever lies on a wall, the wall and all that is on it have the area of the wall.
    #[test]
    fn areas_sum_to_that_of_the_wall(
        places in prop::collection::vec(
            (0.0f64..0.8, 0.0f64..0.8, 0.01f64..0.2, 0.01f64..0.2), 1..6),
        cells in 1u32..5,
    ) {
        let shapes = places.iter().map(|&(x, y, width, height)| {
            rectangle([x, x + width], [y, y + height])
        });
        let wall = rectangle([0.0, 1.0], [0.0, 1.0]);
        let areas = free_areas(&mesh(std::iter::once(wall).chain(shapes).collect(), cells));
        prop_assert!((areas.iter().sum::<f64>() - 1.0).abs() < 1e-8, "{areas:?}");
    }
}
