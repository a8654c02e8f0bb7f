//! Closed form factors are an artifact of their own.

use radiosity::cache::Store;
use radiosity::form_factors::Mode;
use radiosity::geometry::Divisions;
use radiosity::stages::FormFactorsMade;
use radiosity::{Context, Project, Provenance, Silent, estimate, solve, subdivide};
use radiosity_tests::shipped;
use std::path::Path;
use tempfile::TempDir;

fn project(closure: bool) -> Project {
    let mut project = shipped("cornell-closed");
    project.params.discretization.default = Divisions::uniform(4);
    project.params.form_factors.mode = Mode::Accurate;
    project.params.form_factors.closure = closure;
    project
}

fn in_cache(cache: Option<&Store>) -> Context<'_> {
    Context::new(cache, &Silent)
}

/// The names of artifacts.
fn names(folder: &TempDir) -> Vec<String> {
    let entries = Store::new(folder.path()).list().unwrap();
    let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    entries.iter().map(|entry| name(&entry.path)).collect()
}

#[test]
fn closing_leaves_what_was_estimated_alone() {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    let (raw, closed) = (project(false), project(true));
    let made = |project: &Project, cache: Option<&Store>| {
        let context = in_cache(cache);
        let Project { scene, params, .. } = project;
        let patches = subdivide(scene, &params.discretization, context).unwrap();
        let factors = estimate(&patches, &params.form_factors).unwrap();
        factors.made().unwrap()
    };
    let first = made(&raw, Some(&store));
    let second = made(&closed, Some(&store));
    assert_eq!(
        second.origin.how,
        Provenance::Computed("nothing cached yet".to_owned())
    );
    assert_eq!(made(&raw, Some(&store)).origin.how, Provenance::Cached);
    assert_eq!(made(&closed, Some(&store)).origin.how, Provenance::Cached);
    assert_eq!(names(&folder).len(), 2);
    assert!(first.rows.closure.is_none() && second.rows.closure.is_some());
    let values = |made: &FormFactorsMade| made.form_factors.exchange.matrix().values().to_vec();
    assert_ne!(values(&first), values(&second));
    // With and without a file, and read again: the same.
    let in_memory = made(&closed, None);
    let read = made(&closed, Some(&store));
    assert_eq!(values(&in_memory), values(&second));
    assert_eq!(values(&read), values(&second));
    assert_eq!(in_memory.form_factors.rows, read.form_factors.rows);
    assert_eq!(in_memory.rows, read.rows);
}

#[test]
fn solutions_of_closed_factors_have_keys_of_their_own() {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    for closure in [false, true] {
        let Project { scene, params, .. } = project(closure);
        let context = in_cache(Some(&store));
        let patches = subdivide(&scene, &params.discretization, context).unwrap();
        let factors = estimate(&patches, &params.form_factors).unwrap();
        let solved = solve(&factors, &params.solver).unwrap();
        assert!(!solved.origin.is_cached());
    }
    let names = names(&folder);
    assert_eq!(
        names
            .iter()
            .filter(|name| name.contains("solution"))
            .count(),
        2,
        "{names:?}"
    );
}
