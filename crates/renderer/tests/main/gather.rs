//! Light that is gathered at samples: closed forms.

use crate::closed_forms::corner_factor;
use crate::light::{Light, one_sample};
use crate::meshes::{cut, floor, quad};
use crate::threads::with_threads;
use radiosity_geometry::{Camera, DVec3, FaceId, Mesh, Shape};
use radiosity_renderer::{ImageParams, Renderer, Shading};
use std::f32::consts::PI;

/// A unit cube whose faces look inwards.
fn cube() -> Vec<Shape> {
    let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let around = [a, b, c, d];
    let at = |z: f64| around.map(|[x, y]| [x, y, z]);
    let [floor, mut ceiling] = [at(0.0), at(1.0)];
    ceiling.reverse();
    let wall = |k: usize| {
        let ([x, y], [u, v]) = (around[k], around[(k + 1) % 4]);
        [[x, y, 0.0], [x, y, 1.0], [u, v, 1.0], [u, v, 0.0]]
    };
    let walls = (0..4).map(wall);
    [floor, ceiling]
        .into_iter()
        .chain(walls)
        .map(quad)
        .collect()
}

/// The radiance that a camera sees in its middle.
fn seen(mesh: &Mesh, light: &Light, camera: &Camera, directions: u32) -> [f32; 3] {
    let shading = ImageParams {
        directions,
        ..ImageParams::default()
    };
    let renderer = Renderer::new(mesh, &light.fields(), &shading, &[Shading::Gathered]);
    renderer.render(camera, &one_sample(1))[0].pixels[0]
}

fn camera(position: [f64; 3], direction: [f64; 3]) -> Camera {
    let up = DVec3::new(0.1, 0.2, 0.3);
    Camera::new(position.into(), direction.into(), up, 1.0, 0.0).unwrap()
}

/// Where everything emits and reflects the same, all radiosities are `E / (1 - rho)`, and every
/// direction finds the same: there is no noise.
#[test]
fn a_furnace_is_evenly_bright() {
    let mesh = cut(cube(), 2);
    let patches = mesh.patches.len();
    let (e, rho) = (2.0f32, 0.75f32);
    let of_all = |value: f32| vec![[value; 3]; patches];
    let light = Light {
        sources: of_all(e),
        reflectance: of_all(rho),
        indirect: of_all(e / (1.0 - rho) - e - rho * e),
        shown: of_all(e / (1.0 - rho)),
        emission: of_all(e),
        direct: of_all(rho * e),
        direct_gain: of_all(rho),
        gathered_gain: of_all(rho),
        visible: vec![1.0; patches],
    };
    for direction in [[0.2, 0.1, -1.0], [1.0, 0.3, 0.4], [-0.1, 1.0, -0.5]] {
        let found = seen(&mesh, &light, &camera([0.4, 0.5, 0.6], direction), 3);
        for channel in found {
            // Form factors to the six faces sum to 1 but for rounding.
            assert!(
                (channel * PI / (e / (1.0 - rho)) - 1.0).abs() < 1e-5,
                "{channel}"
            );
        }
    }
}

/// Under a square that reflects what was reflected before, in a dark room: the irradiance is its
/// form factor times that, and half of it where a lid covers half of the view. Its gain is apart
/// from that of direct light.
#[test]
fn what_is_gathered_has_its_form_factor() {
    let square = |z: f64, right: f64| {
        quad([
            [-1.0, -1.0, z],
            [-1.0, 1.0, z],
            [right, 1.0, z],
            [right, -1.0, z],
        ])
    };
    let factor = 4.0 * corner_factor(1.0, 1.0, 1.0);
    let lid = [
        [-9.0, -9.0, 0.5],
        [-9.0, 9.0, 0.5],
        [0.0, 9.0, 0.5],
        [0.0, -9.0, 0.5],
    ];
    for (others, share) in [(vec![], 1.0), (vec![quad(lid)], 0.5)] {
        let shapes = [vec![floor(), square(1.0, 1.0)], others].concat();
        let mesh = cut(shapes, 1);
        let patches = mesh.patches.len();
        let glows = |patch: usize| mesh.patches[patch].face == FaceId(1);
        let indirect = |patch| {
            if glows(patch) {
                [3.0, 2.0, 1.0]
            } else {
                [0.0; 3]
            }
        };
        let indirect: Vec<[f32; 3]> = (0..patches).map(indirect).collect();
        let light = Light {
            reflectance: vec![[0.5; 3]; patches],
            shown: indirect.clone(),
            indirect,
            direct_gain: vec![[9.0; 3]; patches],
            gathered_gain: vec![[0.8; 3]; patches],
            ..Light::none(patches)
        };
        let from = camera([0.0, 0.0, 0.01], [0.0, 0.0, -1.0]);
        let found = seen(&mesh, &light, &from, 4096);
        for (c, exitance) in [3.0, 2.0, 1.0].into_iter().enumerate() {
            let expected = 0.8 * exitance * share * factor;
            let found = f64::from(found[c]) * std::f64::consts::PI;
            // Of 4,096 directions, each in a cell of its own, those in the 4 x 64 cells along the
            // border of the square are left to chance, by half a direction each: 8 of 2,200
            // together.
            assert!(
                (found / expected - 1.0).abs() < 4.0 * 8.0 / 2200.0,
                "{found} {expected}"
            );
        }
    }
}

/// Gathered light, too, is the same for any number of threads.
#[test]
fn thread_counts_leave_no_trace() {
    let mesh = cut(cube(), 3);
    let patches = mesh.patches.len();
    let varied = |k: usize| [k as f32 % 7.0, 1.0, 0.5 + k as f32 % 3.0];
    let values: Vec<[f32; 3]> = (0..patches).map(varied).collect();
    let half = vec![[0.5; 3]; patches];
    let light = Light {
        reflectance: half.clone(),
        indirect: values.clone(),
        shown: values,
        direct_gain: half.clone(),
        gathered_gain: half,
        ..Light::none(patches)
    };
    let params = ImageParams {
        width: 33,
        height: 20,
        ..ImageParams::default()
    };
    let shading = ImageParams::default();
    let position = DVec3::new(0.3, 0.4, 0.5);
    let direction = DVec3::new(0.5, 0.4, -0.3);
    let wide = Camera::new(position, direction, DVec3::Z, 90.0, 0.0).unwrap();
    let render = || {
        let renderer = Renderer::new(&mesh, &light.fields(), &shading, &[Shading::Gathered]);
        renderer.render(&wide, &params)
    };
    let one = with_threads(1, render);
    assert!(one == with_threads(3, render));
    assert!(one[0].shows_something());
}
