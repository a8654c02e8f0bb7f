//! Smooth shading: no seams, no blur across edges, nothing of what is hidden.

mod square;

use proptest::prelude::*;
use radiosity_geometry::{
    DVec3, Divisions, Face, Grid, Mesh, PolygonMesh, Shape, Surface, subdivide,
};
use radiosity_renderer::Fields;
use square::{cut, square, two_triangles, view, with_fields};
use std::f32::consts::PI;

/// Smooth values just left and right of many points of a line, by looking at tiny regions.
fn jumps_across(mesh: &Mesh, fields: &Fields<'_>, from: DVec3, to: DVec3) -> f32 {
    let across = (to - from).cross(DVec3::Z).normalize();
    let value = |at: DVec3| view(mesh, fields, at, 1e-11, 1)[1].pixels[0][0];
    let jump = |k: u32| {
        let at = from.lerp(to, (f64::from(k) + 0.37) / 20.0);
        (value(at + 1e-9 * across) - value(at - 1e-9 * across)).abs()
    };
    (0..20).map(jump).fold(0.0, f32::max)
}

/// A millionth of the mean, 20 / pi. Values up to 40 change by at most 40 per cell of size 1/8, so over a
/// distance of 2e-9 by 6e-7 or less, and single precision adds some 1e-6; a seam would show jumps of order 1.
const CONTINUOUS: f32 = 1e-6 * 20.0 / PI;

#[test]
fn no_seam_along_the_diagonal_of_two_triangles() {
    let mesh = cut(two_triangles(), 8);
    let radiosity: Vec<[f32; 3]> = (0..128).map(|k| [(k * k % 41) as f32; 3]).collect();
    let [a, _, c, _] = square();
    let jump = with_fields(&radiosity, |f| jumps_across(&mesh, f, a, c));
    assert!(jump < CONTINUOUS, "{jump}");
    let within = with_fields(&radiosity, |f| {
        jumps_across(
            &mesh,
            f,
            DVec3::new(-0.5, -0.0625, 0.0),
            DVec3::new(0.5, -0.0625, 0.0),
        )
    });
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
        let jump = with_fields(&radiosity, |f| jumps_across(mesh, f, from, to));
        assert!(jump < CONTINUOUS, "{jump}");
    }
}

/// A narrow triangle between a quad and wider triangles, in one mesh: rows of quads and triangles.
fn narrow_between_others() -> Mesh {
    let [a, b, c, d] = [0, 1, 2, 3];
    let below = [[-0.1, -0.62], [0.3, -1.1], [-0.5, -0.9]];
    let below = below.map(|[x, y]| DVec3::new(x, y, 0.0));
    let positions = square().into_iter().chain(below).collect();
    let faces = vec![
        vec![a, b, c, d],
        vec![4, b, a],
        vec![4, 5, b],
        vec![4, a, 6],
    ];
    let surface = Surface {
        shape: Shape::Mesh(PolygonMesh { positions, faces }),
        divisions: Some(Divisions::MaxEdge(0.13)),
    };
    subdivide(&[surface], Divisions::uniform(1)).unwrap()
}

fn patches_of_narrow_face(mesh: &Mesh) -> Vec<usize> {
    let is_narrow = |face: &&Face| matches!(face.grid, Grid::Narrow(_));
    let mut narrow = mesh.faces.iter().filter(is_narrow);
    let patches = narrow.next().map(Face::patches).unwrap().collect();
    assert!(narrow.next().is_none());
    patches
}

#[test]
fn no_seam_in_narrow_triangles_and_around_them() {
    let mesh = narrow_between_others();
    let radiosity: Vec<[f32; 3]> = (0..mesh.patches.len())
        .map(|k| [(k * k % 41) as f32; 3])
        .collect();
    let patches = patches_of_narrow_face(&mesh);
    assert!(patches.len() > 10);
    with_fields(&radiosity, |fields| {
        for &patch in &patches {
            let corners = mesh.patches[patch].polygon.corners();
            for (k, &from) in corners.iter().enumerate() {
                let to = corners[(k + 1) % corners.len()];
                let jump = jumps_across(&mesh, fields, from, to);
                assert!(jump < CONTINUOUS, "{jump} between {from} and {to}");
            }
        }
    });
}

#[test]
fn each_patch_of_a_narrow_triangle_shows_its_own_radiosity() {
    let mesh = narrow_between_others();
    let radiosity: Vec<[f32; 3]> = (0..mesh.patches.len()).map(|k| [k as f32; 3]).collect();
    with_fields(&radiosity, |fields| {
        for patch in patches_of_narrow_face(&mesh) {
            let center = mesh.patches[patch].centroid;
            for corner in mesh.patches[patch].polygon.corners() {
                let at = center.lerp(*corner, 0.95);
                let shown = view(&mesh, fields, at, 1e-11, 1)[0].pixels[0][0] * PI;
                assert!((shown - patch as f32).abs() < 1e-3, "{shown} on {patch}");
            }
        }
    });
}

/// Sharpening must not overshoot: beside a strong gradient it would show negative light.
#[test]
fn smooth_values_stay_between_those_of_the_patches() {
    let mesh = cut(two_triangles(), 8);
    let value = |k: usize| if k % 9 < 2 { 30.0 } else { 1.0 };
    let radiosity: Vec<[f32; 3]> = (0..128).map(|k| [value(k); 3]).collect();
    let smooth = with_fields(&radiosity, |f| view(&mesh, f, DVec3::ZERO, 0.98, 60))[1].clone();
    for pixel in &smooth.pixels {
        let shown = pixel[0] * PI;
        assert!((1.0 - 1e-5..=30.0 + 1e-4).contains(&shown), "{shown}");
    }
}

/// A scene far from the origin, as maps give them, is the same scene.
#[test]
fn shading_does_not_depend_on_where_the_scene_is() {
    let radiosity: Vec<[f32; 3]> = (0..128).map(|k| [(k * k % 41) as f32; 3]).collect();
    let smooth = |shift: DVec3| {
        let moved = |shape| match shape {
            Shape::Triangle(corners) => Shape::Triangle(corners.map(|p| p + shift)),
            _ => unreachable!(),
        };
        let mesh = cut(two_triangles().into_iter().map(moved).collect(), 8);
        with_fields(&radiosity, |f| view(&mesh, f, shift, 0.9, 40))[1].clone()
    };
    let (here, there) = (smooth(DVec3::ZERO), smooth(DVec3::new(1e8, -2e8, 0.0)));
    for (a, b) in here.pixels.iter().zip(&there.pixels) {
        // Coordinates there are rounded to 3e-8, of cells 0.1 wide with steps of up to 40.
        assert!((a[0] - b[0]).abs() < 1e-3, "{} {}", a[0], b[0]);
    }
}

/// A sliver has an angle of nearly nothing at its middle corner, and must not spoil the rest.
#[test]
fn slivers_do_no_harm() {
    let positions = [[0.0, 0.0], [1.0, 0.0], [1.0, 3e-9], [2.0, 0.0], [1.5, 1.0]]
        .map(|[x, y]| DVec3::new(x, y, 0.0))
        .to_vec();
    let faces = vec![vec![0, 1, 2], vec![1, 3, 4]];
    let mesh = cut(vec![Shape::Mesh(PolygonMesh { positions, faces })], 1);
    let center = DVec3::new(1.5, 0.4, 0.0);
    let picture = with_fields(&[[2.0; 3]; 2], |f| view(&mesh, f, center, 0.2, 8))[1].clone();
    for pixel in &picture.pixels {
        assert!((pixel[0] * PI - 2.0).abs() < 1e-5, "{pixel:?}");
    }
}

/// Hidden patches are not seen through their
/// neighbours, on rectangles as on triangles.
#[test]
fn hidden_parts_do_not_darken_what_is_seen() {
    let [a, b, c, d] = square();
    let shapes = [vec![Shape::Quad([a, b, c, d])], two_triangles()];
    for mesh in shapes.map(|shapes| cut(shapes, 6)) {
        let is_inside = |at: DVec3| at.abs().max_element() < 0.17;
        let share = |patch: usize| {
            let polygon = &mesh.patches[patch].polygon;
            let corners = polygon.corners();
            let inside = corners.iter().filter(|corner| is_inside(**corner)).count();
            match (inside, is_inside(mesh.patches[patch].centroid)) {
                (_, true) => 0.0,
                (0, false) => 1.0,
                (_, false) => 0.5,
            }
        };
        let visible: Vec<f32> = (0..mesh.patches.len()).map(share).collect();
        assert!(visible.contains(&0.0) && visible.contains(&1.0));
        let lit = |share: &f32| if *share > 0.0 { 2.0 } else { 0.0 };
        let radiosity: Vec<[f32; 3]> = visible.iter().map(|share| [lit(share); 3]).collect();
        let dark = vec![[0.0; 3]; radiosity.len()];
        let fields = Fields {
            sources: &dark,
            emission: &dark,
            reflectance: &dark,
            shown: &radiosity,
            indirect: &dark,
            direct: &dark,
            direct_gain: &dark,
            gathered_gain: &dark,
            visible: &visible,
        };
        let [_, smooth] = view(&mesh, &fields, DVec3::new(0.33, 0.0, 0.0), 0.28, 20);
        for pixel in &smooth.pixels {
            assert!((pixel[0] * PI - 2.0).abs() < 1e-5, "{pixel:?}");
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
    let fields = Fields {
        sources: &vec![[0.0; 3]; 128],
        emission: &vec![[0.0; 3]; 128],
        reflectance: &reflectance,
        shown: &radiosity,
        indirect: &radiosity,
        direct: &radiosity,
        direct_gain: &reflectance,
        gathered_gain: &reflectance,
        visible: &[1.0; 128],
    };
    let [a, _, c, _] = square();
    let jump = jumps_across(&mesh, &fields, a, c);
    assert!((jump - 8.0 / PI).abs() < 1e-4, "{jump}");
}

/// A mesh of `2 n^2` triangles over the unit square, with vertices moved about and raised by at
/// most `bump`.
fn bumpy(n: u32, bump: f64) -> PolygonMesh {
    let mut positions = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            let noise = |k: u32| f64::from((i * 31 + j * 17 + k * 7) % 13) / 13.0 - 0.5;
            let [x, y] = [i, j].map(|k| f64::from(k) / f64::from(n) - 0.5);
            let inside = if i % n == 0 || j % n == 0 {
                0.0
            } else {
                0.4 / f64::from(n)
            };
            positions.push(DVec3::new(
                x + inside * noise(1),
                y + inside * noise(2),
                bump * noise(3),
            ));
        }
    }
    let at = |i: u32, j: u32| i * (n + 1) + j;
    let mut faces = Vec::new();
    for i in 0..n {
        for j in 0..n {
            faces.push(vec![at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            faces.push(vec![at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    PolygonMesh { positions, faces }
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
        let jump = with_fields(&radiosity, |f| jumps_across(&mesh, f, from, to));
        prop_assert!(jump < CONTINUOUS, "{jump}");
    }

    /// Constant fields stay constant under every interpolant.
    #[test]
    fn constants_are_shown_as_they_are(value in 0.1f32..10.0, n in 1u32..6) {
        let [a, b, c, d] = square();
        let shapes = [vec![Shape::Quad([a, b, c, d])], two_triangles(), vec![Shape::Mesh(bumpy(4, 0.02))]];
        for shape in shapes {
            let mesh = cut(shape, n);
            let radiosity = vec![[value; 3]; mesh.patches.len()];
            let pictures = with_fields(&radiosity, |f| view(&mesh, f, DVec3::ZERO, 0.6, 8));
            for pixel in &pictures[1].pixels {
                prop_assert!((pixel[0] * PI / value - 1.0).abs() < 1e-5);
            }
        }
    }
}
