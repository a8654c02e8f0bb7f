//! Rays against faces: closed answers, an independent oracle, and no leaks.

mod shapes;

use proptest::prelude::*;
use radiosity_geometry::{DVec3, FaceId, Mesh, Occluders, Ray, Shape};
use shapes::{icosphere, mesh_of, parallelogram, surfaces_of};

fn hit(mesh: &Mesh, origin: [f64; 3], direction: [f64; 3]) -> Option<(f64, bool)> {
    let ray = Ray::new(origin.into(), direction.into());
    let hit = Occluders::new(mesh).closest_hit(&ray, 0.0, f64::INFINITY, None)?;
    Some((hit.t, hit.front))
}

fn unit_square() -> Mesh {
    surfaces_of([parallelogram([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])])
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
    let mesh = surfaces_of([0.0, 1.0].map(|z| {
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

/// Rays from inside a closed mesh through its exact corners and edge midpoints, and along the
/// axes: every one of them must be stopped.
#[test]
fn closed_meshes_do_not_leak() {
    let sphere = icosphere(4);
    let mesh = mesh_of(sphere.clone());
    let occluders = Occluders::new(&mesh);
    let mut targets: Vec<DVec3> = sphere.positions.clone();
    for face in &sphere.faces {
        let [a, b, c] = [0, 1, 2].map(|k| sphere.positions[face[k] as usize]);
        targets.extend([0.5 * (a + b), 0.5 * (b + c), 0.25 * a + 0.75 * c]);
    }
    for origin in [
        DVec3::ZERO,
        DVec3::new(0.1, 0.2, -0.3),
        DVec3::new(0.0, 0.5, 0.0),
    ] {
        for target in &targets {
            let ray = Ray::new(origin, *target - origin);
            assert!(
                occluders.any_hit(&ray, 0.0, f64::INFINITY, None),
                "{origin} {target}"
            );
        }
    }
}

/// The same through the edges of a box of quads, the shape of most rooms.
#[test]
fn rooms_do_not_leak() {
    let room = surfaces_of([
        parallelogram([0.0, 0.0, 0.0], [100.0, 0.0, 0.0], [0.0, 80.0, 0.0]),
        parallelogram([0.0, 0.0, 170.0], [100.0, 0.0, 0.0], [0.0, 0.0, -170.0]),
        parallelogram([0.0, 80.0, 0.0], [100.0, 0.0, 0.0], [0.0, 0.0, 170.0]),
        parallelogram([0.0, 0.0, 170.0], [0.0, 0.0, -170.0], [0.0, 80.0, 0.0]),
        parallelogram([100.0, 0.0, 0.0], [0.0, 0.0, 170.0], [0.0, 80.0, 0.0]),
        parallelogram([100.0, 0.0, 170.0], [-100.0, 0.0, 0.0], [0.0, 80.0, 0.0]),
    ]);
    let occluders = Occluders::new(&room);
    for origin in [DVec3::new(50.0, 40.0, 85.0), DVec3::new(3.7, 77.1, 11.9)] {
        for (k, x) in [0.0, 13.7, 50.0, 100.0].into_iter().enumerate() {
            for y in [0.0, 80.0, 80.0 / 3.0 * k as f64] {
                for z in [0.0, 170.0, 17.0 * x] {
                    let ray = Ray::new(origin, DVec3::new(x, y, z) - origin);
                    assert!(occluders.any_hit(&ray, 0.0, f64::INFINITY, None));
                }
            }
        }
    }
}

/// 82,000 triangles: built and traced in a moment, and right.
#[test]
fn large_meshes_are_practical() {
    let mesh = mesh_of(icosphere(6));
    assert_eq!(mesh.faces.len(), 81_920);
    let occluders = Occluders::new(&mesh);
    for k in 0..20_000 {
        let angle = f64::from(k) * 2.399_963;
        let z = 1.0 - (f64::from(k) + 0.5) / 10_000.0;
        let r = (1.0 - z * z).sqrt();
        let direction = DVec3::new(r * angle.cos(), r * angle.sin(), z);
        let ray = Ray::new(DVec3::ZERO, direction);
        let hit = occluders
            .closest_hit(&ray, 0.0, f64::INFINITY, None)
            .unwrap();
        // The facets lie between the sphere and its inscribed one; edges are at most 0.02 long.
        assert!(hit.t <= 1.0 + 1e-12 && hit.t > 1.0 - 1e-4 && !hit.front);
    }
}

#[test]
fn a_mesh_shadows_itself_but_its_ends_do_not() {
    // Three parallel walls, one mesh: the middle one stands between the outer ones.
    let wall = |x: f64| [[x, 0.0, 0.0], [x, 1.0, 0.0], [x, 1.0, 1.0], [x, 0.0, 1.0]];
    let positions = [0.0, 1.0, 2.0]
        .into_iter()
        .flat_map(wall)
        .map(DVec3::from)
        .collect();
    let faces = vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7], vec![11, 10, 9, 8]];
    let mesh = mesh_of(radiosity_geometry::PolygonMesh { positions, faces });
    let occluders = Occluders::new(&mesh);
    let at = |x: f64| {
        let is_at = |f: &radiosity_geometry::Face| f.polygon.corners()[0].x == x;
        FaceId(mesh.faces.iter().position(is_at).unwrap() as u32)
    };
    let blocked = |from: f64, to: f64| {
        let (i, j) = (at(from), at(to));
        let ends = [i, j].map(|f| (f, mesh.faces[f.index()].polygon.centroid()));
        cut_by_listed(&mesh, &occluders, ends)
    };
    assert!(blocked(0.0, 2.0));
    assert!(!blocked(0.0, 1.0));
}

/// Whether a segment is cut by one of the few faces between those of its ends.
fn cut_by_listed(mesh: &Mesh, occluders: &Occluders, ends: [(FaceId, DVec3); 2]) -> bool {
    let [(_, p), (_, q)] = ends;
    let bounds = |(face, _): (FaceId, DVec3)| mesh.faces[face.index()].polygon.bounds();
    let faces = occluders.between(ends.map(bounds), mesh.faces.len());
    let mut faces = faces.expect("they are few").into_iter();
    let ends = ends.map(|(face, _)| face);
    faces.any(|face| !ends.contains(&face) && occluders.cuts(face, p, q))
}

fn point(range: std::ops::Range<f64>) -> impl Strategy<Value = DVec3> {
    (range.clone(), range.clone(), range).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn triangles(count: usize) -> impl Strategy<Value = Mesh> {
    let triangle = [point(-1.0..1.0), point(-1.0..1.0), point(-1.0..1.0)]
        .prop_filter("slivers", |[a, b, c]| {
            (*b - *a).cross(*c - *a).length() > 1e-3
        })
        .prop_map(Shape::Triangle);
    prop::collection::vec(triangle, 1..count).prop_map(surfaces_of)
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
        let mesh = surfaces_of([Shape::Parallelogram { corner, edge_a: a, edge_b: b }]);
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

    /// However the candidates between two faces are found, segments are judged as if every
    /// face had been tried.
    #[test]
    fn no_blocker_is_lost_between_ends(mesh in triangles(60), s in 0.05f64..0.45, t in 0.05f64..0.45) {
        let occluders = Occluders::new(&mesh);
        let point_on = |f: usize| mesh.faces[f].polygon.barycentric(s, t);
        for j in 1..mesh.faces.len().min(8) {
            let [i_id, j_id] = [FaceId(0), FaceId(j as u32)];
            let (p, q) = (point_on(0), point_on(j));
            // Ends look to the front only, as form factors do.
            let in_front = |f: usize, x: DVec3| mesh.faces[f].normal.dot(x - point_on(f)) > 0.0;
            if !(in_front(0, q) && in_front(j, p)) {
                continue;
            }
            let expected = occluders.blocked(i_id, p, j_id, q);
            let listed = cut_by_listed(&mesh, &occluders, [(i_id, p), (j_id, q)]);
            prop_assert_eq!(listed, expected);
            let ray = Ray::new(p, q - p);
            let others = (1..mesh.faces.len()).filter(|&f| f != j);
            let brute = others.clone().any(|f| {
                let only = surfaces_of([Shape::Triangle(
                    mesh.faces[f].polygon.corners().try_into().unwrap(),
                )]);
                Occluders::new(&only).any_hit(&ray, 1e-9, 1.0 - 1e-9, None)
            });
            prop_assert_eq!(expected, brute);
        }
    }
}
