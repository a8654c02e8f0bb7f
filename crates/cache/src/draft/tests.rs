//! Whatever is interrupted, cut off or damaged: the artifact has the same bytes in the end.

use super::{Batch, Draft, Unusable};
use crate::cache_file::{journal_of, partial_of};
use crate::digests::BLOCK_VALUES;
use crate::{CacheError, Id, Key, Limits, Miss, Store, format};
use proptest::prelude::*;
use serde::{Serialize, Serializer};
use std::fs::{self, File, OpenOptions};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const FACTS: (u8, f64) = (3, 0.5);
const BLANK: (u8, f64) = (0, 0.0);

fn id(input: u32) -> Id<'static> {
    Id {
        scene: "box",
        stage: "form-factors",
        key: Key::of("form-factors", 1, &input),
    }
}

fn values(count: usize) -> Vec<f32> {
    (0..count).map(|k| k as f32).collect()
}

/// The bytes of an artifact written at once.
fn expected(values: &[f32]) -> Vec<u8> {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    store.write(&id(1), &FACTS, values).unwrap();
    fs::read(store.path(&id(1))).unwrap()
}

/// Goes on with a draft, or begins it, and says where it did.
fn draft(store: &Store, count: usize) -> (Draft, Option<u64>) {
    match Draft::resume::<u64>(store, &id(1), &BLANK, count as u64) {
        Ok(Some((draft, state))) => (draft, Some(state)),
        _ => (
            Draft::begin(store, &id(1), &BLANK, count as u64).unwrap(),
            None,
        ),
    }
}

/// Finishes what is there, and gives the bytes of the artifact and where it began.
fn finished(store: &Store, values: &[f32]) -> (Vec<u8>, Option<u64>) {
    let (mut draft, begun) = draft(store, values.len());
    draft.append(&values[draft.written as usize..]).unwrap();
    assert_eq!(draft.values().unwrap().as_ref(), values);
    assert!(draft.finish(&FACTS).unwrap());
    let left = fs::read_dir(store.folder()).unwrap().count();
    assert_eq!(
        left, 2,
        "nothing but the artifact and the note of its use stays"
    );
    (fs::read(store.path(&id(1))).unwrap(), begun)
}

/// A draft with a checkpoint at `saved` values and more written after it.
fn interrupted(values: &[f32], saved: usize, more: usize) -> (TempDir, Store) {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    let (mut draft, _) = draft(&store, values.len());
    draft.append(&values[..saved]).unwrap();
    draft.checkpoint(&(saved as u64)).unwrap();
    draft.append(&values[saved..saved + more]).unwrap();
    (folder, store)
}

fn no_failure(error: &CacheError, _: u64) {
    panic!("{error}");
}

fn flip(path: &Path, byte: usize) {
    let mut bytes = fs::read(path).unwrap();
    let byte = byte % bytes.len();
    bytes[byte] ^= 1;
    fs::write(path, bytes).unwrap();
}

#[test]
fn a_draft_becomes_the_artifact_that_is_written_at_once() {
    for count in [0, 1, 1000, BLOCK_VALUES, 2 * BLOCK_VALUES + 7] {
        let folder = TempDir::new().unwrap();
        let values = values(count);
        let (bytes, begun) = finished(&Store::new(folder.path()), &values);
        assert_eq!(begun, None);
        assert!(bytes == expected(&values), "{count} values");
    }
}

/// Batches of one value each, without checkpoints.
fn ones(count: u64) -> impl Iterator<Item = Batch<u64>> {
    let one = |_| Batch {
        values: vec![vec![1.0]],
        state: None,
    };
    (0..count).map(one)
}

/// A state that can be saved once the next batch is being made.
struct OnceTheNextIsBegun<'a>(&'a AtomicBool);

impl Serialize for OnceTheNextIsBegun<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let began = Instant::now();
        while !self.0.load(Ordering::Acquire) {
            assert!(
                began.elapsed() < Duration::from_secs(60),
                "nothing is made meanwhile"
            );
            std::thread::yield_now();
        }
        serializer.serialize_u64(1)
    }
}

#[test]
fn batches_are_written_while_the_next_are_made() {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    let (mut draft, _) = draft(&store, 2);
    let next_is_begun = AtomicBool::new(false);
    let batch = |k: u32| {
        next_is_begun.store(k == 1, Ordering::Release);
        Batch {
            values: vec![vec![k as f32]],
            state: (k == 0).then_some(OnceTheNextIsBegun(&next_is_begun)),
        }
    };
    draft.extend((0..2).map(batch), &no_failure).unwrap();
    assert_eq!(draft.values().unwrap().as_ref(), [0.0, 1.0]);
    assert_eq!(draft.saved(), 1);
}

/// Makes the rest of a draft after a checkpoint at 50 of 100 values; gives what was told of it.
fn rest_after_failure(draft: &mut Draft) -> Vec<(String, u64)> {
    let told = Mutex::new(Vec::new());
    let tell = |error: &CacheError, kept| told.lock().unwrap().push((error.to_string(), kept));
    let batch = |k: usize| Batch {
        values: vec![vec![k as f32]],
        state: Some(k as u64 + 1),
    };
    draft.extend((50..100).map(batch), &tell).unwrap();
    told.into_inner().unwrap()
}

/// Whoever begins it goes on in memory; a draft with a checkpoint is left or not.
#[test]
fn what_cannot_be_written_is_made_in_memory() {
    let values = values(100);
    let (_folder, store) = interrupted(&values, 50, 0);
    let (mut draft, _) = draft(&store, 100);
    draft.file = File::open(partial_of(&store.path(&id(1)))).unwrap();
    let told = rest_after_failure(&mut draft);
    assert_eq!(told.len(), 1, "told once");
    assert!(
        told[0].0.contains("cannot write") && told[0].1 == 50,
        "{told:?}"
    );
    assert_eq!(draft.values().unwrap().as_ref(), values);
    assert!(!draft.finish(&FACTS).unwrap());
    assert_eq!(finished(&store, &values).1, Some(50), "the next goes on");
}

#[test]
fn a_folder_that_vanishes_costs_the_draft_alone() {
    let values = values(100);
    let (folder, store) = interrupted(&values, 50, 0);
    let (mut draft, _) = draft(&store, 100);
    fs::remove_dir_all(folder.path()).unwrap();
    let told = rest_after_failure(&mut draft);
    assert!(told[0].0.contains("journal") && told[0].1 == 0, "{told:?}");
    assert_eq!(draft.values().unwrap().as_ref(), values);
    assert!(!draft.finish(&FACTS).unwrap());
}

#[test]
fn a_folder_that_vanishes_at_the_end_costs_the_draft_alone() {
    let values = values(100);
    let (folder, store) = interrupted(&values, 50, 50);
    let (mut draft, _) = draft(&store, 100);
    draft.append(&values[50..]).unwrap();
    fs::remove_dir_all(folder.path()).unwrap();
    // Another process is as far as this one was.
    fs::create_dir(folder.path()).unwrap();
    fs::write(partial_of(&store.path(&id(1))), b"another's").unwrap();
    let made = draft.values().unwrap();
    assert!(draft.finish(&FACTS).is_err());
    assert_eq!(made.as_ref(), values);
    assert!(
        !store.path(&id(1)).exists(),
        "what is another's is not named"
    );
}

/// A file that loses what was written to it.
#[test]
fn values_that_are_lost_are_an_error_and_nothing_more_is_made() {
    let folder = TempDir::new().unwrap();
    let store = Store::new(folder.path());
    let (mut draft, _) = draft(&store, 1000);
    draft.extend(ones(3), &no_failure).unwrap();
    draft.file.set_len(draft.start).unwrap();
    draft.file = File::open(partial_of(&store.path(&id(1)))).unwrap();
    let mut made = 0;
    let failed = draft.extend(ones(997).inspect(|_| made += 1), &no_failure);
    assert_eq!(failed.unwrap_err().action, "read");
    assert!(
        made <= 2,
        "one fails, one finds that nobody takes it, but {made} were made"
    );
}

#[test]
#[should_panic(expected = "more values than was said")]
fn more_values_than_was_said_are_a_bug() {
    let folder = TempDir::new().unwrap();
    let (mut draft, _) = draft(&Store::new(folder.path()), 2);
    draft.extend(ones(3), &no_failure).unwrap();
}

/// Why a draft with a checkpoint at half of 100 values is not taken after something was done to its
/// values and its journal.
fn refusal_after(change: impl FnOnce(&Path, &Path)) -> String {
    let (_folder, store) = interrupted(&values(100), 50, 0);
    let artifact = store.path(&id(1));
    change(&partial_of(&artifact), &journal_of(&artifact));
    let resumed = Draft::resume::<u64>(&store, &id(1), &BLANK, 100);
    resumed.map(drop).unwrap_err().to_string()
}

#[test]
fn each_reason_to_begin_anew_is_named() {
    assert_eq!(
        refusal_after(|_, journal| flip(journal, 40)),
        "its journal is damaged"
    );
    assert_eq!(
        refusal_after(|_, journal| fs::write(journal, b"short").unwrap()),
        "its journal is damaged"
    );
    assert_eq!(
        refusal_after(|_, journal| fs::remove_file(journal).unwrap()),
        "it has no checkpoint"
    );
    let older = format::sealed(&format::encode(&([0u8; 32], 448u64)));
    assert_eq!(
        refusal_after(|_, journal| fs::write(journal, older).unwrap()),
        "another version of this program wrote it"
    );
    let cut = |partial: &Path, _: &Path| {
        let file = OpenOptions::new().write(true).open(partial).unwrap();
        file.set_len(file.metadata().unwrap().len() - 8).unwrap();
    };
    assert!(refusal_after(cut).starts_with("it is cut off at byte"));
    let last = |partial: &Path, _: &Path| {
        let last = fs::metadata(partial).unwrap().len() - 1;
        flip(partial, last as usize);
    };
    assert!(refusal_after(last).starts_with("it is damaged somewhere from byte"));
    let missing = refusal_after(|partial, _| fs::remove_file(partial).unwrap());
    assert!(missing.starts_with("it cannot be read: "), "{missing}");
}

#[test]
fn drafts_of_other_inputs_are_not_taken() {
    let (_folder, store) = interrupted(&values(100), 50, 0);
    let resumed = |id: &Id<'_>, count| {
        let resumed = Draft::resume::<u64>(&store, id, &BLANK, count);
        resumed.map(|draft| draft.is_some())
    };
    assert!(!resumed(&id(2), 100).unwrap(), "there is none");
    assert!(matches!(resumed(&id(1), 101), Err(Unusable::OtherInputs)));
    assert!(resumed(&id(1), 100).unwrap());
    for of in [partial_of, journal_of] {
        fs::rename(of(&store.path(&id(1))), of(&store.path(&id(2)))).unwrap();
    }
    assert!(matches!(resumed(&id(2), 100), Err(Unusable::OtherInputs)));
}

/// Whoever copies or renames a scene does not lose what was made of it.
#[test]
fn a_draft_goes_on_under_another_name() {
    let values = values(100);
    let (_folder, store) = interrupted(&values, 50, 25);
    let copy = Id {
        scene: "copy",
        ..id(1)
    };
    let resumed = Draft::resume::<u64>(&store, &copy, &BLANK, 100).unwrap();
    let (mut draft, state) = resumed.expect("it was begun");
    assert_eq!((state, draft.written), (50, 50));
    draft.append(&values[50..]).unwrap();
    assert!(draft.finish(&FACTS).unwrap());
    assert!(fs::read(store.path(&id(1))).unwrap() == expected(&values));
    assert!(!partial_of(&store.path(&id(1))).exists());
}

#[test]
fn half_an_artifact_is_none() {
    let (_folder, store) = interrupted(&values(100), 50, 50);
    assert!(store.read::<(u8, f64)>(&id(1)).is_err());
    let [entry] = &store.list().unwrap()[..] else {
        panic!("one draft");
    };
    assert!(matches!(entry.stage, Err(Miss::Unfinished)));
    assert_eq!(entry.scene.as_deref(), Some("box"));
    let cleaned = store.clean(Limits::default()).unwrap();
    assert_eq!(cleaned.removed.files, 2, "the draft and its journal");
}

#[test]
fn drafts_beside_an_artifact_are_removed_when_nobody_writes_them() {
    let (_folder, store) = interrupted(&values(100), 50, 0);
    store.write(&id(2), &FACTS, &values(3)).unwrap();
    let is_note = |path: &Path| path.extension().is_some_and(|ending| ending == "used");
    let left = || {
        let files = fs::read_dir(store.folder()).unwrap();
        let paths = files.map(|file| file.unwrap().path());
        paths.filter(|path| !is_note(path)).count()
    };
    store.tidy(&id(2));
    assert_eq!(left(), 3, "another's is left alone");
    let lock = store.lock(&id(1), || ()).unwrap();
    store.tidy(&id(1));
    assert_eq!(left(), 4, "one that is being written too");
    drop(lock);
    store.tidy(&id(1));
    assert_eq!(left(), 1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn pieces_of_any_length_make_the_same_artifact(
        lengths in prop::collection::vec(0..BLOCK_VALUES, 1..6),
    ) {
        let folder = TempDir::new().unwrap();
        let store = Store::new(folder.path());
        let values = values(lengths.iter().sum());
        for length in lengths {
            let (mut draft, begun) = draft(&store, values.len());
            let at = draft.written;
            prop_assert_eq!(begun.unwrap_or(0), at);
            let next = &values[at as usize..at as usize + length];
            let pieces = [&next[..length / 3], &next[length / 3..]].map(<[f32]>::to_vec);
            let state = Some(at + length as u64);
            let batch = Batch { values: pieces.into(), state };
            draft.extend([batch], &no_failure).unwrap();
        }
        prop_assert!(finished(&store, &values).0 == expected(&values));
    }

    #[test]
    fn what_comes_after_a_checkpoint_does_not_matter(
        saved in 0usize..1000,
        more in 0usize..1000,
        kept in 0usize..2000,
    ) {
        let values = values(2000);
        let (_folder, store) = interrupted(&values, saved, more);
        let partial = OpenOptions::new().write(true).open(partial_of(&store.path(&id(1)))).unwrap();
        let end = partial.metadata().unwrap().len();
        let lost = 4 * (more - more.min(kept)) as u64;
        partial.set_len(end - lost).unwrap();
        let (bytes, begun) = finished(&store, &values);
        prop_assert_eq!(begun, Some(saved as u64));
        prop_assert!(bytes == expected(&values));
    }

    #[test]
    fn damaged_drafts_begin_anew(byte in 0usize..4000, of_journal: bool) {
        let values = values(2000);
        let (_folder, store) = interrupted(&values, 1000, 500);
        let artifact = store.path(&id(1));
        if of_journal {
            flip(&journal_of(&artifact), byte);
        } else {
            let head = fs::metadata(partial_of(&artifact)).unwrap().len() as usize - 6000;
            flip(&partial_of(&artifact), head + byte);
        }
        let (bytes, begun) = finished(&store, &values);
        prop_assert_eq!(begun, None);
        prop_assert!(bytes == expected(&values));
    }

    #[test]
    fn cut_drafts_begin_anew(cut in 1u64..9999) {
        let values = values(2000);
        let (_folder, store) = interrupted(&values, 1000, 0);
        let partial = OpenOptions::new().write(true).open(partial_of(&store.path(&id(1)))).unwrap();
        let length = partial.metadata().unwrap().len();
        partial.set_len(length.saturating_sub(cut)).unwrap();
        let (bytes, begun) = finished(&store, &values);
        prop_assert_eq!(begun, None);
        prop_assert!(bytes == expected(&values));
    }
}
