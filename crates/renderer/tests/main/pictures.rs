//! What pictures show: radiance in the right place, and fronts only.

use crate::light::Light;
use crate::meshes::cut;
use crate::square::{square, two_triangles, view};
use crate::threads::with_threads;
use radiosity_geometry::{Camera, DVec3, Shape};
use radiosity_renderer::{ImageParams, Renderer, Shading};
use std::f32::consts::PI;

#[test]
fn radiance_is_radiosity_over_pi_on_fronts_and_nothing_on_backs() {
    let [a, b, c, d] = square();
    for (corners, expected) in [([a, b, c, d], 2.0 / PI), ([d, c, b, a], 0.0)] {
        let mesh = cut(vec![Shape::Quad(corners)], 3);
        let light = Light::of_radiosity(&[[2.0; 3]; 9]);
        let pictures = view(&mesh, &light.fields(), DVec3::ZERO, 0.5, 4);
        for picture in &pictures {
            let off = |pixel: &[f32; 3]| pixel.iter().any(|x| (x - expected).abs() > 1e-6);
            assert!(!picture.pixels.iter().any(off));
        }
    }
}

#[test]
fn the_picture_is_upright_and_not_mirrored() {
    let [a, b, c, d] = square();
    let mesh = cut(vec![Shape::Quad([a, b, c, d])], 2);
    // Cells in row order: (left, bottom), (left, top), (right, bottom), (right, top).
    let radiosity = [1.0, 2.0, 3.0, 4.0].map(|x| [x * PI; 3]);
    let light = Light::of_radiosity(&radiosity);
    let [picture, _] = view(&mesh, &light.fields(), DVec3::ZERO, 0.9, 40);
    let at = |x: usize, y: usize| picture.pixels[y * 40 + x][0].round();
    assert_eq!(
        [at(5, 5), at(35, 5), at(5, 35), at(35, 35)],
        [2.0, 4.0, 1.0, 3.0]
    );
}

#[test]
fn whatever_lies_before_the_near_distance_is_not_seen() {
    let [a, b, c, d] = square();
    let lid = [a, b, c, d].map(|p| p + 2.0 * DVec3::Z);
    let mesh = cut(vec![Shape::Quad([a, b, c, d]), Shape::Quad(lid)], 1);
    let light = Light::of_radiosity(&[[PI; 3], [5.0 * PI; 3]]);
    let shading = ImageParams::default();
    let renderer = Renderer::new(&mesh, &light.fields(), &shading, &[Shading::Smooth]);
    let look = |near| {
        let from = 10.0 * DVec3::Z;
        let camera = Camera::new(from, DVec3::NEG_Z, DVec3::Y, 2.0, near).unwrap();
        let params = ImageParams {
            width: 1,
            height: 1,
            ..ImageParams::default()
        };
        renderer.render(&camera, &params)[0].pixels[0][0]
    };
    assert!((look(0.0) - 5.0).abs() < 1e-5);
    assert!((look(9.0) - 1.0).abs() < 1e-5);
}

#[test]
fn no_shadings_make_no_pictures() {
    let mesh = cut(two_triangles(), 1);
    let light = Light::of_radiosity(&[[PI; 3]; 2]);
    let params = ImageParams::default();
    let renderer = Renderer::new(&mesh, &light.fields(), &params, &[]);
    let camera = Camera::new(DVec3::Z, DVec3::NEG_Z, DVec3::Y, 30.0, 0.0).unwrap();
    assert!(renderer.render(&camera, &params).is_empty());
}

#[test]
fn thread_counts_leave_no_trace() {
    let mesh = cut(two_triangles(), 4);
    let radiosity: Vec<[f32; 3]> = (0..32).map(|k| [k as f32, 1.0, 0.0]).collect();
    let light = Light::of_radiosity(&radiosity);
    let render = || view(&mesh, &light.fields(), DVec3::ZERO, 1.0, 33);
    assert_eq!(with_threads(1, render), with_threads(3, render));
}
