//! Nothing leaks out of closed meshes, small or large.

use radiosity_geometry::{DVec3, Occluders, Ray, Shape};
use radiosity_test_kit::{cuboid, icosphere, inside_out, mesh_of};

/// Rays from inside a closed mesh through its exact corners and edge midpoints, and along the
/// axes: every one of them must be stopped.
#[test]
fn closed_meshes_do_not_leak() {
    let sphere = icosphere(4);
    let mesh = mesh_of([Shape::Mesh(sphere.clone())]);
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
    let faces = inside_out(cuboid([0.0; 3], [100.0, 80.0, 170.0]));
    let room = mesh_of(faces.map(Shape::Quad));
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
    let mesh = mesh_of([Shape::Mesh(icosphere(6))]);
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
