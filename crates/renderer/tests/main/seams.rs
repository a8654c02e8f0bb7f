//! Smooth shading is continuous within a surface, and across materials it is not.

use crate::light::Light;
use crate::meshes::{bumpy, cut, narrow_between_others, patches_of_narrow_face};
use crate::square::{square, two_triangles, view};
use proptest::prelude::*;
use radiosity_geometry::{DVec3, Divisions, Mesh, PolygonMesh, Shape, Surface, subdivide};
use std::f32::consts::PI;

/// Smooth values just left and right of many points of a line, by looking at tiny regions.
fn jumps_across(mesh: &Mesh, light: &Light, from: DVec3, to: DVec3) -> f32 {
    let across = (to - from).cross(DVec3::Z).normalize();
    let value = |at: DVec3| view(mesh, &light.fields(), at, 1e-11, 1)[1].pixels[0][0];
    let jump = |k: u32| {
        let at = from.lerp(to, (f64::from(k) + 0.37) / 20.0);
        (value(at + 1e-9 * across) - value(at - 1e-9 * across)).abs()
    };
    (0..20).map(jump).fold(0.0, f32::max)
}

/// A millionth of the mean, 20 / pi. Values up to 40 change by at most 40 per cell of size 1/8, so
/// over a distance of 2e-9 by 6e-7 or less, and single precision adds some 1e-6; a seam would show
/// jumps of order 1.
const CONTINUOUS: f32 = 1e-6 * 20.0 / PI;

#[test]
fn no_seam_along_the_diagonal_of_two_triangles() {
    let mesh = cut(two_triangles(), 8);
    let radiosity: Vec<[f32; 3]> = (0..128).map(|k| [(k * k % 41) as f32; 3]).collect();
    let [a, _, c, _] = square();
    let light = Light::of_radiosity(&radiosity);
    let jump = jumps_across(&mesh, &light, a, c);
    assert!(jump < CONTINUOUS, "{jump}");
    let [from, to] = [-0.5, 0.5].map(|x| DVec3::new(x, -0.0625, 0.0));
    let within = jumps_across(&mesh, &light, from, to);
    assert!(within < CONTINUOUS, "{within}");
}

/// Faces of one mesh, cut into different numbers of patches along the edges they share.
#[test]
fn no_seam_where_neighbours_are_cut_differently() {
    let [a, b, c, d] = [0, 1, 2, 3];
    let corners = square().into_iter();
    let beside = [[1.2, 0.0], [0.5, -1.4], [1.5, -0.5], [1.5, 0.5]];
    let beside = beside.map(|[x, y]| DVec3::new(x, y, 0.0));
    let mesh = |faces: Vec<Vec<u32>>, divisions| {
        let positions = corners.clone().chain(beside).collect();
        let shape = Shape::Mesh(PolygonMesh { positions, faces });
        let surface = Surface {
            shape,
            divisions: Some(divisions),
        };
        subdivide(&[surface], Divisions::uniform(1)).unwrap()
    };
    // Four cells on the quad and eight on the triangle below it; six on the one quad and four
    // on the other.
    let by_length = mesh(
        vec![vec![a, b, c, d], vec![b, 4, c], vec![a, 5, b]],
        Divisions::MaxEdge(0.26),
    );
    let by_count = mesh(
        vec![vec![a, b, c, d], vec![c, b, 6, 7]],
        Divisions::Count { a: 4, b: 6 },
    );
    let [a, b, c, _] = square();
    for (mesh, from, to) in [(&by_length, a, b), (&by_length, b, c), (&by_count, b, c)] {
        let value = |k: usize| [(k * k % 41) as f32; 3];
        let radiosity: Vec<[f32; 3]> = (0..mesh.patches.len()).map(value).collect();
        let jump = jumps_across(mesh, &Light::of_radiosity(&radiosity), from, to);
        assert!(jump < CONTINUOUS, "{jump}");
    }
}

#[test]
fn no_seam_in_narrow_triangles_and_around_them() {
    let mesh = narrow_between_others();
    let radiosity: Vec<[f32; 3]> = (0..mesh.patches.len())
        .map(|k| [(k * k % 41) as f32; 3])
        .collect();
    let patches = patches_of_narrow_face(&mesh);
    assert!(patches.len() > 10);
    let light = Light::of_radiosity(&radiosity);
    for patch in patches {
        let corners = mesh.patches[patch].polygon.corners();
        for (k, &from) in corners.iter().enumerate() {
            let to = corners[(k + 1) % corners.len()];
            let jump = jumps_across(&mesh, &light, from, to);
            assert!(jump < CONTINUOUS, "{jump} between {from} and {to}");
        }
    }
}

#[test]
fn materials_and_creases_keep_their_edges() {
    let mesh = cut(two_triangles(), 8);
    let radiosity: Vec<[f32; 3]> = (0..128)
        .map(|k| [if k < 64 { 1.0 } else { 9.0 }; 3])
        .collect();
    let reflectance: Vec<[f32; 3]> = (0..128)
        .map(|k| [if k < 64 { 0.2 } else { 0.9 }; 3])
        .collect();
    let light = Light {
        reflectance,
        ..Light::of_radiosity(&radiosity)
    };
    let [a, _, c, _] = square();
    let jump = jumps_across(&mesh, &light, a, c);
    assert!((jump - 8.0 / PI).abs() < 1e-4, "{jump}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    /// Looking at two points 2e-7 apart anywhere on a smooth mesh never shows a jump.
    #[test]
    fn meshes_have_no_seams(x in -0.45f64..0.45, y in -0.45f64..0.45, angle in 0.0f64..6.3) {
        let mesh = cut(vec![Shape::Mesh(bumpy(5, 0.01))], 1);
        let radiosity: Vec<[f32; 3]> =
            mesh.faces.iter().map(|f| [(f.input_index * 7 % 41) as f32; 3]).collect();
        let from = DVec3::new(x, y, 0.0);
        let to = from + 0.1 * DVec3::new(angle.cos(), angle.sin(), 0.0);
        let jump = jumps_across(&mesh, &Light::of_radiosity(&radiosity), from, to);
        prop_assert!(jump < CONTINUOUS, "{jump}");
    }
}
