//! What must hold for files: round trips, one cause per miss, no trust in damaged bytes.

use crate::digests::BLOCK_VALUES;
use crate::format::ALIGNMENT;
use crate::{Id, Key, Miss, Store};
use proptest::prelude::*;
use std::fs;
use tempfile::TempDir;

type Facts = (u32, Vec<f64>);

fn sample() -> (Facts, Vec<f32>) {
    let values = (0..1000).map(|k| k as f32 * 0.5).collect();
    ((7, vec![1.0, 0.5]), values)
}

fn id(input: u32) -> Id<'static> {
    Id {
        scene: "box",
        stage: "form-factors",
        key: Key::of("form-factors", 1, &input),
    }
}

fn written() -> (TempDir, Store) {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    let (facts, values) = sample();
    store.write(&id(1), &facts, &values).unwrap();
    (folder, store)
}

/// Reads facts and values; the reason for a miss as text.
fn read(store: &Store) -> Result<(Facts, Vec<f32>), String> {
    let artifact = store
        .read::<Facts>(&id(1))
        .map_err(|miss| miss.to_string())?;
    let (facts, values) = artifact.into_values().map_err(|miss| miss.to_string())?;
    Ok((facts, values.as_ref().to_vec()))
}

/// The miss after the file's bytes went through `damage`.
fn miss_after(damage: impl FnOnce(&mut Vec<u8>)) -> String {
    let (_folder, store) = written();
    let path = store.path(&id(1));
    let mut bytes = fs::read(&path).unwrap();
    damage(&mut bytes);
    fs::write(&path, bytes).unwrap();
    read(&store).map(drop).expect_err("damage must be noticed")
}

#[test]
fn what_was_written_is_read() {
    let (_folder, store) = written();
    assert_eq!(read(&store), Ok(sample()));
}

#[test]
fn an_empty_array_is_an_artifact_too() {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    store.write(&id(1), &3u8, &[]).unwrap();
    let (facts, values) = store.read::<u8>(&id(1)).unwrap().into_values().unwrap();
    assert_eq!((facts, values.as_ref().len()), (3, 0));
}

/// The layout is a promise to files that exist: these bytes must never change within a version.
#[test]
fn the_layout_is_one_bincode_value() {
    let (_folder, store) = written();
    let bytes = fs::read(store.path(&id(1))).unwrap();
    assert_eq!(&bytes[..8], b"RADIOSTY");
    assert_eq!(bytes[8..12], 1u32.to_le_bytes());
    type Preamble = ([u8; 8], u32, u64, [u8; 32]);
    type Header = (String, [u8; 32], Vec<u8>, u64, Vec<[u8; 32]>);
    type File = (Preamble, Header, Vec<u8>, Vec<f32>);
    let config = bincode::config::standard().with_fixed_int_encoding();
    let (file, consumed): (File, usize) =
        bincode::serde::decode_from_slice(&bytes, config).unwrap();
    let (facts, values) = sample();
    assert_eq!(consumed, bytes.len());
    assert_eq!(file.1.0, "form-factors");
    assert_eq!(file.1.1, id(1).key.bytes());
    assert_eq!(
        file.1.2,
        bincode::serde::encode_to_vec(&facts, config).unwrap()
    );
    assert_eq!(file.3, values);
    assert_eq!((bytes.len() - 4 * values.len()) % ALIGNMENT, 0);
}

/// Golden bytes: the key of fixed inputs is the same on every machine and in every build.
#[test]
fn keys_are_stable() {
    let key = Key::of("solution", 2, &(1.5f64, "name", [1u32, 2]));
    assert_eq!(
        key.to_string(),
        "74d7d091ebe9eb9f8db18b8d793f5a94797d49fb412dea7759a09a4d84d3a87d"
    );
    assert_ne!(key, Key::of("solution", 3, &(1.5f64, "name", [1u32, 2])));
    assert_ne!(key, Key::of("other", 2, &(1.5f64, "name", [1u32, 2])));
    assert_ne!(key, Key::of("solution", 2, &(1.5f64, "name", [1u32, 3])));
}

#[test]
fn each_kind_of_damage_is_named() {
    assert_eq!(
        miss_after(|b| b[0] ^= 1),
        "the cached file is not a cache file"
    );
    assert_eq!(
        miss_after(Vec::clear),
        "the cached file is not a cache file"
    );
    assert_eq!(
        miss_after(|b| b[8] = 9),
        "the cached file has format version 9, this program writes 1"
    );
    assert_eq!(
        miss_after(|b| b[60] ^= 1),
        "the cached file's header is damaged"
    );
    assert_eq!(
        miss_after(|b| b[12..20].copy_from_slice(&u64::MAX.to_le_bytes())),
        "the cached file's header is damaged"
    );
    let longer = miss_after(|b| b.push(0));
    let shorter = miss_after(|b| b.truncate(b.len() - 1));
    assert!(longer.contains("bytes instead of") && shorter.contains("bytes instead of"));
    assert_eq!(
        miss_after(|b| *b.last_mut().unwrap() ^= 1),
        "the cached file's data is damaged (block 0)"
    );
}

#[test]
fn the_damaged_block_is_named() {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    store
        .write(&id(1), &(), &vec![1.0; 3 * BLOCK_VALUES])
        .unwrap();
    let path = store.path(&id(1));
    let mut bytes = fs::read(&path).unwrap();
    let in_second_block = bytes.len() - 6 * BLOCK_VALUES;
    bytes[in_second_block] ^= 1;
    fs::write(&path, bytes).unwrap();
    let miss = store.read::<()>(&id(1)).unwrap().into_values().unwrap_err();
    assert!(matches!(miss, Miss::Block { block: 1 }));
}

#[test]
fn a_file_under_another_key_is_a_miss() {
    let (_folder, store) = written();
    fs::rename(store.path(&id(1)), store.path(&id(2))).unwrap();
    assert!(matches!(store.read::<Facts>(&id(2)), Err(Miss::OtherKey)));
}

#[test]
fn facts_of_another_type_are_a_miss() {
    let (_folder, store) = written();
    assert!(matches!(store.read::<[u64; 9]>(&id(1)), Err(Miss::Facts)));
}

#[test]
fn a_leftover_of_an_interrupted_write_does_no_harm() {
    let (_folder, store) = written();
    let partial = store
        .path(&id(1))
        .with_extension("bin.radiosity-Xy12ab.partial");
    fs::write(&partial, b"half a file").unwrap();
    assert_eq!(read(&store), Ok(sample()));
    let (facts, values) = sample();
    store.write(&id(1), &facts, &values).unwrap();
    assert!(!partial.exists());
}

#[test]
fn a_mapped_file_survives_its_replacement() {
    let (_folder, store) = written();
    let (_, old) = store.read::<Facts>(&id(1)).unwrap().into_values().unwrap();
    store.write(&id(1), &sample().0, &[9.0; 4]).unwrap();
    assert_eq!(old.as_ref(), sample().1);
}

#[test]
fn locks_and_journals_beside_an_artifact_are_removed() {
    let (folder, store) = written();
    let left = |ending: &str| store.path(&id(1)).with_extension(format!("bin.{ending}"));
    for ending in ["lock", "journal", "partial"] {
        fs::write(left(ending), b"").unwrap();
        store.tidy(&id(1));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "{ending}");
    }
}

#[test]
fn locks_exclude_and_leave_nothing_behind() {
    let (folder, store) = written();
    let first = store.lock(&id(1), || panic!("nobody has it")).unwrap();
    let second = std::thread::scope(|scope| {
        let waiting = std::sync::mpsc::channel();
        let store = &store;
        let thread = scope.spawn(move || store.lock(&id(1), || waiting.0.send(()).unwrap()));
        waiting.1.recv().unwrap();
        drop(first);
        thread.join().unwrap().unwrap()
    });
    drop(second);
    let left = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 2, "only the artifact and the note of its use stay");
}

#[test]
fn writers_of_one_file_do_not_meet() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("result");
    std::thread::scope(|scope| {
        for writer in 0..8u8 {
            let path = &path;
            scope.spawn(move || {
                for _ in 0..20 {
                    crate::replace_file(path, &[&[writer; 5000], &[writer; 5000]]).unwrap();
                    let found = fs::read(path).unwrap();
                    assert!(found.len() == 10_000 && found.iter().all(|b| *b == found[0]));
                }
            });
        }
    });
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

proptest! {
    /// Whatever single byte is changed, wherever a file is cut: no panic, and no wrong data.
    #[test]
    fn arbitrary_damage_is_noticed(at in 0usize..4400, change in 1u8..) {
        let miss = miss_after(|bytes| {
            let at = at % bytes.len();
            bytes[at] ^= change;
        });
        prop_assert!(!miss.is_empty());
        let miss = miss_after(|bytes| bytes.truncate(at % bytes.len()));
        prop_assert!(!miss.is_empty());
    }
}
