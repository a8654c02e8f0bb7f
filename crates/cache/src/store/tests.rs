//! An artifact is found by its stage and key, whatever the scene is called that asks for it.

use crate::{Entry, Id, Key, Miss, Store, last_user};
use std::fs;
use std::sync::mpsc;
use tempfile::TempDir;

fn id(scene: &str, input: u32) -> Id<'_> {
    Id {
        scene,
        stage: "form-factors",
        key: Key::of("form-factors", 1, &input),
    }
}

/// With an artifact of the scene `box`.
fn written() -> (TempDir, Store) {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    store.write(&id("box", 1), &7u8, &[1.0, 2.0]).unwrap();
    (folder, store)
}

fn read(store: &Store, id: &Id<'_>) -> Result<Vec<f32>, Miss> {
    let (facts, values) = store.read::<u8>(id)?.into_values()?;
    assert_eq!(facts, 7);
    Ok(values.as_ref().to_vec())
}

fn only_entry(store: &Store) -> Entry {
    let [entry] = <[Entry; 1]>::try_from(store.list().unwrap()).expect("one file");
    entry
}

#[test]
fn scenes_of_other_names_share_an_artifact() {
    let (_folder, store) = written();
    for scene in ["box", "copy", "", "a/b", "-form-factors-"] {
        assert_eq!(read(&store, &id(scene, 1)).unwrap(), [1.0, 2.0], "{scene}");
    }
    store.write(&id("copy", 1), &7u8, &[1.0, 2.0]).unwrap();
    assert_eq!(store.list().unwrap().len(), 1);
}

#[test]
fn scenes_of_other_names_share_a_lock() {
    let (_folder, store) = written();
    let first = store.lock(&id("box", 1), || panic!("nobody has it"));
    std::thread::scope(|scope| {
        let (waits, told) = mpsc::channel();
        let store = &store;
        let wait = move || waits.send(()).unwrap();
        let second = scope.spawn(move || store.lock(&id("copy", 1), wait).map(drop));
        told.recv().expect("the second waits");
        drop(first);
        second.join().unwrap().unwrap();
    });
}

#[test]
fn absence_tells_new_from_changed() {
    let (_folder, store) = written();
    let absence = |id: &Id<'_>| store.read::<u8>(id).unwrap_err();
    assert!(matches!(absence(&id("box", 2)), Miss::InputsChanged));
    assert!(matches!(absence(&id("copy", 2)), Miss::Nothing));
    let other_stage = Id {
        stage: "solution",
        ..id("box", 1)
    };
    assert!(matches!(absence(&other_stage), Miss::Nothing));
    read(&store, &id("copy", 1)).unwrap();
    assert!(matches!(absence(&id("copy", 2)), Miss::InputsChanged));
}

#[test]
fn the_last_user_is_named() {
    let (_folder, store) = written();
    assert_eq!(only_entry(&store).scene.as_deref(), Some("box"));
    read(&store, &id("copy", 1)).unwrap();
    assert_eq!(only_entry(&store).scene.as_deref(), Some("copy"));
    let path = store.path(&id("box", 1));
    fs::write(path.with_extension("bin.used"), [0xff, 0xfe]).unwrap();
    assert_eq!(last_user(&path), None);
    assert!(read(&store, &id("box", 1)).is_ok(), "notes do no harm");
}

/// Once the scene's name stood before the stage.
#[test]
fn files_with_former_names_are_found() {
    let (folder, store) = written();
    store.write(&id("box", 2), &7u8, &[3.0]).unwrap();
    for input in [1, 2] {
        let path = store.path(&id("box", input));
        let name = path.file_name().unwrap().to_str().unwrap();
        fs::rename(&path, folder.path().join(format!("room-1-{name}"))).unwrap();
        fs::remove_file(path.with_extension("bin.used")).unwrap();
    }
    assert_eq!(read(&store, &id("box", 1)).unwrap(), [1.0, 2.0]);
    assert!(store.path(&id("box", 1)).exists());
    assert!(!store.path(&id("box", 2)).exists());
    assert_eq!(store.list().unwrap().len(), 2);
    assert_eq!(read(&store, &id("copy", 2)).unwrap(), [3.0]);
}
