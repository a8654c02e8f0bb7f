//! Rays against faces: closed answers, and an independent oracle.

use proptest::prelude::*;
use radiosity_geometry::{DVec3, FaceId, Mesh, Occluders, Ray, Shape};
use radiosity_test_kit::{mesh_of, parallelogram};

fn hit(mesh: &Mesh, origin: [f64; 3], direction: [f64; 3]) -> Option<(f64, bool)> {
    let ray = Ray::new(origin.into(), direction.into());
    let hit = Occluders::new(mesh).closest_hit(&ray, 0.0, f64::INFINITY, None)?;
    Some((hit.t, hit.front))
}

fn unit_square() -> Mesh {
    mesh_of([parallelogram([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])])
}

#[test]
fn both_sides_are_hit_and_told_apart() {
    let square = unit_square();
    assert_eq!(
        hit(&square, [0.5, 0.5, 2.0], [0.0, 0.0, -1.0]),
        Some((2.0, true))
    );
    assert_eq!(
        hit(&square, [0.5, 0.5, -2.0], [0.0, 0.0, 1.0]),
        Some((2.0, false))
    );
    assert_eq!(hit(&square, [0.5, 0.5, 2.0], [0.0, 0.0, 1.0]), None);
    assert_eq!(hit(&square, [1.5, 0.5, 2.0], [0.0, 0.0, -1.0]), None);
}

#[test]
fn rays_in_or_parallel_to_the_plane_miss() {
    let square = unit_square();
    for height in [0.0, 1e-300, 0.3] {
        assert_eq!(hit(&square, [-1.0, 0.5, height], [1.0, 0.0, 0.0]), None);
        assert_eq!(hit(&square, [-1.0, 0.0, height], [1.0, 0.0, 0.0]), None);
        assert_eq!(hit(&square, [-1.0, -1.0, height], [1.0, 1.0, 0.0]), None);
    }
}

#[test]
fn edges_and_corners_belong_to_the_face() {
    let square = unit_square();
    for (x, y) in [(0.0, 0.5), (1.0, 0.5), (0.0, 0.0), (1.0, 1.0), (0.25, 1.0)] {
        assert_eq!(
            hit(&square, [x, y, 1.0], [0.0, 0.0, -1.0]),
            Some((1.0, true))
        );
    }
}

#[test]
fn the_face_a_ray_leaves_is_excluded_by_name() {
    // Far from the origin, where no distance threshold would work.
    let shift = DVec3::new(1e6, -3e6, 7e6);
    let mesh = mesh_of([0.0, 1.0].map(|z| {
        Shape::Quad([
            shift + DVec3::new(0.0, 0.0, z),
            shift + DVec3::new(1.0, 0.3, z),
            shift + DVec3::new(1.1, 1.3, z),
            shift + DVec3::new(0.1, 1.0, z),
        ])
    }));
    let occluders = Occluders::new(&mesh);
    for k in 0..100 {
        let along = f64::from(k) / 100.0;
        let start = shift + DVec3::new(0.1 + 0.9 * along, 0.5, 0.0);
        let ray = Ray::new(start, DVec3::new(0.01, 0.02, 1.0));
        let hit = occluders
            .closest_hit(&ray, 0.0, f64::INFINITY, Some(FaceId(0)))
            .unwrap();
        assert_eq!(hit.face, FaceId(1));
        assert!((hit.t - 1.0).abs() < 1e-8);
    }
}

#[test]
fn near_and_far_limits_are_respected() {
    let square = unit_square();
    let occluders = Occluders::new(&square);
    let ray = Ray::new(DVec3::new(0.5, 0.5, 2.0), DVec3::NEG_Z);
    assert!(occluders.any_hit(&ray, 0.0, 2.0, None));
    assert!(occluders.any_hit(&ray, 2.0, 3.0, None));
    assert!(!occluders.any_hit(&ray, 0.0, 1.9, None));
    assert!(!occluders.any_hit(&ray, 2.1, 9.0, None));
    assert!(!occluders.any_hit(&ray, 0.0, 9.0, Some(FaceId(0))));
}

fn point(range: std::ops::Range<f64>) -> impl Strategy<Value = DVec3> {
    (range.clone(), range.clone(), range).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

pub(crate) fn triangles(count: usize) -> impl Strategy<Value = Mesh> {
    let triangle = [point(-1.0..1.0), point(-1.0..1.0), point(-1.0..1.0)]
        .prop_filter("slivers", |[a, b, c]| {
            (*b - *a).cross(*c - *a).length() > 1e-3
        })
        .prop_map(Shape::Triangle);
    prop::collection::vec(triangle, 1..count).prop_map(mesh_of)
}

/// Moeller and Trumbore 1997: another formula for the same hit.
fn oracle(mesh: &Mesh, ray: &Ray) -> Option<(f64, usize)> {
    let distance = |corners: &[DVec3]| {
        let (e1, e2) = (corners[1] - corners[0], corners[2] - corners[0]);
        let p = ray.direction.cross(e2);
        let s = ray.origin - corners[0];
        let q = s.cross(e1);
        let scale = 1.0 / p.dot(e1);
        let (u, v, t) = (
            scale * p.dot(s),
            scale * q.dot(ray.direction),
            scale * q.dot(e2),
        );
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0).then_some(t)
    };
    let faces = mesh.faces.iter().enumerate();
    faces
        .filter_map(|(k, face)| Some((distance(face.polygon.corners())?, k)))
        .min_by(|a, b| a.0.total_cmp(&b.0))
}

proptest! {
    #[test]
    fn closest_hits_agree_with_moeller_trumbore(
        mesh in triangles(40), origin in point(-2.0..2.0), direction in point(-1.0..1.0)
    ) {
        prop_assume!(direction.length() > 0.01);
        let ray = Ray::new(origin, direction);
        let occluders = Occluders::new(&mesh);
        let hit = occluders.closest_hit(&ray, 0.0, f64::INFINITY, None);
        prop_assert_eq!(hit.is_some(), occluders.any_hit(&ray, 0.0, f64::INFINITY, None));
        match (hit, oracle(&mesh, &ray)) {
            (None, None) => {}
            (Some(hit), Some((t, face))) => {
                prop_assert!((hit.t - t).abs() < 1e-9 * (1.0 + t));
                prop_assert_eq!(hit.face.index(), face);
            }
            (found, expected) => prop_assert!(false, "{found:?} instead of {expected:?}"),
        }
    }

    /// A parallelogram is hit exactly where both of its coordinates are in [0, 1], at any angle
    /// between its edges.
    #[test]
    fn parallelograms_contain_what_their_coordinates_say(
        corner in point(-1.0..1.0), a in point(-1.0..1.0), b in point(-1.0..1.0),
        u in -0.5f64..1.5, v in -0.5f64..1.5, eye in point(2.0..3.0)
    ) {
        prop_assume!(a.cross(b).length() > 0.01);
        let margin = 1e-6;
        let near_border = [u, v].iter().any(|x| x.abs() < margin || (x - 1.0).abs() < margin);
        prop_assume!(!near_border);
        let mesh = mesh_of([parallelogram(corner, a, b)]);
        let target = corner + u * a + v * b;
        prop_assume!(mesh.faces[0].normal.dot((target - eye).normalize()).abs() > 1e-3);
        let ray = Ray::new(eye, target - eye);
        let inside = (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v);
        let hit = Occluders::new(&mesh).closest_hit(&ray, 0.0, f64::INFINITY, None);
        prop_assert_eq!(hit.is_some(), inside);
        if let Some(hit) = hit {
            prop_assert!((hit.t - 1.0).abs() < 1e-9);
        }
    }
}
