//! Nothing is computed twice, and nothing stale or damaged is ever used.
//!
//! Long because: one test for each reason to compute anew.

mod bench;

use bench::{Bench, Outcome, changed_both, changed_solution, none};
use radiosity::cache::{Limits, Store};
use radiosity::form_factors::Mode;
use radiosity::geometry::{Camera, DVec3, Divisions};
use radiosity::image::Exposure;
use radiosity::scene::{Material, Scene};
use radiosity::solver::{Method, Relaxation};
use radiosity::{
    Context, Observer, Project, Provenance, Silent, Stage, estimate, solve_anew, subdivide,
};
use radiosity_tests::shipped;
use std::fs;
use std::sync::Mutex;
use tempfile::TempDir;

#[test]
fn a_cold_run_equals_a_warm_one_byte_for_byte() {
    let bench = Bench::warm();
    let cold = Outcome::of(&bench.project, None);
    let warm = Outcome::of(&bench.project, Some(&bench.store()));
    assert_eq!(cold.solution, warm.solution);
    assert_eq!(cold.pictures, warm.pictures);
    // Solving from cached form factors gives the same bytes too.
    fs::remove_file(bench.file("solution")).unwrap();
    let solved = bench.solve();
    assert_eq!(solved.form_factors.reason(), None);
    assert_eq!(solved.solution, cold.solution);
    // And so do files: a second cold run writes the same ones.
    let other = Bench::warm();
    for stage in ["form-factors", "solution"] {
        let [a, b] = [&bench, &other].map(|bench| fs::read(bench.file(stage)).unwrap());
        assert_eq!(a, b);
    }
}

#[test]
fn the_first_run_computes_and_the_second_does_not() {
    let bench = Bench::warm();
    assert_eq!(bench.reasons(), none());
    bench.store().clean(Limits::default()).unwrap();
    let nothing = Some("nothing cached yet".to_owned());
    assert_eq!(bench.reasons(), (nothing.clone(), nothing));
}

#[test]
fn pictures_depend_on_no_artifact_key() {
    assert_eq!(Bench::after(|p| p.params.image.width = 99), none());
    assert_eq!(
        Bench::after(|p| p.params.image.exposure = Exposure::Fixed(2.0)),
        none()
    );
    assert_eq!(Bench::after(|p| p.params.image.samples = 1), none());
    let camera = Camera::new(DVec3::ZERO, DVec3::Z, DVec3::Y, 40.0, 0.0).unwrap();
    assert_eq!(Bench::after(|p| p.scene.camera = Some(camera)), none());
}

#[test]
fn names_depend_on_no_artifact_key() {
    assert_eq!(
        Bench::after(|p| p.scene.surfaces[0].name = "elsewhere".to_owned()),
        none()
    );
    assert_eq!(
        Bench::after(|p| p.scene.materials[0].name = "renamed".to_owned()),
        none()
    );
}

#[test]
fn the_scenes_name_depends_on_no_artifact_key() {
    assert_eq!(Bench::after(|p| p.scene.name = "copy".to_owned()), none());
}

#[test]
fn a_changed_reflectance_needs_a_solution() {
    assert_eq!(
        Bench::after(|p| p.scene.materials[0].reflectance[1] = 0.5),
        changed_solution()
    );
}

#[test]
fn a_changed_emission_needs_a_solution() {
    assert_eq!(
        Bench::after(|p| lamp(&mut p.scene).emission[1] = 0.5),
        changed_solution()
    );
}

fn lamp(scene: &mut Scene) -> &mut Material {
    let mut materials = scene.materials.iter_mut();
    materials.find(|material| material.light.is_some()).unwrap()
}

#[test]
fn dimmed_lights_need_nothing() {
    assert_eq!(Bench::after(|p| p.scene.lights[0].dim = 0.5), none());
    assert_eq!(Bench::after(|p| p.scene.lights[0].tint[2] = 7.0), none());
    assert_eq!(
        Bench::after(|p| p.scene.lights[0].name = "renamed".to_owned()),
        none()
    );
}

#[test]
fn a_changed_solver_setting_needs_a_solution() {
    assert_eq!(
        Bench::after(|p| p.params.solver.residual = 1e-4),
        changed_solution()
    );
    assert_eq!(
        Bench::after(|p| p.params.solver.max_sweeps = 3),
        changed_solution()
    );
}

#[test]
fn settings_that_the_method_ignores_need_nothing() {
    let mut bench = Bench::warm();
    bench.project.params.solver.method = Method::ConjugateGradients;
    bench.solve();
    bench.project.params.solver.relaxation = Relaxation::Factor(1.3);
    assert_eq!(bench.reasons(), none());
}

#[test]
fn a_changed_shape_needs_everything() {
    let change = |p: &mut Project| p.scene.surfaces.swap(0, 1);
    assert_eq!(Bench::after(change), changed_both());
}

#[test]
fn a_changed_subdivision_needs_everything() {
    assert_eq!(
        Bench::after(|p| p.params.discretization.default = Divisions::uniform(2)),
        changed_both()
    );
}

#[test]
fn a_changed_estimator_needs_everything() {
    assert_eq!(
        Bench::after(|p| p.params.form_factors.points = 2),
        changed_both()
    );
    assert_eq!(
        Bench::after(|p| p.params.form_factors.mode = Mode::MonteCarlo),
        changed_both()
    );
}

#[test]
fn settings_that_the_estimator_ignores_need_nothing() {
    assert_eq!(Bench::after(|p| p.params.form_factors.seed = 7), none());
    assert_eq!(
        Bench::after(|p| p.params.form_factors.pairs = Some(7)),
        none()
    );
}

#[test]
fn a_seed_matters_to_monte_carlo() {
    let mut bench = Bench::warm();
    bench.project.params.form_factors.mode = Mode::MonteCarlo;
    bench.solve();
    bench.project.params.form_factors.seed = 7;
    assert_eq!(bench.reasons(), changed_both());
}

#[test]
fn changing_back_finds_the_old_files() {
    let mut bench = Bench::warm();
    bench.project.scene.materials[0].reflectance[1] = 0.5;
    bench.solve();
    let original = shipped("cornell-course");
    bench.project.scene.materials = original.scene.materials;
    assert_eq!(bench.reasons(), none());
}

#[test]
fn damage_is_noticed_named_and_mended() {
    type Damage = fn(&mut Vec<u8>);
    let kinds: [(Damage, &str); 6] = [
        (|b| b.clear(), "the cached file is not a cache file"),
        (|b| b.truncate(b.len() - 5), "bytes instead of"),
        (|b| b.extend([0; 9]), "bytes instead of"),
        (|b| b[8] += 1, "format version 2"),
        (|b| b[70] ^= 4, "header is damaged"),
        (|b| *b.last_mut().unwrap() ^= 1, "data is damaged (block 0)"),
    ];
    let bench = Bench::warm();
    let good = bench.solve().solution;
    for (damage, reason) in kinds {
        bench.damage("solution", damage);
        let solved = bench.solve();
        let because = solved.origin.reason().unwrap().to_owned();
        assert!(because.contains(reason), "{because}");
        assert_eq!(solved.solution, good);

        bench.damage("form-factors", damage);
        fs::remove_file(bench.file("solution")).unwrap();
        let solved = bench.solve();
        let because = solved.form_factors.reason().unwrap().to_owned();
        assert!(because.contains(reason), "{because}");
        assert_eq!(solved.solution, good);
        assert_eq!(bench.reasons(), none(), "what was damaged is mended");
    }
}

/// Form factors that another scene left under the key prefix of this one's.
#[test]
fn a_file_with_another_key_is_not_believed() {
    let mut bench = Bench::warm();
    let (here, good) = (bench.file("form-factors"), bench.solve().solution);
    bench.project.params.form_factors.points = 2;
    let other = TempDir::new().unwrap();
    let store = Store::new(other.path());
    let impostor = Outcome::of(&bench.project, Some(&store));
    let impostor = impostor.form_factors.file.unwrap();
    fs::rename(impostor, here).unwrap();
    fs::remove_file(bench.file("solution")).unwrap();
    bench.project.params.form_factors.points = 3;
    let solved = bench.solve();
    let because = solved.form_factors.reason();
    assert_eq!(because, Some("the cached file belongs to another key"));
    assert_eq!(solved.solution, good);
}

#[test]
fn losing_the_form_factors_costs_nothing_while_the_solution_stands() {
    let bench = Bench::warm();
    fs::remove_file(bench.file("form-factors")).unwrap();
    let solved = bench.solve();
    assert_eq!(
        (solved.origin.how, solved.form_factors.how),
        (Provenance::Cached, Provenance::NotNeeded)
    );
}

#[test]
fn recomputing_on_demand_says_so() {
    let bench = Bench::warm();
    let store = bench.store();
    let context = Context::new(Some(&store), &Silent);
    let Project { scene, params, .. } = &bench.project;
    let patches = subdivide(scene, &params.discretization, context).unwrap();
    let factors = estimate(&patches, &params.form_factors).unwrap();
    let solved = solve_anew(&factors, &params.solver).unwrap();
    assert_eq!(solved.origin.reason(), Some("asked for"));
    assert_eq!(solved.form_factors.reason(), None);
    let others = estimate(&patches, &params.form_factors).unwrap();
    let made = others.made_anew().unwrap();
    assert_eq!(made.origin.reason(), Some("asked for"));
}

/// Collects notes.
#[derive(Default)]
struct Notes(Mutex<Vec<String>>);

impl Observer for Notes {
    fn begin(&self, _: Stage, _: u64) {}
    fn advance(&self, _: u64) {}
    fn end(&self) {}
    fn note(&self, message: &str) {
        self.0.lock().unwrap().push(message.to_owned());
    }
}

#[test]
fn a_cache_that_cannot_be_written_costs_a_note() {
    let bench = Bench::warm();
    let file = bench.folder.path().join("not-a-folder");
    fs::write(&file, b"").unwrap();
    let store = Store::new(&file);
    let notes = Notes::default();
    let context = Context::new(Some(&store), &notes);
    let solved = Outcome::in_context(&bench.project, context);
    assert_eq!(solved.solution, bench.solve().solution);
    let notes = notes.0.into_inner().unwrap();
    assert!(
        notes.iter().any(|note| note.contains("not-a-folder")),
        "{notes:?}"
    );
}

/// Two at once, whatever they call the scene: one computes, the other waits and takes what the
/// first has made.
#[test]
fn two_processes_share_the_work() {
    let bench = &Bench::warm();
    for names in [["cornell", "cornell"], ["cornell", "copy"]] {
        bench.store().clean(Limits::default()).unwrap();
        let computed = std::thread::scope(|scope| {
            let of = |name| scope.spawn(move || bench.reasons_as(name));
            let reasons = names.map(of).map(|thread| thread.join().unwrap());
            reasons.iter().filter(|&reasons| *reasons != none()).count()
        });
        assert_eq!(computed, 1, "{names:?}");
    }
}
