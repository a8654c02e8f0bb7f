//! Laws that hold in whole scenes, whatever the picture.

use radiosity::form_factors::Mode;
use radiosity::geometry::{Divisions, Patch};
use radiosity::{Error, Project, solve};
use radiosity_tests::{Chain, shipped};

/// A shipped scene, cut coarsely so that it takes no time.
fn coarse(name: &str) -> Project {
    let mut project = shipped(name);
    project.params.discretization.default = Divisions::uniform(4);
    project
}

/// Whether a patch of `cornell-closed` lies in part under the cuboid or above the lamp, where it
/// sees back sides.
fn sees_backs(surface: &str, patch: &Patch) -> bool {
    let overlaps = |x: [f64; 2], z: [f64; 2]| {
        let bounds = patch.polygon.bounds();
        let apart = |min: f64, max: f64, [from, to]: [f64; 2]| max <= from || min >= to;
        !apart(bounds.min.x, bounds.max.x, x) && !apart(bounds.min.z, bounds.max.z, z)
    };
    match surface {
        "floor" => overlaps([10.0, 30.0], [80.0, 100.0]),
        "ceiling" => overlaps([40.0, 60.0], [65.0, 85.0]),
        _ => false,
    }
}

/// In a closed room every row sums to 1, but for the error of the regular rule, which is known
/// for this scene: 1.3e-2 on average, 0.67 at worst, where the cuboid touches the floor.
#[test]
fn rows_close_up_to_the_known_error() {
    let mut project = shipped("cornell-closed");
    project.params.form_factors.mode = Mode::Regular;
    let (mean, worst) = row_sum_errors(&project);
    assert!((1.2e-2..1.4e-2).contains(&mean));
    assert!((0.66..0.68).contains(&worst));
}

/// The accurate estimator closes them a hundred times better.
#[test]
fn accurate_rows_close() {
    let mut project = shipped("cornell-closed");
    project.params.form_factors.tolerance = 5e-4;
    let (mean, worst) = row_sum_errors(&project);
    assert!(mean < 1e-4);
    assert!(worst < 3e-3);
}

/// In an open scene, and under and above things, fronts, backs and the background account for all
/// that a patch sees: rays and factors agree within their errors, and on average.
#[test]
fn rows_account_for_everything() {
    let mut project = shipped("cornell");
    project.params.form_factors.mode = Mode::Accurate;
    project.params.form_factors.tolerance = 1e-3;
    let chain = Chain::of(&project);
    let made = chain.made;
    let rows = &made.form_factors.rows;
    let (mut within, mut sum, mut variance) = (0, 0.0, 0.0);
    for row in rows {
        let difference = row.fronts + row.backs + row.background - 1.0;
        let error = row.rays_error + row.error.unwrap();
        within += usize::from(difference.abs() <= 3.0 * error + 1e-4);
        sum += difference;
        variance += row.rays_error.powi(2);
    }
    let count = rows.len() as f64;
    let (mean, noise) = (sum / count, variance.sqrt() / count);
    println!("mean of fronts + backs + background - 1: {mean:+.2e} +- {noise:.1e}");
    println!("{within} of {} rows within three errors", rows.len());
    // Eight shifts know their scatter to a quarter: more than one in 370 may be out.
    assert!(within as f64 > 0.97 * count);
    assert!(mean.abs() < 4.0 * noise + 1e-4);
    assert!(rows.iter().any(|row| row.backs > 0.9), "above the lamp");
    assert!(
        rows.iter().any(|row| row.background > 0.1),
        "at the opening"
    );
}

/// The mean and the largest |row sum - 1| over patches of `cornell-closed` that see no backs.
fn row_sum_errors(project: &Project) -> (f64, f64) {
    let chain = Chain::of(project);
    let made = chain.made;
    let rows = chain
        .patches
        .mesh
        .patches
        .iter()
        .zip(&made.form_factors.rows)
        .enumerate();
    let errors: Vec<f64> = rows
        .filter(|(index, (patch, _))| !sees_backs(chain.patches.surface_name(*index), patch))
        .map(|(_, (_, row))| row.fronts - 1.0)
        .collect();
    let mean = errors.iter().map(|e| e.abs()).sum::<f64>() / errors.len() as f64;
    let worst = errors.iter().map(|e| e.abs()).fold(0.0, f64::max);
    println!(
        "{} rows: |row sum - 1| {mean:.2e} on average, {worst:.2e} at worst",
        errors.len()
    );
    println!(
        "{} rows over 1.001",
        errors.iter().filter(|&&e| e > 1e-3).count()
    );
    (mean, worst)
}

/// `A_i F_ij = A_j F_ji`, with `F_ij` computed from the side of `i` in one scene and of `j` in
/// the same scene with its surfaces in reverse order. Single precision keeps the distances between
/// touching patches to 24 * 2^-24, and the kernel goes with their squares. Many segments graze
/// edges in this scene of round numbers; they are decided the same way from either end.
#[test]
fn exchange_is_reciprocal() {
    let mut project = coarse("cornell-closed");
    project.params.form_factors.mode = Mode::Regular;
    let mut reversed = project.clone();
    reversed.scene.surfaces.reverse();
    let chains = [&project, &reversed].map(Chain::of);
    let made = chains.map(|chain| chain.made);
    let [a, b] = [&made[0], &made[1]].map(|made| &made.form_factors);
    let [here, there] = chains.map(|chain| &chain.patches.mesh);
    let last_face = here.faces.len() - 1;
    let place = |patch: usize| {
        let patch = &here.patches[patch];
        let face = &there.faces[last_face - patch.face.index()];
        face.first_patch + (patch.cell[0] * 4 + patch.cell[1]) as usize
    };
    for i in 0..a.areas.len() {
        for j in 0..i {
            let forth = a.areas[i] * a.factor(i, j);
            let back = b.areas[place(j)] * b.factor(place(j), place(i));
            assert!(
                (forth - back).abs() <= 48.0 / f64::from(1 << 24) * forth,
                "{i} {j}: {forth} {back}"
            );
        }
    }
}

/// `B = E / (1 - rho)` in a furnace, if rows sum to 1. With row sums between `low` and `high`
/// it lies between `E / (1 - rho low)` and `E / (1 - rho high)`: the system is monotone.
#[test]
fn the_furnace_is_uniform_up_to_its_row_sums() {
    let mut project = shipped("furnace");
    project.params.form_factors.mode = Mode::Regular;
    let chain = Chain::of(&project);
    let made = chain.made;
    let sums = || made.form_factors.rows.iter().map(|row| row.fronts);
    let (low, high) = (sums().fold(2.0, f64::min), sums().fold(0.0, f64::max));
    let material = &project.scene.materials[0];
    for b in chain.light().radiosity {
        for c in 0..3 {
            let bound = |sum: f64| material.emission[c] / (1.0 - material.reflectance[c] * sum);
            // The residual of 1e-6 leaves an error of at most 1e-6 / (1 - 0.8 high).
            let slack = 1.0 + 1e-5;
            let b = f64::from(b[c]);
            assert!(b >= bound(low) / slack && b <= bound(high) * slack, "{b}");
        }
    }
}

#[test]
fn black_rooms_show_their_lamps_alone() {
    let mut project = coarse("cornell");
    for material in &mut project.scene.materials {
        material.reflectance = [0.0; 3];
    }
    let chain = Chain::of(&project);
    for (index, b) in chain.light().radiosity.into_iter().enumerate() {
        let emitted = if chain.patches.surface_name(index) == "light" {
            12.0
        } else {
            0.0
        };
        assert_eq!(b, [emitted; 3]);
    }
}

#[test]
fn radiosity_is_linear_in_emission() {
    let project = coarse("cornell");
    let mut brighter = project.clone();
    for material in &mut brighter.scene.materials {
        material.emission = material.emission.map(|e| 4.0 * e);
    }
    let [one, four] = [&project, &brighter].map(|project| Chain::of(project).light());
    for (one, four) in one.radiosity.iter().zip(&four.radiosity) {
        // A power of two moves exponents only.
        assert_eq!(one.map(|c| 4.0 * c), *four);
    }
}

#[test]
fn lamps_emit_what_they_say() {
    let lamp = 12.0 * 400.0;
    let emitted = Chain::of(&coarse("cornell")).light().energy.emitted;
    assert!(emitted.iter().all(|e| (e / lamp - 1.0).abs() < 1e-12));
}

/// The error of a system that makes light names the surface that does.
#[test]
fn impossible_reflectances_name_their_surfaces() {
    let mut project = coarse("cornell-closed");
    project.params.form_factors.mode = Mode::Regular;
    for material in &mut project.scene.materials {
        material.reflectance = [1.0; 3];
    }
    let chain = Chain::of(&project);
    let Err(error) = solve(chain.factors, &project.params.solver) else {
        panic!("rows over 1 at reflectance 1 must diverge");
    };
    assert!(matches!(error, Error::Unsolvable { .. }), "{error}");
    let worst = chain.made.rows.largest.1;
    let worst = chain.patches.surface_name(worst as usize);
    let text = error.to_string();
    assert!(
        text.contains(&format!("`{worst}`")) && error.remedy().is_some(),
        "{text}"
    );
}
