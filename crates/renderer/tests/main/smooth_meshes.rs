//! Direct light on meshes that stand for smooth surfaces.

use crate::light::{Light, one_sample};
use crate::meshes::{cut_each, quad};
use radiosity_geometry::{Camera, DVec3, Mesh, Occluders, Ray, Shape};
use radiosity_renderer::{ImageParams, Renderer, Shading};
use radiosity_test_kit::icosphere;
use std::f64::consts::PI;

const EXITANCE: f32 = 1e4;
const LAMP: f64 = 0.1;
const DISTANCE: f64 = 10.0;

/// A sphere of 320 triangles and radius 1, and a small lamp far above it.
fn sphere_under_lamp() -> Mesh {
    let lamp = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
    let lamp = lamp.map(|[x, y]| [0.5 * LAMP * x, 0.5 * LAMP * y, DISTANCE]);
    cut_each([(Shape::Mesh(icosphere(2)), 1), (quad(lamp), 1)].into_iter())
}

/// The irradiance that is shown in some directions from the middle of the sphere.
fn shown(mesh: &Mesh, crease_angle: f64, directions: &[DVec3]) -> Vec<f64> {
    let patches = mesh.patches.len();
    let is_lamp = |patch: usize| patch + 1 == patches;
    let emission = (0..patches).map(|patch| [if is_lamp(patch) { EXITANCE } else { 0.0 }; 3]);
    let emission: Vec<[f32; 3]> = emission.collect();
    let light = Light {
        sources: emission.clone(),
        shown: emission.clone(),
        emission,
        direct_gain: vec![[1.0; 3]; patches],
        ..Light::none(patches)
    };
    let params = ImageParams {
        crease_angle,
        ..one_sample(1)
    };
    let renderer = Renderer::new(mesh, &light.fields(), &params, &[Shading::Exact]);
    let occluders = Occluders::new(mesh);
    let at = |direction: &DVec3| {
        let hit = occluders.closest_hit(&Ray::new(2.0 * *direction, -*direction), 0.0, 2.0, None);
        let eye = (2.0 - hit.unwrap().t + 1e-3) * *direction;
        let camera = Camera::new(eye, -*direction, DVec3::Y, 1e-6, 0.0).unwrap();
        let image = &renderer.render(&camera, &params)[0];
        f64::from(image.pixels[0][1]) * PI
    };
    directions.iter().map(at).collect()
}

/// Directions around the sphere, at some angles from the lamp's.
fn around(angles: std::ops::Range<u32>) -> Vec<(f64, DVec3)> {
    let turned = |degrees: u32| {
        let (angle, turn) = (f64::from(degrees).to_radians(), f64::from(7 * degrees));
        let side = DVec3::new(turn.cos(), turn.sin(), 0.0);
        (angle, angle.cos() * DVec3::Z + angle.sin() * side)
    };
    angles.map(turned).collect()
}

/// `M A cos / (pi r^2)` on the sphere itself, from a lamp that is seen whole; the largest
/// difference from what is shown, as a share of what is brightest.
fn worst_error(mesh: &Mesh, crease_angle: f64) -> f64 {
    let points = around(0..80);
    let directions: Vec<DVec3> = points.iter().map(|(_, direction)| *direction).collect();
    let power = f64::from(EXITANCE) * LAMP * LAMP / PI;
    let brightest = power / (DISTANCE - 1.0).powi(2);
    let expected = directions.iter().map(|at| {
        let to = DISTANCE * DVec3::Z - *at;
        power * to.normalize().dot(*at) * to.normalize().z / to.length_squared()
    });
    let found = shown(mesh, crease_angle, &directions);
    let errors = found
        .iter()
        .zip(expected)
        .map(|(found, e)| (found - e).abs());
    errors.fold(0.0, f64::max) / brightest
}

/// Facets turn up to nine degrees from the sphere, which is 15 % of the light at its side;
/// interpolated normals are off by the square of that in radians, 2 %, at most.
#[test]
fn spheres_of_triangles_are_lit_like_spheres() {
    let mesh = sphere_under_lamp();
    let [smooth, flat] = [30.0, 0.0].map(|crease_angle| worst_error(&mesh, crease_angle));
    println!("smooth {smooth:.4}, flat {flat:.4}");
    assert!(smooth < 0.02, "{smooth}");
    assert!(flat > 0.08, "{flat}");
}

/// Where light grazes the sphere it fades, without a facet in its own shadow, and ends at the
/// horizon.
#[test]
fn light_fades_towards_the_horizon() {
    let mesh = sphere_under_lamp();
    let found = |angles| {
        let points = around(angles);
        let directions: Vec<DVec3> = points.iter().map(|(_, direction)| *direction).collect();
        shown(&mesh, 30.0, &directions)
    };
    // The lamp's horizon is where cos = 1 / DISTANCE, at 84 degrees.
    assert!(found(60..80).iter().all(|light| *light > 0.0));
    assert!(found(90..180).iter().all(|light| *light == 0.0));
}

/// Facets that differ by more than the crease angle stay flat.
#[test]
fn edges_above_the_crease_angle_stay() {
    let mesh = sphere_under_lamp();
    // Neighbouring facets of the sphere differ by 15 to 18 degrees.
    let directions: Vec<DVec3> = around(10..60).iter().map(|(_, at)| *at).collect();
    assert_eq!(
        shown(&mesh, 0.0, &directions),
        shown(&mesh, 5.0, &directions)
    );
    assert_ne!(
        shown(&mesh, 0.0, &directions),
        shown(&mesh, 30.0, &directions)
    );
}
