//! The few faces that are listed between two: none that blocks is lost.

use crate::intersection::triangles;
use proptest::prelude::*;
use radiosity_geometry::{DVec3, Face, FaceId, Mesh, Occluders, PolygonMesh, Ray, Shape};
use radiosity_test_kit::mesh_of;

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
    let mesh = mesh_of([Shape::Mesh(PolygonMesh { positions, faces })]);
    let occluders = Occluders::new(&mesh);
    let at = |x: f64| {
        let is_at = |f: &Face| f.polygon.corners()[0].x == x;
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

proptest! {
    /// However the candidates between two faces are found, segments are judged as if every
    /// face had been tried.
    #[test]
    fn no_blocker_is_lost_between_ends(
        mesh in triangles(60), s in 0.05f64..0.45, t in 0.05f64..0.45,
    ) {
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
                let only = mesh_of([Shape::Triangle(
                    mesh.faces[f].polygon.corners().try_into().unwrap(),
                )]);
                Occluders::new(&only).any_hit(&ray, 1e-9, 1.0 - 1e-9, None)
            });
            prop_assert_eq!(expected, brute);
        }
    }
}
