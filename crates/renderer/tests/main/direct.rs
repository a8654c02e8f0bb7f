//! Direct light at points: closed forms, shadows, and what samples say.

use crate::closed_forms::corner_factor;
use crate::light::{Light, one_sample};
use crate::meshes::{cut_each, floor, quad};
use proptest::prelude::*;
use radiosity_geometry::{Camera, DVec3, FaceId, Mesh, Occluders, Polygon, Shape};
use radiosity_renderer::{ImageParams, Renderer, Shading};
use std::f64::consts::PI;

const EXITANCE: f32 = 3.0;
const REFLECTANCE: f32 = 0.8;

/// A lamp of size 2 x 1 at height 2 that shines down.
fn lamp() -> Shape {
    quad([
        [-1.0, -0.5, 2.0],
        [-1.0, 0.5, 2.0],
        [1.0, 0.5, 2.0],
        [1.0, -0.5, 2.0],
    ])
}

/// The first shape is cut into patches of its own, the second shines, the others stand about.
fn room(shapes: Vec<Shape>) -> Mesh {
    let divisions = [3].into_iter().chain(std::iter::repeat(1));
    cut_each(shapes.into_iter().zip(divisions))
}

/// The radiosity shown at a point of the first shape, which is seen along a direction.
fn shown(mesh: &Mesh, at: DVec3, from: DVec3) -> f64 {
    let patches = mesh.patches.len();
    let is_lamp = |patch: usize| mesh.patches[patch].face == FaceId(1);
    let emission = |patch| [if is_lamp(patch) { EXITANCE } else { 0.0 }; 3];
    let emission: Vec<[f32; 3]> = (0..patches).map(emission).collect();
    let reflectance = vec![[REFLECTANCE, 0.5 * REFLECTANCE, 0.0]; patches];
    // Nothing is reflected more than once.
    let light = Light {
        sources: emission.clone(),
        shown: emission.clone(),
        emission,
        direct_gain: reflectance.clone(),
        gathered_gain: reflectance.clone(),
        reflectance,
        ..Light::none(patches)
    };
    let eye = at + 0.01 * from.normalize();
    let camera = Camera::new(eye, at - eye, DVec3::new(0.3, 0.2, 0.1), 1e-6, 0.0).unwrap();
    let renderer = Renderer::new(
        mesh,
        &light.fields(),
        &ImageParams::default(),
        &[Shading::Exact],
    );
    let image = &renderer.render(&camera, &one_sample(1))[0];
    let [red, green, blue] = image.pixels[0].map(|radiance| f64::from(radiance) * PI);
    assert!((green - 0.5 * red).abs() < 1e-6 && blue == 0.0);
    red
}

fn expected(factor: f64) -> f64 {
    f64::from(REFLECTANCE) * f64::from(EXITANCE) * factor
}

/// Single precision, and where the ray comes to.
const ROUNDING: f64 = 1e-6;

#[test]
fn without_anything_in_the_way_it_has_its_closed_form() {
    let mesh = room(vec![floor(), lamp()]);
    let middle = 4.0 * corner_factor(1.0, 0.5, 2.0);
    let beside = 2.0 * (corner_factor(3.0, 0.5, 2.0) - corner_factor(1.0, 0.5, 2.0));
    for (x, factor) in [(0.0, middle), (2.0, beside)] {
        let found = shown(&mesh, DVec3::new(x, 0.0, 0.0), DVec3::Z);
        assert!((found - expected(factor)).abs() < ROUNDING, "{found}");
    }
}

/// A plate over half of the lamp, whichever side it turns to it; one that stands behind the lamp or
/// under the floor is in nobody's way.
#[test]
fn half_a_lamp_gives_half_the_light() {
    let half = [
        [0.0, -3.0, 1.0],
        [3.0, -3.0, 1.0],
        [3.0, 3.0, 1.0],
        [0.0, 3.0, 1.0],
    ];
    let moved = |height: f64| half.map(|[x, y, z]| [x, y, z + height]);
    let [a, b, c, d] = half;
    let whole = 4.0 * corner_factor(1.0, 0.5, 2.0);
    for (plate, share) in [
        (half, 0.5),
        ([d, c, b, a], 0.5),
        (moved(1.0 + 1e-6), 1.0),
        (moved(-1.5), 1.0),
    ] {
        let mesh = room(vec![floor(), lamp(), quad(plate)]);
        let found = shown(&mesh, DVec3::ZERO, DVec3::new(-0.2, 0.1, 1.0));
        assert!(
            (found - share * expected(whole)).abs() < ROUNDING,
            "{found} {share}"
        );
    }
}

/// Two plates whose shadows overlap hide what both hide, once.
#[test]
fn shadows_are_counted_once() {
    let plate = |x: f64, height: f64| {
        let [near, far] = [-3.0, 3.0];
        quad([
            [x, near, height],
            [x + 9.0, near, height],
            [x + 9.0, far, height],
            [x, far, height],
        ])
    };
    // Seen from the origin, the first hides the lamp from x = 0 on, the second from x = 0.5 on.
    let mesh = room(vec![floor(), lamp(), plate(0.0, 1.0), plate(0.375, 1.5)]);
    let found = shown(&mesh, DVec3::ZERO, DVec3::new(-0.3, 0.1, 1.0));
    let whole = 4.0 * corner_factor(1.0, 0.5, 2.0);
    assert!((found - 0.5 * expected(whole)).abs() < ROUNDING, "{found}");
}

/// Blockers with a corner in the lamp's plane, on either side of it, block as those that are a
/// little higher or lower do.
#[test]
fn corners_in_the_plane_of_the_lamp_do_no_harm() {
    let shadow = |height: f64| {
        let triangle = Shape::Triangle([
            DVec3::new(0.1, -0.3, height),
            DVec3::new(0.9, 0.4, 1.0),
            DVec3::new(0.2, 0.9, 2.7),
        ]);
        let mesh = room(vec![floor(), lamp(), triangle]);
        shown(
            &mesh,
            DVec3::new(0.1, 0.2, 0.0),
            DVec3::new(-0.3, -0.1, 1.0),
        )
    };
    let whole = shown(
        &room(vec![floor(), lamp()]),
        DVec3::new(0.1, 0.2, 0.0),
        DVec3::Z,
    );
    let expected = shadow(2.0 - 1e-7);
    assert!(expected < 0.99 * whole);
    for height in [2.0, 2.0 + 1e-7, 2.0 + 1e-15, 2.0 - 1e-15] {
        let found = shadow(height);
        assert!(
            (found - expected).abs() < ROUNDING,
            "{height} {found} {expected}"
        );
    }
}

/// Behind more faces than are cut out, points tell: of 64 samples with 8 each, half are seen; their
/// share scatters by 1/32 at most, and the pixel's means are stratified.
#[test]
fn behind_many_faces_samples_are_taken() {
    let strip = |k: u32| {
        let [x, next] = [k, k + 1].map(|k| 3.0 * f64::from(k) / 100.0);
        let at = |x: f64, y: f64| DVec3::new(x, y, 1.0);
        Shape::Quad([at(x, -3.0), at(next, -3.0), at(next, 3.0), at(x, 3.0)])
    };
    let mut shapes = vec![floor(), lamp()];
    shapes.extend((0..100).map(strip));
    let mesh = room(shapes);
    let places = (0..64).map(|k| 1e-4 * DVec3::new(f64::from(k % 8), f64::from(k / 8), 0.0));
    let mean = places.map(|at| shown(&mesh, at, DVec3::Z)).sum::<f64>() / 64.0;
    let half = 0.5 * expected(4.0 * corner_factor(1.0, 0.5, 2.0));
    assert!((mean - half).abs() < 4.0 / 32.0 * half, "{mean} {half}");
}

/// A wall whose horizon cuts the lamp sees the part before it alone.
#[test]
fn horizons_cut_lamps() {
    let wall = |x: f64| quad([[x, -3.0, 0.0], [x, 3.0, 0.0], [x, 3.0, 1.9], [x, -3.0, 1.9]]);
    let at = |x: f64| DVec3::new(x, 0.0, 1.0);
    let through = shown(&room(vec![wall(0.0), lamp()]), at(0.0), DVec3::X);
    let right = quad([
        [0.0, -0.5, 2.0],
        [0.0, 0.5, 2.0],
        [1.0, 0.5, 2.0],
        [1.0, -0.5, 2.0],
    ]);
    let beside = shown(&room(vec![wall(0.0), right]), at(0.0), DVec3::X);
    assert!(
        through > 0.1 && (through - beside).abs() < ROUNDING,
        "{through} {beside}"
    );
    assert!(shown(&room(vec![wall(1.5), lamp()]), at(1.5), DVec3::X) < ROUNDING);
}

/// Along each edge of the lamp.
const STEPS: u32 = 200;

/// The irradiance over the exitance by the midpoint rule, with segments for visibility.
fn sampled(mesh: &Mesh, at: DVec3) -> f64 {
    let occluders = Occluders::new(mesh);
    let lamp: &Polygon = &mesh.faces[1].polygon;
    let (normal, lamp_normal) = (mesh.faces[0].normal, mesh.faces[1].normal);
    let mut sum = 0.0;
    for k in 0..STEPS * STEPS {
        let on_lamp = |k: u32| (f64::from(k) + 0.5) / f64::from(STEPS);
        let point = lamp.bilinear(on_lamp(k / STEPS), on_lamp(k % STEPS));
        let to = point - at;
        let cosines = normal.dot(to).max(0.0) * (-lamp_normal.dot(to)).max(0.0);
        if cosines > 0.0 && !occluders.blocked(FaceId(0), at, FaceId(1), point) {
            sum += cosines / (PI * to.length_squared().powi(2));
        }
    }
    sum * lamp.area() / f64::from(STEPS * STEPS)
}

fn coordinate() -> impl Strategy<Value = f64> {
    -1.5f64..1.5
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Triangles anywhere between and around. Where a shadow's edge crosses a row of samples, it is
    /// misplaced by half a step at most: twice for each of three triangles. The integrand is
    /// nowhere more than twice its mean.
    #[test]
    fn shadows_are_those_of_samples(
        triangles in prop::collection::vec(
            prop::array::uniform3((coordinate(), coordinate(), 0.1f64..2.5)), 0..4),
        x in coordinate(), y in coordinate(),
    ) {
        let corners = |triangle: &[(f64, f64, f64); 3]| triangle.map(DVec3::from);
        let is_large = |triangle: &[(f64, f64, f64); 3]| {
            let [a, b, c] = corners(triangle);
            (b - a).cross(c - a).length() > 1e-2
        };
        prop_assume!(triangles.iter().all(is_large));
        let mut shapes = vec![floor(), lamp()];
        shapes.extend(triangles.iter().map(|triangle| Shape::Triangle(corners(triangle))));
        let mesh = room(shapes);
        let at = DVec3::new(x, y, 0.0);
        let found = shown(&mesh, at, DVec3::Z);
        let whole = sampled(&room(vec![floor(), lamp()]), at);
        let bound = 2.0 * whole * 3.0 * 2.0 * 0.5 / f64::from(STEPS);
        prop_assert!((found - expected(sampled(&mesh, at))).abs() < expected(bound), "{found}");
    }
}
