//! Shares by segments and by lines, against each other and against what is known of them.

use super::*;
use crate::blocker::Blocker;
use crate::exchange;
use crate::lines::Lines;
use crate::segments::{Blocked, Segments};
use crate::target::{Fan, Target};
use radiosity_geometry::{DVec3, Divisions, Mesh, Occluders, Shape, Surface, subdivide};
use radiosity_simd::InstructionSet;

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
    let surfaces = shapes.map(|shape| Surface {
        shape,
        divisions: None,
    });
    subdivide(&surfaces, Divisions::uniform(1)).unwrap()
}

fn targets(mesh: &Mesh) -> [Target; 2] {
    [0, 1].map(|k: usize| Target::new(&mesh.patches[k]))
}

fn blockers(mesh: &Mesh) -> Vec<Blocker> {
    let faces = mesh.faces[2..].iter();
    faces.map(|face| Blocker::new(&face.polygon)).collect()
}

/// The sums over some samples, on an instruction set.
fn sums(set: InstructionSet, sampler: &impl Sampler, samples: usize) -> Sums {
    let mut sums = Sums::default();
    set.run(Measure {
        sampler,
        shifts: &shifts(Stream::of_pair(0, 0, 1)),
        samples: 0..samples,
        sums: &mut sums,
    });
    sums
}

/// The sums over some segments, on an instruction set.
fn segment_sums(set: InstructionSet, blocked: Blocked<'_>, samples: usize) -> Sums {
    let [i, j] = targets(&scene());
    let targets = [&i, &j];
    sums(set, &Segments { targets, blocked }, samples)
}

#[test]
fn all_instruction_sets_give_the_same_bits() {
    let mesh = scene();
    let (targets, blockers) = (targets(&mesh), blockers(&mesh));
    let run = |set| {
        let lines =
            |from: usize, across: usize| Lines::new(&targets[from], &targets[across], &blockers);
        let all = [
            segment_sums(set, Blocked::By(&blockers), 100),
            sums(set, &lines(0, 1), 100),
            sums(set, &lines(1, 0), 100),
        ];
        all.map(|sums| [sums.all, sums.visible, sums.squares])
    };
    let portable = InstructionSet::available().pop().unwrap();
    for set in InstructionSet::available() {
        assert_eq!(run(set), run(portable), "{}", set.name());
    }
}

/// Faces that are listed block what the tree of all faces says is blocked.
#[test]
fn lists_and_trees_agree() {
    let mesh = scene();
    let occluders = Occluders::new(&mesh);
    let faces = [0, 1].map(|k: usize| mesh.patches[k].face);
    let set = InstructionSet::current();
    let listed = segment_sums(set, Blocked::By(&blockers(&mesh)), 500);
    let traced = segment_sums(set, Blocked::Somehow(&occluders, faces), 500);
    assert_eq!(listed.visible, traced.visible);
}

/// Lines across a triangle or a trapezoid find the share that segments find, within both errors.
#[test]
fn lines_and_segments_agree() {
    let mesh = scene();
    let [i, j] = targets(&mesh);
    let blockers = blockers(&mesh);
    let stream = || Stream::of_pair(0, 0, 1);
    let segments = Segments {
        targets: [&i, &j],
        blocked: Blocked::By(&blockers),
    };
    let expected = share(&segments, stream(), 0.0);
    for (from, across) in [(&i, &j), (&j, &i)] {
        let lines = Lines::new(from, across, &blockers);
        let found = share(&lines, stream(), 0.0);
        assert!(found.error < 0.5 * expected.error);
        let error = 4.0 * (found.error + expected.error);
        assert!(
            (found.value - expected.value).abs() < error,
            "{found:?} {expected:?}"
        );
    }
}

/// The mean of the kernel over the points is the unoccluded exchange, on a trapezoid and on a
/// triangle: points and weights are uniform in area. Their error is known from the shifts.
#[test]
fn points_are_uniform() {
    let mesh = scene();
    let points = 4096;
    let found = segment_sums(InstructionSet::current(), Blocked::By(&[]), points);
    assert_eq!(found.all, found.visible);
    let [i, j] = [0, 1].map(|k: usize| &mesh.patches[k]);
    let corners = |k: usize| mesh.patches[k].polygon.corners();
    let exact = crate::contour::exchange(corners(0), corners(1), 1e-12);
    // On triangles the Jacobian is left out.
    let scale = j.area / (std::f64::consts::PI * points as f64);
    for sum in found.all {
        assert!((scale * sum / exact - 1.0).abs() < 1e-3, "{sum}");
    }
    let kernel = exchange::kernel(i.centroid, i.normal, j.centroid, j.normal);
    assert!((exact / (i.area * j.area * kernel) - 1.0).abs() < 0.2);
}

/// More points, a smaller error; never less than one in all points.
#[test]
fn errors_are_as_small_as_wanted() {
    let mesh = scene();
    let [i, j] = targets(&mesh);
    let blockers = blockers(&mesh);
    let measure = |wanted| {
        let segments = Segments {
            targets: [&i, &j],
            blocked: Blocked::By(&blockers),
        };
        share(&segments, Stream::of_pair(0, 0, 1), wanted)
    };
    let fine = measure(0.0);
    for wanted in [0.1, 0.01, 0.003] {
        let rough = measure(wanted);
        assert!(rough.error <= wanted);
        assert!((rough.value - fine.value).abs() < 4.0 * wanted);
    }
    assert!((0.1..0.9).contains(&fine.value));
    assert!(fine.error >= 1.0 / (LANES * MOST) as f64);
}

/// The variance that shifts leave of a lattice, for a worst function of the first coordinates with
/// bounded slopes at the borders: folded, its spectrum falls as the square of each frequency. The sum
/// of their fourth powers is Bernoulli's polynomial.
fn variance(coordinates: usize, samples: usize) -> f64 {
    let spectrum = |x: f64| {
        let bernoulli = x.powi(4) - 2.0 * x.powi(3) + x * x - 1.0 / 30.0;
        1.0 - std::f64::consts::TAU.powi(4) / 24.0 * bernoulli
    };
    let at = |k: usize| {
        (0..coordinates)
            .map(|c| spectrum(on_lattice(k, c)))
            .product::<f64>()
    };
    (0..samples).map(at).sum::<f64>() / samples as f64 - 1.0
}

/// From eight points to the most, four times as many never leave more than a sixteenth of the
/// variance of lines, and an eighth of that of rays and segments.
#[test]
fn lattices_of_all_sizes_are_good() {
    for (coordinates, gain) in [(3, 16.0), (4, 8.0)] {
        let mut samples = 8;
        while 4 * samples <= MOST {
            let (few, many) = [samples, 4 * samples]
                .map(|n| variance(coordinates, n))
                .into();
            assert!(
                gain * many < few,
                "{coordinates} {samples}: {few:.2e} {many:.2e}"
            );
            samples *= 2;
        }
    }
}

/// The shadow of a square on one parallel to it has edges along those of the square. Lines along its
/// diagonal know more of it than lines along its edges, of which some run along the shadow's.
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
    let surfaces = [below, [a, d, c, b], between].map(|corners| Surface {
        shape: Shape::Quad(corners),
        divisions: None,
    });
    let mesh = subdivide(&surfaces, Divisions::uniform(1)).unwrap();
    let ([i, j], blockers) = (targets(&mesh), blockers(&mesh));
    let mut along_edges = j.clone();
    along_edges.fans = [[c, a, b], [a, c, d]].map(Fan::new).into();
    let share = |across: &Target, samples: usize| {
        let lines = Lines::new(&i, across, &blockers);
        let sums = sums(InstructionSet::current(), &lines, samples);
        ratio(&sums.visible, &sums.all)
    };
    let (expected, _) = share(&j, MOST);
    let (value, error) = share(&j, 64);
    assert!((value - expected).abs() < 4.0 * error);
    let (value, error_along_edges) = share(&along_edges, 64);
    assert!((value - expected).abs() < 4.0 * error_along_edges);
    assert!(
        2.0 * error < error_along_edges,
        "{error} {error_along_edges}"
    );
}
