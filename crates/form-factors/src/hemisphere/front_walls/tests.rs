//! Rays from a patch meet a wall, whichever way they go.

use super::*;
use crate::sampling::patch_sampler::{PatchSampler, points};
use radiosity_geometry::{Divisions, Shape, Surface, subdivide};
use radiosity_simd::{InstructionSet, Kernel, LANES};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Rays from random points of a patch to these points.
struct ToPoints<'a>(&'a Patch, &'a FrontWalls, [DVec3; LANES]);

impl Kernel for ToPoints<'_> {
    type Output = FirstHits;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> FirstHits {
        let ToPoints(patch, ahead, to) = self;
        let coordinates = std::array::from_fn(|lane| (0.37 * lane as f64 + 0.1).fract());
        let u = simd.f64(&coordinates);
        let from = points(
            simd,
            &PatchSampler::new(&patch.polygon, patch.normal),
            u,
            u * u,
        );
        let starts = from.lanes();
        let mut directions = [[0.0f32; LANES]; 3];
        for (lane, to) in to.iter().enumerate() {
            let start = DVec3::from_array(starts.map(|axis| axis[lane]));
            let direction = (to - start).normalize().to_array();
            for axis in 0..3 {
                directions[axis][lane] = direction[axis] as f32;
            }
        }
        let [x, y, z] = &directions;
        ahead.meet(simd, &from, [simd.f32(x), simd.f32(y), simd.f32(z)])
    }
}

/// Rays to where walls of a room meet, which is slanted and far from the origin.
#[test]
fn nothing_slips_through_between_walls() {
    let [x, y] = [DVec3::new(2.4, 1.8, 0.0), DVec3::new(-1.2, 1.6, 0.1)];
    let z = DVec3::new(0.4, -0.3, 1.7);
    let corner = DVec3::new(100.3, -70.1, 31.0);
    let walls = [
        (corner, x, y),
        (corner + z, y, x),
        (corner, z, x),
        (corner + y, x, z),
        (corner, y, z),
        (corner + x, z, y),
    ];
    let surfaces = walls.map(|(corner, edge_a, edge_b)| Surface {
        shape: Shape::Parallelogram {
            corner,
            edge_a,
            edge_b,
        },
        divisions: None,
    });
    let mesh = subdivide(&surfaces, Divisions::uniform(5)).unwrap();
    let obstacles = AllBlockers::new(&mesh);
    let mut rng = Pcg64Mcg::seed_from_u64(11);
    for patch in &mesh.patches[..25] {
        let ahead = FrontWalls::of(patch, &obstacles).unwrap();
        for (start, along) in [
            (corner + z, x),
            (corner + y + z, x),
            (corner, z),
            (corner + x, z),
        ] {
            let to = std::array::from_fn(|_| start + rng.random_range(0.01..1.0) * along);
            for set in InstructionSet::available() {
                let met = set.run(ToPoints(patch, &ahead, to));
                assert_eq!([met.backs, met.nothing], [0, 0]);
            }
        }
    }
}

/// Corners within rounding of each other, and a wall that is really nearer.
#[test]
fn walls_in_one_plane_have_one() {
    let corners = [
        [0.1, 0.2, 0.3],
        [2.4, 1.1, 0.7],
        [2.1, 2.2, 1.9],
        [-0.2, 1.3, 1.5],
    ];
    let quad = |order: [usize; 4], off: f64| {
        let corners = order.map(|k| DVec3::from(corners[k]) * (1.0 + off));
        Blocker::new(&Polygon::quad(corners))
    };
    let walls = [
        quad([0, 1, 2, 3], 0.0),
        quad([2, 1, 0, 3], 1e-15),
        quad([1, 0, 3, 2], 1e-9),
    ];
    let planes = planes_of_few(&walls, 3e-12).unwrap();
    let bits = |plane: &Plane| (plane.normal, plane.offset);
    assert_eq!(bits(&planes[1]), bits(&planes[0].reversed()));
    assert_eq!(bits(&planes[2]), bits(&walls[2].planes[0]));
    assert!(planes_of_few(&vec![walls[0]; FASTER_THAN_TREE + 1], 3e-12).is_none());
}
