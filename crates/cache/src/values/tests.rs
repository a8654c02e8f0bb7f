//! Whoever changes a file while it is used in place is found out.

use crate::{Batch, Draft, Id, Key, Store, Values};
use std::fs::{self, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::path::Path;
use tempfile::TempDir;

fn id(input: u32) -> Id<'static> {
    Id {
        scene: "box",
        stage: "form-factors",
        key: Key::of("form-factors", 1, &input),
    }
}

fn written(count: usize) -> (TempDir, Store, Values) {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    store.write(&id(1), &(), &vec![1.0; count]).unwrap();
    let artifact = store.read::<()>(&id(1)).unwrap();
    let ((), values) = artifact.into_values().unwrap();
    (folder, store, values)
}

/// More values than are read.
fn mapped() -> (TempDir, Store, Values) {
    written(17 << 20)
}

fn overwrite_end(path: &Path) {
    let mut file = OpenOptions::new().write(true).open(path).unwrap();
    file.seek(SeekFrom::End(-4)).unwrap();
    file.write_all(&2f32.to_le_bytes()).unwrap();
}

#[test]
fn nothing_is_made_of_a_file_that_is_changed_while_it_is_mapped() {
    let (folder, store, values) = mapped();
    values.check().unwrap();
    store.write(&id(2), &(), &[]).unwrap();
    overwrite_end(&store.path(&id(1)));
    assert!(values.check().is_err());
    let changed = store.check().unwrap_err();
    assert_eq!(changed.path, store.path(&id(1)));
    let refused = store.write(&id(3), &(), &[]).unwrap_err();
    assert!(
        refused.to_string().contains("was changed while"),
        "{refused}"
    );
    assert!(!store.path(&id(3)).exists());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 4);
    // Nobody uses it any more, but what was made of it is still about.
    drop(values);
    assert!(store.check().is_err());
    assert!(Store::new(folder.path()).check().is_ok());
}

#[test]
fn what_is_replaced_or_removed_is_not_changed() {
    let (_folder, store, values) = mapped();
    store.write(&id(1), &(), &[1.0]).unwrap();
    fs::remove_file(store.path(&id(1))).unwrap();
    store.check().unwrap();
    assert!(values.as_ref().iter().all(|&value| value == 1.0));
}

/// Another process notes that it uses the file, too.
#[test]
fn what_others_read_is_not_changed() {
    let (folder, store, values) = mapped();
    let (_, others) = Store::new(folder.path())
        .read::<()>(&id(1))
        .unwrap()
        .into_values()
        .unwrap();
    values.check().unwrap();
    others.check().unwrap();
    store.check().unwrap();
}

#[test]
fn small_files_are_read_whatever_becomes_of_them() {
    let (_folder, store, values) = written(1000);
    let file = OpenOptions::new().write(true).open(store.path(&id(1)));
    file.unwrap().set_len(0).unwrap();
    store.check().unwrap();
    assert_eq!(values.as_ref(), [1.0; 1000]);
}

/// A draft writes the head into its own file while its values are in use.
#[test]
fn the_end_of_a_draft_is_no_change() {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    let mut draft = Draft::begin(&store, &id(1), &(), 17 << 20).unwrap();
    let batch = Batch::<()> {
        values: vec![vec![1.0; 17 << 20]],
        state: None,
    };
    draft
        .extend([batch], &|error, _| panic!("{error}"))
        .unwrap();
    let values = draft.values().unwrap();
    assert!(draft.finish(&()).unwrap());
    store.check().unwrap();
    overwrite_end(&store.path(&id(1)));
    assert!(store.check().is_err() && values.check().is_err());
}
