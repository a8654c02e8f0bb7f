//! Light that is gathered at samples: closed forms.

use radiosity_geometry::{Camera, DVec3, Divisions, FaceId, Mesh, Shape, Surface, subdivide};
use radiosity_renderer::{Fields, ImageParams, Renderer, Shading, ShadingParams};
use std::f32::consts::PI;

fn quad(corners: [[f64; 3]; 4]) -> Shape {
    Shape::Quad(corners.map(DVec3::from))
}

fn cut(shapes: Vec<Shape>, divisions: u32) -> Mesh {
    let surface = |shape| Surface {
        shape,
        divisions: None,
    };
    let surfaces: Vec<Surface> = shapes.into_iter().map(surface).collect();
    subdivide(&surfaces, Divisions::uniform(divisions)).unwrap()
}

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
fn seen(mesh: &Mesh, fields: &Fields<'_>, camera: &Camera, directions: u32) -> [f32; 3] {
    let params = ImageParams {
        width: 1,
        height: 1,
        subpixels: 1,
        samples: 1,
        ..ImageParams::default()
    };
    let shading = ShadingParams {
        directions,
        ..ShadingParams::default()
    };
    let renderer = Renderer::new(mesh, fields, &shading, &[Shading::Gathered]);
    renderer.render(camera, &params, &|_| ())[0].pixels[0]
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
    let fields = Fields {
        sources: &of_all(e),
        reflectance: &of_all(rho),
        indirect: &of_all(e / (1.0 - rho) - e - rho * e),
        visible: &vec![1.0; patches],
        shown: &of_all(e / (1.0 - rho)),
        emission: &of_all(e),
        direct: &of_all(rho * e),
        direct_gain: &of_all(rho),
        gathered_gain: &of_all(rho),
    };
    for direction in [[0.2, 0.1, -1.0], [1.0, 0.3, 0.4], [-0.1, 1.0, -0.5]] {
        let found = seen(&mesh, &fields, &camera([0.4, 0.5, 0.6], direction), 3);
        for channel in found {
            // Form factors to the six faces sum to 1 but for rounding.
            assert!(
                (channel * PI / (e / (1.0 - rho)) - 1.0).abs() < 1e-5,
                "{channel}"
            );
        }
    }
}

/// Under a square that reflects what was reflected before, in a dark room: the irradiance is its form
/// factor times that, and half of it where a lid covers half of the view. Its gain is apart from that
/// of direct light.
#[test]
fn what_is_gathered_has_its_form_factor() {
    let floor = quad([
        [-4.0, -4.0, 0.0],
        [4.0, -4.0, 0.0],
        [4.0, 4.0, 0.0],
        [-4.0, 4.0, 0.0],
    ]);
    let square = |z: f64, right: f64| {
        quad([
            [-1.0, -1.0, z],
            [-1.0, 1.0, z],
            [right, 1.0, z],
            [right, -1.0, z],
        ])
    };
    // Howell's B-3 for a corner of size 1 at distance 1, four times.
    let (x, root) = (1.0f64, 2.0f64.sqrt());
    let factor = 4.0 * 2.0 * (x / root * (x / root).atan()) / (2.0 * std::f64::consts::PI);
    let lid = [
        [-9.0, -9.0, 0.5],
        [-9.0, 9.0, 0.5],
        [0.0, 9.0, 0.5],
        [0.0, -9.0, 0.5],
    ];
    for (others, share) in [(vec![], 1.0), (vec![quad(lid)], 0.5)] {
        let shapes = [vec![floor.clone(), square(1.0, 1.0)], others].concat();
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
        let dark = vec![[0.0; 3]; patches];
        let fields = Fields {
            sources: &dark,
            reflectance: &vec![[0.5; 3]; patches],
            indirect: &indirect,
            visible: &vec![1.0; patches],
            shown: &indirect,
            emission: &dark,
            direct: &dark,
            direct_gain: &vec![[9.0; 3]; patches],
            gathered_gain: &vec![[0.8; 3]; patches],
        };
        let from = camera([0.0, 0.0, 0.01], [0.0, 0.0, -1.0]);
        let found = seen(&mesh, &fields, &from, 4096);
        for (c, exitance) in [3.0, 2.0, 1.0].into_iter().enumerate() {
            let expected = 0.8 * exitance * share * factor;
            let found = f64::from(found[c]) * std::f64::consts::PI;
            // Of 4,096 directions, each in a cell of its own, those in the 4 x 64 cells along the border
            // of the square are left to chance, by half a direction each: 8 of 2,200 together.
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
    let (half, dark) = (vec![[0.5; 3]; patches], vec![[0.0; 3]; patches]);
    let fields = Fields {
        sources: &dark,
        reflectance: &half,
        indirect: &values,
        visible: &vec![1.0; patches],
        shown: &values,
        emission: &dark,
        direct: &dark,
        direct_gain: &half,
        gathered_gain: &half,
    };
    let params = ImageParams {
        width: 33,
        height: 20,
        ..ImageParams::default()
    };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let renderer = Renderer::new(
                &mesh,
                &fields,
                &ShadingParams::default(),
                &[Shading::Gathered],
            );
            let wide = Camera::new(
                DVec3::new(0.3, 0.4, 0.5),
                DVec3::new(0.5, 0.4, -0.3),
                DVec3::Z,
                90.0,
                0.0,
            );
            renderer.render(&wide.unwrap(), &params, &|_| ())
        })
    };
    let one = with(1);
    assert!(one == with(3));
    assert!(one[0].shows_something());
}
