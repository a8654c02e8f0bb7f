//! Shares by lines, against rays and against what is known of them.
//!
//! Long because: samplers whose answers are known are written out.

use super::*;
use crate::accurate::line_sampling::{Blocked, Lines};
use crate::culling::blocker::Blocker;
use crate::sampling::fan::Fan;
use crate::sampling::lattice::ratio;
use crate::sampling::patch_sampler::PatchSampler;
use radiosity_geometry::{DVec3, Mesh, Occluders, Shape};
use radiosity_simd::{Float, InstructionSet, LANES};
use radiosity_test_kit::mesh_of;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A trapezoid and a triangle that face each other, and two things between them.
fn scene() -> Mesh {
    let p = DVec3::new;
    let shapes = [
        Shape::Quad([
            p(0.0, 0.0, 0.0),
            p(3.0, 0.0, 0.0),
            p(2.0, 2.0, 0.0),
            p(0.5, 2.0, 0.0),
        ]),
        Shape::Triangle([p(0.0, 0.0, 4.0), p(0.3, 3.0, 4.5), p(3.0, 0.5, 3.5)]),
        Shape::Triangle([p(0.5, -1.0, 2.0), p(2.0, 1.0, 2.2), p(0.0, 2.0, 1.9)]),
        Shape::Quad([
            p(1.5, 1.5, 1.0),
            p(3.0, 1.5, 1.0),
            p(3.0, 3.0, 1.0),
            p(1.5, 3.0, 1.0),
        ]),
    ];
    mesh_of(shapes)
}

fn blockers(mesh: &Mesh) -> Vec<Blocker> {
    let faces = mesh.faces[2..].iter();
    faces.map(|face| Blocker::new(&face.polygon)).collect()
}

/// From the points of one of the first two patches to the other.
fn lines<'a>(mesh: &Mesh, [from, across]: [usize; 2], blocked: &Blocked<'a>) -> Lines<'a> {
    let [from, across] = [from, across].map(|k| &mesh.patches[k]);
    Lines::new(
        (from.polygon.corners(), from.normal),
        PatchSampler::new(&across.polygon, across.normal),
        blocked,
    )
}

fn stream() -> Stream {
    Stream::of_pair(0, 0, 1)
}

/// The sums over some samples of the first piece, on an instruction set.
fn sums(set: InstructionSet, sampler: &impl Sampler, samples: usize) -> Sums {
    let mut sums = Sums::default();
    set.run(Measure {
        sampler,
        piece: 0,
        lattice: &Lattice::new(Block::WHOLE, &mut stream()),
        samples: 0..samples,
        sums: &mut sums,
    });
    sums
}

#[test]
fn all_instruction_sets_give_the_same_bits() {
    let mesh = scene();
    let (blockers, occluders) = (blockers(&mesh), Occluders::new(&mesh));
    let faces = [0, 1].map(|k: usize| mesh.patches[k].face);
    let run = |set| {
        let sums = |pair, blocked| sums(set, &lines(&mesh, pair, &blocked), 100);
        let all = [
            sums([0, 1], Blocked::List(&blockers)),
            sums([1, 0], Blocked::List(&blockers)),
            sums([0, 1], Blocked::Tree(&occluders, faces)),
        ];
        all.map(|sums| [sums.all, sums.visible])
    };
    let portable = InstructionSet::available().pop().unwrap();
    for set in InstructionSet::available() {
        assert_eq!(run(set), run(portable), "{}", set.name());
    }
}

/// Of any polygons that face each other, the integral of the kernel is the unoccluded exchange, of
/// patches that touch, too: points, lines, and places on lines have the density that they are
/// divided by.
#[test]
fn samples_add_up_to_the_exchange() {
    let p = DVec3::new;
    let wall = Shape::Quad([
        p(0.0, 0.0, 0.0),
        p(0.0, 0.0, 2.0),
        p(2.0, 0.0, 3.0),
        p(3.0, 0.0, 0.0),
    ]);
    let floor = Shape::Triangle([p(0.0, 0.0, 0.0), p(3.0, 0.0, 0.0), p(1.0, 2.0, 0.0)]);
    let touching = mesh_of([wall, floor]);
    for mesh in [scene(), touching] {
        let corners = |k: usize| mesh.patches[k].polygon.corners();
        let exact = crate::accurate::contour::exchange(corners(0), corners(1), 1e-12).value;
        let occluders = Occluders::new(&mesh);
        let faces = [0, 1].map(|k: usize| mesh.patches[k].face);
        for pair in [[0, 1], [1, 0]] {
            for blocked in [Blocked::List(&[]), Blocked::Tree(&occluders, faces)] {
                let samples = 8192;
                let sums = sums(
                    InstructionSet::current(),
                    &lines(&mesh, pair, &blocked),
                    samples,
                );
                let (mean, error) =
                    ratio(&sums.all, &[samples as f64 * std::f64::consts::PI; LANES]);
                assert!(error < 1e-3 * exact && (mean - exact).abs() < 4.0 * error);
            }
        }
    }
}

/// Lines across a triangle or a trapezoid find the share that rays find, within both errors.
#[test]
fn lines_and_rays_agree() {
    let mesh = scene();
    let (blockers, occluders) = (blockers(&mesh), Occluders::new(&mesh));
    let faces = [0, 1].map(|k: usize| mesh.patches[k].face);
    let rays = lines(&mesh, [0, 1], &Blocked::Tree(&occluders, faces));
    let expected = share(&rays, stream(), 1e-3);
    assert!((0.1..0.9).contains(&expected.value));
    for pair in [[0, 1], [1, 0]] {
        let lines = lines(&mesh, pair, &Blocked::List(&blockers));
        for wanted in [0.1, 1e-3, 1e-4, 1e-5] {
            let found = share(&lines, stream(), wanted);
            assert!(found.error <= wanted && found.missed == 0.0);
            let error = 4.0 * (found.error + expected.error);
            assert!(
                (found.value - expected.value).abs() < error,
                "{found:?} {expected:?}"
            );
        }
    }
}

/// What is visible is on one side of a plane that is at an angle to all axes.
#[derive(Default)]
struct HalfSpace {
    /// How many samples have been taken under each shift.
    taken: AtomicUsize,
}

impl Sampler for HalfSpace {
    fn pieces(&self) -> usize {
        1
    }

    fn coordinates(&self) -> usize {
        3
    }

    fn sample<S: Simd>(&self, simd: S, k: usize, _: usize, lattice: &Lattice) -> [S::F64; 2] {
        self.taken.fetch_add(1, Ordering::Relaxed);
        let (zero, one) = (simd.splat_f64(0.0), simd.splat_f64(1.0));
        let [x, y, z] = [
            lattice.coordinate(simd, k, 0),
            lattice.coordinate(simd, k, 1),
            lattice.coordinate(simd, k, 2),
        ];
        let height = x + y + z - one;
        [one, height.if_less(zero, one, zero)]
    }

    fn unseen(&self, _: f64) -> f64 {
        0.0
    }
}

/// The share of a function that jumps is a sixth here. Ten times the accuracy takes ten times as
/// many samples, and what is wanted is what is found.
#[test]
fn work_grows_with_accuracy_alone() {
    let mut last = None;
    for wanted in [1e-3, 1e-4, 1e-5] {
        let sampler = HalfSpace::default();
        let found = share(&sampler, stream(), wanted);
        assert!(found.error <= wanted && found.missed == 0.0);
        assert!(
            (found.value - 1.0 / 6.0).abs() < 3.0 * found.error,
            "{found:?}"
        );
        let taken = sampler.taken.into_inner();
        if let Some(before) = last.replace(taken) {
            assert!(taken < 12 * before, "{before} {taken}");
        }
    }
}

/// Nothing can be found out about it.
struct Noise;

impl Sampler for Noise {
    fn pieces(&self) -> usize {
        1
    }

    fn coordinates(&self) -> usize {
        3
    }

    fn sample<S: Simd>(&self, simd: S, k: usize, _: usize, lattice: &Lattice) -> [S::F64; 2] {
        // Digits of a coordinate that no lattice resolves.
        let x = lattice.coordinate(simd, k, 0).lanes();
        let noise = x.map(|x| (1e9 * x * x).fract());
        [simd.splat_f64(1.0), simd.f64(&noise)]
    }

    fn unseen(&self, _: f64) -> f64 {
        0.0
    }
}

/// What is left of the error when all samples are taken is said to be missed, and nothing else is.
#[test]
fn what_is_missed_is_what_samples_leave() {
    // Even numbers have a variance of 1/12.
    let least = (1.0 / 12.0 / (LANES * 2 * MOST) as f64).sqrt();
    let found = share(&Noise, stream(), 0.1 * least);
    assert!(
        found.error > least && found.error < 3.0 * least,
        "{found:?}"
    );
    assert_eq!(found.missed, found.error - 0.1 * least);
    let found = share(&Noise, stream(), 10.0 * least);
    assert_eq!(found.missed, 0.0);
}

/// The shadow of a square on one parallel to it has edges along those of the square. Lines along
/// its diagonal know more of it than lines along its edges, of which some run along the shadow's.
#[test]
fn lines_that_cross_shadows_know_more() {
    let p = DVec3::new;
    let corners = [0.0, 2.0].map(|z| {
        [
            p(0.0, 0.0, z),
            p(2.0, 0.0, z),
            p(2.0, 2.0, z),
            p(0.0, 2.0, z),
        ]
    });
    let [below, [a, b, c, d]] = corners;
    let between = below.map(|corner| 0.65 * corner + p(-0.4, -0.4, 1.0));
    let mesh = mesh_of([below, [a, d, c, b], between].map(Shape::Quad));
    let blockers = blockers(&mesh);
    let blocked = Blocked::List(&blockers);
    let diagonal = lines(&mesh, [0, 1], &blocked);
    let [i, j] = [0, 1].map(|k: usize| &mesh.patches[k]);
    let mut target = PatchSampler::new(&j.polygon, j.normal);
    target.fans = [[c, a, b], [a, c, d]]
        .map(|corners| Fan::new(corners, j.normal))
        .into();
    let along_edges = Lines::new((i.polygon.corners(), i.normal), target, &blocked);
    let share = |lines: &Lines<'_>, samples: usize| {
        let sums = sums(InstructionSet::current(), lines, samples);
        ratio(&sums.visible, &sums.all)
    };
    let (expected, _) = share(&diagonal, 8192);
    let (value, error) = share(&diagonal, 1024);
    assert!((value - expected).abs() < 4.0 * error);
    let (value, error_along_edges) = share(&along_edges, 1024);
    assert!((value - expected).abs() < 4.0 * error_along_edges);
    assert!(
        2.0 * error < error_along_edges,
        "{error} {error_along_edges}"
    );
}
