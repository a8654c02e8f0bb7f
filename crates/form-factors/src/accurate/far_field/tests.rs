//! Gauss's rules against the contour integral, and lanes against the plain sum.

use super::*;
use crate::accurate::contour;
use crate::kernel::kernel;
use radiosity_geometry::{Divisions, subdivide};
use radiosity_simd::InstructionSet;
use radiosity_test_kit::random::{spanned, vector};
use radiosity_test_kit::surface;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

fn random_element(rng: &mut Pcg64Mcg, spread: f64) -> Option<PatchQuadrature> {
    let corner = vector(rng, spread);
    let (edge_a, edge_b) = (vector(rng, 2.0), vector(rng, 2.0));
    let surface = surface(spanned(rng, corner, edge_a, edge_b));
    let mesh = subdivide(&[surface], Divisions::uniform(1)).ok()?;
    Some(PatchQuadrature::new(&mesh.patches[0]))
}

/// The plain sum.
fn all_pairs(i: &PatchQuadrature, j: &PatchQuadrature, rule: usize) -> f64 {
    let pairs = i.rules[rule]
        .iter()
        .flat_map(|p| j.rules[rule].iter().map(move |q| (p, q)));
    let weighted = |(p, q): (
        &crate::sampling::points::Sample,
        &crate::sampling::points::Sample,
    )| { p.area * q.area * kernel(p.point, i.normal, q.point, j.normal) };
    pairs.map(weighted).sum()
}

fn ratio(i: &PatchQuadrature, j: &PatchQuadrature) -> f64 {
    (i.radius + j.radius) / i.centroid.distance(j.centroid)
}

fn face_whole(i: &PatchQuadrature, j: &PatchQuadrature) -> bool {
    let in_front = |a: &PatchQuadrature, b: &PatchQuadrature| {
        b.corners()
            .iter()
            .all(|&corner| a.normal.dot(corner - a.centroid) >= 0.0)
    };
    in_front(i, j) && in_front(j, i)
}

/// Random triangles and parallelograms in front of each other: 98 in 100 keep the bound, and none
/// exceeds three times that.
#[test]
fn rules_keep_their_error() {
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    for (rule, constant) in ERROR.into_iter().enumerate() {
        let (mut kept, mut count) = (0, 0);
        while count < 2000 {
            let pair = (
                random_element(&mut rng, 0.0),
                random_element(&mut rng, 20.0),
            );
            let (Some(i), Some(j)) = pair else { continue };
            let ratio = ratio(&i, &j);
            if !face_whole(&i, &j) || ratio > 0.5 {
                continue;
            }
            let exact = contour::exchange(i.corners(), j.corners(), 1e-12).value;
            let found = all_pairs(&i, &j, rule);
            let bound = constant * ratio.powi(2 * (rule as i32 + 1));
            let squarely = i.area() * j.area() / (PI * i.centroid.distance_squared(j.centroid));
            // The contour integral has its own error, of 1e-9 of the squares of lengths.
            let error = (found - exact).abs() / squarely - 1e-9 / ratio.powi(2);
            assert!(error < 3.0 * bound, "{rule}: {error} {bound}");
            kept += usize::from(error < bound);
            count += 1;
        }
        assert!(100 * kept >= 98 * count, "{rule}: {kept} of {count}");
    }
}

/// Tiles of one to eight patches: each lane is the plain sum by the smallest rule that will do, on
/// all instruction sets to the bit, and lanes that are too near or not in front have none.
#[test]
fn lanes_are_plain_sums() {
    let mut rng = Pcg64Mcg::seed_from_u64(2);
    let mut by_rule = [0; RULES + 1];
    for round in 0..3000 {
        let error = [1e-3, 0.05][round % 2];
        let Some(i) = random_element(&mut rng, 0.0) else {
            continue;
        };
        let others = (0..1 + round % LANES).filter_map(|_| random_element(&mut rng, 15.0));
        let others: Vec<PatchQuadrature> = others.collect();
        if others.is_empty() {
            continue;
        }
        let tile = FarTile::new(&others.iter().map(Some).collect()).unwrap();
        let found = exchange(&i, &tile, error, 0.0);
        for (lane, j) in others.iter().enumerate() {
            let will_do =
                |&rule: &usize| ERROR[rule] * ratio(&i, j).powi(2 * (rule as i32 + 1)) < error;
            let rule = (0..RULES).find(will_do).filter(|_| face_whole(&i, j));
            by_rule[rule.unwrap_or(RULES)] += 1;
            match (rule, found[lane]) {
                (Some(rule), Some(PairEstimate { value, .. })) => {
                    let plain = all_pairs(&i, j, rule);
                    // As many roundings as there are pairs of points, and those of a pair.
                    assert!((value - plain).abs() <= 1e-13 * plain, "{value} {plain}");
                }
                (None, None) => {}
                (rule, found) => panic!("{rule:?} {found:?}"),
            }
        }
        assert!(found[others.len()..].iter().all(Option::is_none));
        let (patch, tile, error, tolerance) = (&i, &tile, error, 0.0);
        let values = |set: InstructionSet| {
            let found = set.run(Far {
                patch,
                tile,
                error,
                tolerance,
            });
            found.values.map(f64::to_bits)
        };
        let all: Vec<_> = InstructionSet::available()
            .into_iter()
            .map(values)
            .collect();
        assert!(all.iter().all(|other| *other == all[0]));
    }
    assert!(by_rule.iter().all(|&count| count > 100), "{by_rule:?}");
}
