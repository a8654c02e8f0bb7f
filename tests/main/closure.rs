//! Closed form factors are an artifact of their own.

use radiosity::cache::Store;
use radiosity::geometry::Divisions;
use radiosity::scene::{Mode, Scene};
use radiosity::{How, Pipeline, Silent, Sources};
use radiosity_tests::shipped;
use std::path::Path;
use tempfile::TempDir;

fn scene(closure: bool) -> Scene {
    let mut scene = shipped("cornell-closed");
    scene.divisions = Divisions::uniform(4);
    scene.form_factors.mode = Mode::Accurate;
    scene.form_factors.closure = closure;
    scene
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
    let (raw, closed) = (scene(false), scene(true));
    let made = |scene: &Scene, store: Option<&Store>| {
        let pipeline = Pipeline::new(scene, store, &Silent).unwrap();
        pipeline.form_factors(Sources::Cached).unwrap()
    };
    let first = made(&raw, Some(&store));
    let second = made(&closed, Some(&store));
    assert_eq!(
        second.origin.how,
        How::Computed("nothing cached yet".to_owned())
    );
    assert_eq!(made(&raw, Some(&store)).origin.how, How::Cached);
    assert_eq!(made(&closed, Some(&store)).origin.how, How::Cached);
    assert_eq!(names(&folder).len(), 2);
    assert!(first.rows.closure.is_none() && second.rows.closure.is_some());
    let values = |made: &radiosity::FormFactorsMade| made.form_factors.exchange.values().to_vec();
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
        let scene = scene(closure);
        let pipeline = Pipeline::new(&scene, Some(&store), &Silent).unwrap();
        let solved = pipeline.solution(Sources::Cached).unwrap();
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
