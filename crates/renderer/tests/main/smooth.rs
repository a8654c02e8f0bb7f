//! Smooth shading shows what patches have, and nothing of what is hidden.

use crate::light::Light;
use crate::meshes::{bumpy, cut, narrow_between_others, patches_of_narrow_face};
use crate::square::{square, two_triangles, view};
use proptest::prelude::*;
use radiosity_geometry::{DVec3, PolygonMesh, Shape};
use std::f32::consts::PI;

#[test]
fn each_patch_of_a_narrow_triangle_shows_its_own_radiosity() {
    let mesh = narrow_between_others();
    let radiosity: Vec<[f32; 3]> = (0..mesh.patches.len()).map(|k| [k as f32; 3]).collect();
    let light = Light::of_radiosity(&radiosity);
    for patch in patches_of_narrow_face(&mesh) {
        let center = mesh.patches[patch].centroid;
        for corner in mesh.patches[patch].polygon.corners() {
            let at = center.lerp(*corner, 0.95);
            let [constant, _] = view(&mesh, &light.fields(), at, 1e-11, 1);
            let shown = constant.pixels[0][0] * PI;
            assert!((shown - patch as f32).abs() < 1e-3, "{shown} on {patch}");
        }
    }
}

/// Sharpening must not overshoot: beside a strong gradient it would show negative light.
#[test]
fn smooth_values_stay_between_those_of_the_patches() {
    let mesh = cut(two_triangles(), 8);
    let value = |k: usize| if k % 9 < 2 { 30.0 } else { 1.0 };
    let radiosity: Vec<[f32; 3]> = (0..128).map(|k| [value(k); 3]).collect();
    let light = Light::of_radiosity(&radiosity);
    let [_, smooth] = view(&mesh, &light.fields(), DVec3::ZERO, 0.98, 60);
    for pixel in &smooth.pixels {
        let shown = pixel[0] * PI;
        assert!((1.0 - 1e-5..=30.0 + 1e-4).contains(&shown), "{shown}");
    }
}

/// A scene far from the origin, as maps give them, is the same scene.
#[test]
fn shading_does_not_depend_on_where_the_scene_is() {
    let radiosity: Vec<[f32; 3]> = (0..128).map(|k| [(k * k % 41) as f32; 3]).collect();
    let light = Light::of_radiosity(&radiosity);
    let smooth = |shift: DVec3| {
        let moved = |shape| match shape {
            Shape::Triangle(corners) => Shape::Triangle(corners.map(|p| p + shift)),
            _ => unreachable!(),
        };
        let mesh = cut(two_triangles().into_iter().map(moved).collect(), 8);
        let [_, smooth] = view(&mesh, &light.fields(), shift, 0.9, 40);
        smooth
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
    let light = Light::of_radiosity(&[[2.0; 3]; 2]);
    let [_, picture] = view(&mesh, &light.fields(), center, 0.2, 8);
    for pixel in &picture.pixels {
        assert!((pixel[0] * PI - 2.0).abs() < 1e-5, "{pixel:?}");
    }
}

/// Hidden patches are not seen through their neighbours, on rectangles as on triangles.
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
        let light = Light {
            visible,
            ..Light::of_radiosity(&radiosity)
        };
        let [_, smooth] = view(&mesh, &light.fields(), DVec3::new(0.33, 0.0, 0.0), 0.28, 20);
        for pixel in &smooth.pixels {
            assert!((pixel[0] * PI - 2.0).abs() < 1e-5, "{pixel:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    /// Constant fields stay constant under every interpolant.
    #[test]
    fn constants_are_shown_as_they_are(value in 0.1f32..10.0, n in 1u32..6) {
        let [a, b, c, d] = square();
        let (quad, mesh) = (Shape::Quad([a, b, c, d]), Shape::Mesh(bumpy(4, 0.02)));
        let shapes = [vec![quad], two_triangles(), vec![mesh]];
        for shape in shapes {
            let mesh = cut(shape, n);
            let radiosity = vec![[value; 3]; mesh.patches.len()];
            let light = Light::of_radiosity(&radiosity);
            let [_, smooth] = view(&mesh, &light.fields(), DVec3::ZERO, 0.6, 8);
            for pixel in &smooth.pixels {
                prop_assert!((pixel[0] * PI / value - 1.0).abs() < 1e-5);
            }
        }
    }
}
