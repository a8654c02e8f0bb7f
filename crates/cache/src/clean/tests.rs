//! What is removed is what the limits say, and nothing that is in use or somebody else's.

use crate::{Amount, Cleaned, Id, Key, Limits, Store};
use std::fs::{self, File};
use std::path::PathBuf;
use std::time::{Duration, SystemTime};
use tempfile::TempDir;

const DAY: Duration = Duration::from_secs(24 * 3600);

fn id(input: u32) -> Id<'static> {
    Id {
        scene: "box",
        stage: "solution",
        key: Key::of("solution", 1, &input),
    }
}

/// Artifacts of 1, 2, … that were last used so many days ago; all have the same size.
fn used_days_ago(days: &[u32]) -> (TempDir, Store) {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    for (input, &days) in (1..).zip(days) {
        store.write(&id(input), &(), &[1.0; 100]).unwrap();
        set_last_use(&store, input, SystemTime::now() - DAY * days);
    }
    (folder, store)
}

fn last_use_file(store: &Store, input: u32) -> PathBuf {
    store.path(&id(input)).with_extension("bin.used")
}

fn set_last_use(store: &Store, input: u32, time: SystemTime) {
    for path in [store.path(&id(input)), last_use_file(store, input)] {
        let file = File::options().write(true).open(path).unwrap();
        file.set_modified(time).unwrap();
    }
}

fn size(store: &Store, input: u32) -> u64 {
    fs::metadata(store.path(&id(input))).unwrap().len()
}

/// Which of the first four artifacts are there.
fn there(store: &Store) -> Vec<u32> {
    let is_there = |input: &u32| store.path(&id(*input)).exists();
    (1..=4).filter(is_there).collect()
}

fn older_than(days: u32) -> Limits {
    Limits {
        age: Some(DAY * days),
        bytes: None,
    }
}

fn at_most(bytes: u64) -> Limits {
    Limits {
        age: None,
        bytes: Some(bytes),
    }
}

#[test]
fn without_limits_everything_goes() {
    let (folder, store) = used_days_ago(&[9, 0]);
    let (one, cleaned) = (size(&store, 1), store.clean(Limits::default()).unwrap());
    let removed = Amount {
        files: 2,
        bytes: 2 * one,
    };
    assert_eq!(
        cleaned,
        Cleaned {
            removed,
            ..Cleaned::default()
        }
    );
    let left = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 0, "neither notes nor locks stay");
    assert_eq!(store.clean(Limits::default()).unwrap(), Cleaned::default());
}

#[test]
fn what_was_not_used_for_long_goes() {
    let (_folder, store) = used_days_ago(&[9, 1, 5, 8]);
    let cleaned = store.clean(older_than(7)).unwrap();
    assert_eq!((cleaned.removed.files, cleaned.left.files), (2, 2));
    assert_eq!(there(&store), [2, 3]);
}

#[test]
fn reading_is_use() {
    let (_folder, store) = used_days_ago(&[9, 9]);
    store.read::<()>(&id(2)).unwrap();
    store.clean(older_than(7)).unwrap();
    assert_eq!(there(&store), [2]);
}

#[test]
fn a_clock_that_was_ahead_does_no_harm() {
    let (_folder, store) = used_days_ago(&[9]);
    set_last_use(&store, 1, SystemTime::now() + DAY);
    store.clean(older_than(7)).unwrap();
    assert_eq!(there(&store), [1]);
}

#[test]
fn the_least_recently_used_go_first() {
    let (_folder, store) = used_days_ago(&[2, 4, 1, 3]);
    let one = size(&store, 1);
    assert_eq!(store.clean(at_most(4 * one)).unwrap().removed.files, 0);
    let cleaned = store.clean(at_most(4 * one - 1)).unwrap();
    let left = Amount {
        files: 3,
        bytes: 3 * one,
    };
    assert_eq!(cleaned.left, left);
    assert_eq!(there(&store), [1, 3, 4]);
    store.clean(at_most(one)).unwrap();
    assert_eq!(there(&store), [3]);
    store.clean(at_most(0)).unwrap();
    assert!(there(&store).is_empty());
}

#[test]
fn both_limits_hold() {
    let (_folder, store) = used_days_ago(&[2, 9, 1, 8]);
    let one = size(&store, 1);
    let both = |bytes| Limits {
        bytes: Some(bytes),
        ..older_than(7)
    };
    store.clean(both(3 * one)).unwrap();
    assert_eq!(there(&store), [1, 3]);
    store.clean(both(one)).unwrap();
    assert_eq!(there(&store), [3]);
}

#[test]
fn what_is_in_use_stays_and_is_told() {
    let (_folder, store) = used_days_ago(&[9, 8, 1]);
    let one = size(&store, 1);
    let lock = store.lock(&id(1), || ()).unwrap();
    let cleaned = store.clean(at_most(2 * one)).unwrap();
    assert_eq!((cleaned.in_use.files, cleaned.in_use.bytes), (1, one));
    assert_eq!((cleaned.removed.files, cleaned.left.files), (1, 2));
    assert_eq!(there(&store), [1, 3]);
    let cleaned = store.clean(Limits::default()).unwrap();
    assert_eq!((cleaned.in_use.files, cleaned.left.files), (1, 1));
    drop(lock);
    store.clean(Limits::default()).unwrap();
    assert!(there(&store).is_empty());
}

/// Whoever removes files by hand leaves notes of their use.
#[test]
fn notes_without_an_artifact_go() {
    let (folder, store) = used_days_ago(&[0, 0]);
    fs::remove_file(store.path(&id(1))).unwrap();
    let cleaned = store.clean(older_than(7)).unwrap();
    assert_eq!((cleaned.removed.files, cleaned.left.files), (0, 1));
    assert!(!last_use_file(&store, 1).exists());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn what_is_not_cached_stays() {
    let (folder, store) = used_days_ago(&[0]);
    let strangers = [
        "Cargo.lock",
        "firmware.bin",
        "a.partial",
        "a.used",
        "box-0123456789abcdef.txt",
    ];
    for name in strangers {
        fs::write(folder.path().join(name), b"mine").unwrap();
    }
    fs::create_dir(folder.path().join("form-factors-0123456789abcdef.bin")).unwrap();
    for leftover in [
        "form-factors-0123456789abcdee.bin.radiosity-Zz12ab.partial",
        "box-form-factors-0123456789abcdee.bin.journal",
    ] {
        fs::write(folder.path().join(leftover), b"half").unwrap();
    }
    assert_eq!(store.list().unwrap().len(), 1);
    assert_eq!(store.clean(Limits::default()).unwrap().removed.files, 3);
    assert_eq!(
        fs::read_dir(folder.path()).unwrap().count(),
        strangers.len() + 1
    );
}
