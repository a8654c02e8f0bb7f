//! Walls made of two faces in one place, each the reverse of the other, met by rays.

use radiosity_geometry::{DVec3, FaceId, Mesh, Occluders, Ray};
use radiosity_test_kit::{mesh_of, parallelogram, two_sided};

/// A slanted wall, its reverse that begins at another corner, and both again, larger, behind it.
fn two_sided_walls(reversed_first: bool) -> Mesh {
    let corner = DVec3::new(70.1, -31.3, 12.7);
    let (a, b) = (DVec3::new(2.3, 0.4, -0.7), DVec3::new(-0.3, 1.9, 1.1));
    let wall = |size: f64, height: f64| {
        let corner = corner + height * a.cross(b).normalize() - 0.5 * (size - 1.0) * (a + b);
        let [a, b] = [size * a, size * b];
        let mut sides = two_sided([corner, corner + a, corner + a + b, corner + b]);
        if reversed_first {
            sides.reverse();
        }
        sides
    };
    mesh_of(wall(1.0, 0.0).into_iter().chain(wall(9.0, -1.0)))
}

#[test]
fn walls_of_two_faces_show_their_fronts() {
    for reversed_first in [false, true] {
        let mesh = two_sided_walls(reversed_first);
        let occluders = Occluders::new(&mesh);
        for k in 0..400 {
            let (u, v) = (
                f64::from(k % 20) / 20.0 + 0.02,
                f64::from(k / 20) / 20.0 + 0.02,
            );
            for (side, other) in [(0, 1), (1, 0)] {
                let face = &mesh.faces[side];
                let on_wall = face.polygon.bilinear(u, v);
                let aside = face.polygon.corners()[1] - on_wall;
                let origin = on_wall + 0.5 * face.normal + aside;
                let ray = Ray::new(origin, on_wall - origin);
                let hit = occluders
                    .closest_hit(&ray, 0.5, f64::INFINITY, None)
                    .unwrap();
                assert_eq!(
                    (hit.face.index(), hit.front, hit.backed),
                    (side, true, true)
                );
                // Without it, what is behind it is its reverse.
                let hit = occluders
                    .closest_hit(&ray, 0.5, f64::INFINITY, Some(hit.face))
                    .unwrap();
                assert_eq!(
                    (hit.face.index(), hit.front, hit.backed),
                    (other, false, false)
                );
            }
            // From the smaller wall down, neither of its faces is met.
            for side in 0..2 {
                let face = &mesh.faces[side];
                let start = face.polygon.bilinear(u, v);
                let down = Ray::new(start, mesh.faces[2].polygon.centroid() - start);
                let hit = occluders
                    .closest_hit_from(FaceId(side as u32), &down)
                    .unwrap();
                assert!(hit.front && hit.backed && hit.face.index() >= 2, "{hit:?}");
            }
        }
    }
}

#[test]
fn what_is_really_nearer_is_met_first() {
    let square = |z: f64, facing: f64| {
        parallelogram(
            [0.0, 0.5 - 0.5 * facing, z],
            [1.0, 0.0, 0.0],
            [0.0, facing, 0.0],
        )
    };
    // Some ten times what counts as one plane where coordinates reach 1.
    let mesh = mesh_of([square(0.0, 1.0), square(1e-11, -1.0)]);
    let ray = Ray::new(DVec3::new(0.3, 0.6, 1.0), DVec3::NEG_Z);
    let hit = Occluders::new(&mesh).closest_hit(&ray, 0.0, f64::INFINITY, None);
    let hit = hit.unwrap();
    assert_eq!((hit.t, hit.front), (1.0 - 1e-11, false));
}
