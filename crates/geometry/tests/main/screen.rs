//! What a screen shows, against rays.

use proptest::prelude::*;
use radiosity_geometry::{
    Backs, Camera, DVec2, DVec3, Film, Mesh, Occluders, PixelFilter, Screen, Seen, Shape,
};
use radiosity_simd::{InstructionSet, Kernel, LANES, Simd};
use radiosity_test_kit::{icosphere, mesh_of, parallelogram, two_sided};

const FILM: Film = Film {
    width: 40,
    height: 24,
    subpixels: 1,
    filter: PixelFilter::Box,
};

/// Looks at one pixel's eight samples.
struct Look<'a> {
    screen: &'a Screen,
    pixel: (u32, u32),
    offsets: [[f32; LANES]; 2],
}

impl Kernel for Look<'_> {
    type Output = Vec<Seen>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Vec<Seen> {
        let mut seen = Vec::new();
        self.screen
            .look(simd, self.pixel, &[self.offsets], &mut seen);
        seen
    }
}

/// Eight places in a pixel, not on edges that run along axes.
fn offsets() -> [[f32; LANES]; 2] {
    let at = |step: f32, k: usize| (0.13 + step * k as f32).fract();
    [0.618_034, 0.381_966].map(|step| std::array::from_fn(|k| at(step, k)))
}

fn screen_of(mesh: &Mesh, camera: &Camera) -> Screen {
    Screen::new(
        mesh,
        (camera, Backs::Black),
        (FILM.width, FILM.height),
        FILM.reach(),
    )
}

/// The face and its side that each sample of a picture shows; the same on all instruction sets.
fn shown(screen: &Screen) -> Vec<Option<(u32, bool)>> {
    let mut all = Vec::new();
    for y in 0..FILM.height {
        for x in 0..FILM.width {
            let look = |set: InstructionSet| {
                set.run(Look {
                    screen,
                    pixel: (x, y),
                    offsets: offsets(),
                })
            };
            let seen = look(InstructionSet::current());
            for set in InstructionSet::available() {
                assert_eq!(look(set), seen, "{}", set.name());
            }
            let masks = || seen.iter().map(|seen| seen.lanes);
            let (all_of_them, sum) = masks().fold((0, 0), |(all, sum), lanes| {
                (all | lanes, sum + lanes.count_ones())
            });
            assert_eq!(u8::count_ones(all_of_them), sum, "two faces in one sample");
            assert!(seen.iter().all(|seen| seen.lanes != 0));
            all.extend((0..LANES).map(|lane| {
                let face = seen.iter().find(|seen| seen.lanes >> lane & 1 != 0)?;
                let face = &screen.faces[face.face as usize];
                Some((face.id.0, face.front))
            }));
        }
    }
    all
}

/// The same by rays.
fn traced(mesh: &Mesh, camera: &Camera) -> Vec<Option<(u32, bool)>> {
    let occluders = Occluders::new(mesh);
    let [across, down] = offsets();
    let mut all = Vec::new();
    for y in 0..FILM.height {
        for x in 0..FILM.width {
            for lane in 0..LANES {
                let place = DVec2::new(f64::from(across[lane]), f64::from(down[lane]));
                let (ray, _) = FILM.ray(camera, x, y, 0, place);
                let hit = occluders.closest_hit(&ray, camera.near(), f64::INFINITY, None);
                all.push(hit.map(|hit| (hit.face.0, hit.front)));
            }
        }
    }
    all
}

fn camera(position: DVec3, direction: DVec3, near: f64) -> Camera {
    Camera::new(position, direction, DVec3::new(0.1, 1.0, 0.2), 50.0, near).unwrap()
}

fn point() -> impl Strategy<Value = DVec3> {
    [-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0].prop_map(DVec3::from)
}

fn shape() -> impl Strategy<Value = Shape> {
    let parallelogram =
        [point(), point(), point()].prop_map(|[corner, a, b]| parallelogram(corner, a, b));
    prop_oneof![
        [point(), point(), point()].prop_map(Shape::Triangle),
        parallelogram
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Faces anywhere, in front of the camera, behind it and around it.
    #[test]
    fn samples_show_what_rays_meet(
        shapes in prop::collection::vec(shape(), 1..8),
        position in point(),
        direction in point(),
        near in prop_oneof![Just(0.0), 0.0f64..1.0],
    ) {
        let large = |shape: &Shape| match shape {
            Shape::Triangle([a, b, c]) => (*b - *a).cross(*c - *a).length() > 1e-3,
            Shape::Parallelogram { edge_a, edge_b, .. } => edge_a.cross(*edge_b).length() > 1e-3,
            _ => false,
        };
        let off_axis = direction.cross(DVec3::new(0.1, 1.0, 0.2)).length();
        prop_assume!(shapes.iter().all(large) && off_axis > 1e-2);
        let (mesh, camera) = (mesh_of(shapes), camera(position, direction, near));
        let (shown, traced) = (shown(&screen_of(&mesh, &camera)), traced(&mesh, &camera));
        // Samples within rounding of an edge may fall on either side.
        let differences = shown.iter().zip(&traced).filter(|(a, b)| a != b).count();
        prop_assert!(differences <= 1, "{differences} of {}", shown.len());
    }
}

/// From the middle of a closed sphere, every sample shows one back.
#[test]
fn no_sample_passes_between_faces() {
    let mesh = mesh_of([Shape::Mesh(icosphere(4))]);
    for direction in [
        DVec3::X,
        DVec3::new(-0.3, 0.2, 0.9),
        DVec3::new(0.0, -1.0, 0.1),
    ] {
        let camera = camera(DVec3::ZERO, direction, 0.0);
        let shown = shown(&screen_of(&mesh, &camera));
        assert!(
            shown
                .iter()
                .all(|seen| seen.is_some_and(|(_, front)| !front))
        );
    }
}

/// Walls made of two faces each, and a camera far from them: backs never show through.
#[test]
fn fronts_hide_backs_in_their_planes() {
    let [a, b, c] = [[2.3, 0.4, -0.7], [-0.3, 1.9, 1.1], [0.2, -0.9, 1.7]].map(DVec3::from);
    let wall = |[corner, edge_a, edge_b]: [DVec3; 3]| {
        let mut sides = two_sided([
            corner,
            corner + edge_a,
            corner + edge_a + edge_b,
            corner + edge_b,
        ]);
        sides.reverse();
        sides
    };
    let corner = DVec3::new(70.1, -31.3, 12.7);
    let mesh = mesh_of(
        [[corner, a, b], [corner, b, c], [corner, c, a]]
            .map(wall)
            .concat(),
    );
    let middle = corner + 0.5 * (a + b + c);
    for distance in [1.0, 30.0, 3e4] {
        let from = DVec3::new(0.5, 0.8, 0.6).normalize();
        let (position, up) = (middle + distance * from, DVec3::Y);
        let angle = (8.0 / distance).atan().min(1.0).to_degrees();
        let camera = Camera::new(position, -from, up, angle, 0.0).unwrap();
        let shown = shown(&screen_of(&mesh, &camera));
        let faces = shown.iter().flatten();
        assert!(faces.clone().count() > shown.len() / 20, "{distance}");
        assert!(faces.copied().all(|(_, front)| front), "{distance}");
    }
}

/// Whatever lies in the plane of the camera is seen edge-on: not at all.
#[test]
fn faces_seen_edge_on_do_no_harm() {
    let square = parallelogram([-1.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
    let behind = parallelogram([-9.0, -9.0, -5.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0]);
    let across = parallelogram([-1.0, 0.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 9.0]);
    let mesh = mesh_of([square, behind, across]);
    let camera = Camera::new(3.0 * DVec3::Z, DVec3::NEG_Z, DVec3::Y, 30.0, 0.0).unwrap();
    let shown = shown(&screen_of(&mesh, &camera));
    assert!(shown.iter().all(|seen| matches!(seen, Some((0 | 1, true)))));
}
