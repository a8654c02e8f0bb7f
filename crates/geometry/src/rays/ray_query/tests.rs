//! Every instruction set of this machine finds, to the bit, what the scalar test finds by trying
//! all faces.

use super::*;
use crate::rays::occluders::{Occluder, ordered};
use crate::rays::segment_packet::{BlockedOf, SegmentPacket};
use crate::{Divisions, Mesh, PolygonMesh, Shape, Surface, subdivide};
use proptest::prelude::*;
use radiosity_simd::{InstructionSet, LANES};

/// Corners on a coarse lattice, so that rays graze edges, meet corners and tie.
fn lattice_point() -> impl Strategy<Value = DVec3> {
    (0..5, 0..5, 0..5).prop_map(|(x, y, z)| DVec3::new(f64::from(x), f64::from(y), f64::from(z)))
}

fn any_point() -> impl Strategy<Value = DVec3> {
    (-1.0..5.0, -1.0..5.0, -1.0..5.0).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

/// Triangles and, where the last corner of a parallelogram completes them, quads.
fn mesh() -> impl Strategy<Value = Mesh> {
    let face = (
        lattice_point(),
        lattice_point(),
        lattice_point(),
        any::<bool>(),
    );
    proptest::collection::vec(face, 1..120).prop_filter_map("no face", |faces| {
        let mut mesh = PolygonMesh {
            positions: Vec::new(),
            faces: Vec::new(),
        };
        for (a, b, c, quad) in faces {
            if (b - a).cross(c - a) == DVec3::ZERO {
                continue;
            }
            let first = mesh.positions.len() as u32;
            let fourth = quad.then_some(a + c - b);
            mesh.positions.extend([a, b, c].into_iter().chain(fourth));
            mesh.faces
                .push((first..mesh.positions.len() as u32).collect());
        }
        let surface = Surface {
            shape: Shape::Mesh(mesh),
            divisions: None,
        };
        subdivide(&[surface], Divisions::uniform(1)).ok()
    })
}

/// A line within a face's plane does not meet it, but if rounding tilts either, it may seem to,
/// anywhere: only boxes then keep it near the face.
fn only_rounding_tilts(face: &Occluder, ray: &Ray) -> bool {
    let approach = face.normal.dot(ray.direction).abs();
    approach > 0.0 && approach < 1e-9 * ray.direction.length()
}

fn scalar_hits(occluders: &Occluders, ray: &Ray, except: Option<FaceId>) -> Vec<Hit> {
    let hit = |(index, face): (usize, &Occluder)| {
        let approach = face.normal.dot(ray.direction);
        let hit = Hit {
            t: -face.height(ray.origin) / approach,
            face: FaceId(index as u32),
            front: approach < 0.0,
            backed: false,
        };
        let counts = hit.t >= 0.0 && Some(hit.face) != except && ray.pierces(&face.corners);
        counts.then_some(hit)
    };
    occluders.faces.iter().enumerate().filter_map(hit).collect()
}

fn check_ray(occluders: &Occluders, ray: &Ray, except: Option<FaceId>) {
    let hits = scalar_hits(occluders, ray, except);
    let horizon = |hit: &Hit| hit.t + occluders.in_plane(hit.face, ray);
    let horizon = hits.iter().map(horizon).fold(f64::INFINITY, f64::min);
    let nearest = |front: bool| {
        let side = hits
            .iter()
            .filter(|hit| hit.front == front && hit.t <= horizon);
        let set_back = |hit: &Hit| match front {
            true => hit.t + occluders.set_back(hit.face, ray),
            false => hit.t,
        };
        // Zeros are equal whatever their sign; the first of equals wins.
        side.copied().reduce(|best, hit| {
            if set_back(&hit) < set_back(&best) {
                hit
            } else {
                best
            }
        })
    };
    let (front, back) = (nearest(true), nearest(false));
    let backed = back.is_some();
    let closest = front.map(|hit| Hit { backed, ..hit }).or(back);
    for set in InstructionSet::available() {
        let reach = occluders.reach(ray, 0.0, f64::INFINITY, except);
        let found = set.run(reach.closest_hit());
        assert_eq!(found, closest, "{}", set.name());
        let any = set.run(reach.any_hit());
        assert_eq!(any, closest.is_some(), "{}", set.name());
    }
}

fn check_segment(occluders: &Occluders, ends: [DVec3; 2], except: [FaceId; 2]) {
    let [p, q] = ordered(ends[0], ends[1]);
    let tolerance = occluders.plane_tolerance;
    let faces = occluders.faces.iter().enumerate();
    let mut others = faces.filter(|(index, _)| !except.contains(&FaceId(*index as u32)));
    let blocked = others.any(|(_, face)| face.cuts(p, q, tolerance));
    for set in InstructionSet::available() {
        let found = set.run(Blocked::new(occluders, except, [p, q]));
        assert_eq!(found, blocked, "{}", set.name());
    }
}

/// Eight segments at a time; those of no length are not asked for.
fn check_bundle(occluders: &Occluders, segments: &[(DVec3, DVec3)], except: [FaceId; 2]) {
    let lanes = |end: fn(&(DVec3, DVec3)) -> DVec3| {
        std::array::from_fn(|axis| std::array::from_fn(|lane| end(&segments[lane])[axis]))
    };
    let bundle = SegmentPacket {
        points: [lanes(|ends| ends.0), lanes(|ends| ends.1)],
        faces: except.map(|face| [face; LANES]),
    };
    let (mut wanted, mut blocked) = (0, 0);
    for (lane, &(p, q)) in segments.iter().enumerate() {
        let ray = Ray::new(p, q - p);
        let tilts = |face: &Occluder| only_rounding_tilts(face, &ray);
        if p != q && !occluders.faces.iter().any(tilts) {
            wanted |= 1 << lane;
            blocked |= u8::from(occluders.blocked(except[0], p, except[1], q)) << lane;
        }
    }
    for set in InstructionSet::available() {
        let found = set.run(BlockedOf {
            occluders,
            bundle: &bundle,
            wanted,
        });
        assert_eq!(found, blocked, "{}", set.name());
    }
}

/// Enough small triangles for a tree of several levels, and more leaves along segments than are met
/// at a time.
#[test]
fn bundles_find_their_way_among_many_faces() {
    let turn = |k: u32, by: f64| 5.0 * (f64::from(k) * by).fract();
    let point = |k: u32| DVec3::new(turn(k, 0.754_877), turn(k, 0.569_840), turn(k, 0.430_159));
    let mut mesh = PolygonMesh {
        positions: Vec::new(),
        faces: Vec::new(),
    };
    for k in 0..3000 {
        let first = mesh.positions.len() as u32;
        let corner = point(k);
        let edge = |seed: u32| 0.04 * (point(7 * k + seed) - DVec3::splat(2.5));
        mesh.positions
            .extend([corner, corner + edge(1), corner + edge(5)]);
        mesh.faces.push(vec![first, first + 1, first + 2]);
    }
    let surface = Surface {
        shape: Shape::Mesh(mesh),
        divisions: None,
    };
    let mesh = subdivide(&[surface], Divisions::uniform(1)).unwrap();
    let occluders = Occluders::new(&mesh);
    for bundle in 0..200 {
        // Wide ones and narrow ones.
        let width = if bundle % 2 == 0 { 1.0 } else { 0.02 };
        let [from, to] = [point(bundle + 10_000), point(bundle + 20_000)];
        let near = |center: DVec3, k: u32| center.lerp(point(8 * bundle + k), width);
        let segments: Vec<_> = (0..8).map(|k| (near(from, k), near(to, k + 31))).collect();
        check_bundle(&occluders, &segments, [FaceId(bundle), FaceId(0)]);
    }
}

proptest! {
    #[test]
    fn all_instruction_sets_agree_with_the_scalar_test(
        mesh in mesh(),
        lattice in proptest::collection::vec((lattice_point(), lattice_point()), 8),
        random in proptest::collection::vec((any_point(), any_point()), 8),
    ) {
        let occluders = Occluders::new(&mesh);
        let last = FaceId(mesh.faces.len() as u32 - 1);
        check_bundle(&occluders, &lattice, [FaceId(0), last]);
        check_bundle(&occluders, &random, [FaceId(0), last]);
        for (p, q) in lattice.into_iter().chain(random) {
            if p == q {
                continue;
            }
            let ray = Ray::new(p, q - p);
            if occluders.faces.iter().any(|face| only_rounding_tilts(face, &ray)) {
                continue;
            }
            check_ray(&occluders, &ray, None);
            check_ray(&occluders, &ray, Some(last));
            check_segment(&occluders, [p, q], [FaceId(0), last]);
        }
    }
}
