//! Whenever the command is killed, and whatever the disk refuses: what was kept is used, and the
//! artifact has the same bytes in the end.

#[cfg(unix)]
mod signals;

use crate::place::Place;
use std::fs;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::{Mutex, OnceLock};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

/// Some seconds of work.
const LONG: &str = concat!(
    "form-factors ",
    env!("CARGO_MANIFEST_DIR"),
    "/../../scenes/cornell.toml --patches 14 --mode accurate --tolerance 2e-4 --cache c"
);
/// Runs that share the processors would take longer to their checkpoints.
static ALONE: Mutex<()> = Mutex::new(());

fn artifact(place: &Place) -> Option<PathBuf> {
    place.artifacts().pop()
}

/// The bytes of the artifact when nobody interrupts.
fn undisturbed() -> &'static Vec<u8> {
    static BYTES: OnceLock<Vec<u8>> = OnceLock::new();
    BYTES.get_or_init(|| {
        let place = Place::new();
        place.succeed(LONG);
        fs::read(artifact(&place).unwrap()).unwrap()
    })
}

fn start(place: &Place) -> Child {
    Command::new(env!("CARGO_BIN_EXE_radiosity"))
        .args(LONG.split(' '))
        .current_dir(place.path("."))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// When the last checkpoint was made, if there is one.
fn checkpoint(place: &Place) -> Option<SystemTime> {
    let files = fs::read_dir(place.path("c")).ok()?;
    let mut files = files.map(Result::unwrap);
    let is_journal = |path: PathBuf| path.extension().is_some_and(|e| e == "journal");
    let journal = files.find(|file| is_journal(file.path()))?;
    journal.metadata().ok()?.modified().ok()
}

/// Waits for a checkpoint later than `last`; whether there was one before the run was over.
fn checkpoint_after(last: Option<SystemTime>, place: &Place, run: &mut Child) -> bool {
    while run.try_wait().unwrap().is_none() {
        if checkpoint(place) > last {
            return true;
        }
        sleep(Duration::from_millis(1));
    }
    false
}

/// Kills a run of a new place after its first checkpoint.
fn kill_after_checkpoint(place: &Place) {
    let mut run = start(place);
    assert!(checkpoint_after(None, place, &mut run));
    run.kill().unwrap();
    run.wait().unwrap();
}

#[test]
fn killed_runs_go_on_where_they_were() {
    killed_runs_go_on(4);
}

#[test]
#[ignore = "slow: twenty seconds"]
fn runs_killed_at_many_moments_go_on_where_they_were() {
    killed_runs_go_on(24);
}

fn killed_runs_go_on(most: u32) {
    let _alone = ALONE.lock();
    let expected = undisturbed();
    let place = Place::new();
    let mut kills = 0;
    while kills < most {
        let last = checkpoint(&place);
        let mut run = start(&place);
        // Every other run has made a checkpoint; the golden ratio spreads moments evenly.
        let spread = (f64::from(kills) * 0.618_033_988_75).fract();
        if kills % 2 == 0 {
            sleep(Duration::from_secs_f64(0.6 * spread));
        } else if checkpoint_after(last, &place, &mut run) {
            sleep(Duration::from_secs_f64(0.1 * spread));
        }
        if run.try_wait().unwrap().is_some() {
            assert!(fs::read(artifact(&place).unwrap()).unwrap() == *expected);
            fs::remove_dir_all(place.path("c")).unwrap();
            continue;
        }
        run.kill().unwrap();
        run.wait().unwrap();
        kills += 1;
    }
    let (code, _, stderr) = place.run(LONG);
    assert_eq!(code, 0, "{stderr}");
    assert!(fs::read(artifact(&place).unwrap()).unwrap() == *expected);
    let left: Vec<_> = fs::read_dir(place.path("c")).unwrap().collect();
    assert_eq!(
        left.len(),
        2,
        "the artifact and the note of its use: {left:?}"
    );
}

/// Whoever renames a scene does not lose what was made of it.
#[test]
#[ignore = "slow: ten seconds"]
fn killed_runs_go_on_under_another_name() {
    let _alone = ALONE.lock();
    let place = Place::new();
    kill_after_checkpoint(&place);
    let (scene, rest) = LONG.split_once(" --patches").unwrap();
    let scene = scene.strip_prefix("form-factors ").unwrap();
    fs::copy(scene, place.path("renamed.toml")).unwrap();
    let (code, _, stderr) = place.run(&format!("form-factors renamed.toml --patches{rest}"));
    assert_eq!(code, 0, "{stderr}");
    assert!(stderr.contains("an interrupted run has left"), "{stderr}");
    assert!(fs::read(artifact(&place).unwrap()).unwrap() == *undisturbed());
}

/// The same work, with a result beside the artifact.
fn with_export() -> String {
    format!("{LONG} --export f.csv --by surface")
}

/// The result when nobody interrupts.
fn undisturbed_export() -> &'static Vec<u8> {
    static BYTES: OnceLock<Vec<u8>> = OnceLock::new();
    BYTES.get_or_init(|| {
        let place = Place::new();
        place.succeed(&with_export());
        fs::read(place.path("f.csv")).unwrap()
    })
}

/// A file that may not grow is refused like one on a full disk.
#[test]
#[ignore = "slow: twenty seconds"]
#[cfg(unix)]
fn a_full_disk_costs_the_rest_of_the_artifact_and_no_result() {
    let _alone = ALONE.lock();
    let expected = undisturbed();
    let place = Place::new();
    // In units of 512 bytes: half of the artifact.
    let limit = expected.len() / 1024;
    let binary = env!("CARGO_BIN_EXE_radiosity");
    let limited = |arguments: &str| {
        let limited = format!("trap '' XFSZ; ulimit -f {limit}; exec {binary} {arguments}");
        let limited = Command::new("sh")
            .args(["-c", &limited])
            .current_dir(place.path("."))
            .output()
            .unwrap();
        let stderr = String::from_utf8(limited.stderr).unwrap();
        assert_eq!(limited.status.code(), Some(0), "{stderr}");
        assert!(stderr.contains("cannot write"), "{stderr}");
        assert!(
            stderr.contains("finished in memory and not kept"),
            "{stderr}"
        );
        assert!(fs::read(place.path("f.csv")).unwrap() == *undisturbed_export());
        fs::remove_file(place.path("f.csv")).unwrap();
        stderr
    };
    let anew = limited(&format!("{} --recompute", with_export()));
    assert!(!anew.contains("the next run goes on"), "{anew}");
    let again = limited(&with_export());
    assert!(again.contains("the next run goes on"), "{again}");
    let (code, _, stderr) = place.run(LONG);
    assert_eq!(code, 0, "{stderr}");
    assert!(stderr.contains("an interrupted run has left"), "{stderr}");
    assert!(fs::read(artifact(&place).unwrap()).unwrap() == *expected);
}

#[test]
#[ignore = "slow: ten seconds"]
fn a_cache_that_vanishes_costs_the_artifact_and_no_result() {
    let _alone = ALONE.lock();
    let place = Place::new();
    let mut run = Command::new(env!("CARGO_BIN_EXE_radiosity"))
        .args(with_export().split(' '))
        .current_dir(place.path("."))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    assert!(checkpoint_after(None, &place, &mut run));
    fs::rename(place.path("c"), place.path("elsewhere")).unwrap();
    let output = run.wait_with_output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{stderr}");
    assert!(
        stderr.contains("not kept") || stderr.contains("no caching"),
        "{stderr}"
    );
    assert!(!stderr.contains("the next run goes on"), "{stderr}");
    assert!(fs::read(place.path("f.csv")).unwrap() == *undisturbed_export());
}

#[test]
#[ignore = "slow: ten seconds"]
fn what_is_not_gone_on_with_is_named() {
    let _alone = ALONE.lock();
    let place = Place::new();
    kill_after_checkpoint(&place);
    let mut files = fs::read_dir(place.path("c")).unwrap();
    let is_journal = |path: &PathBuf| path.extension().is_some_and(|e| e == "journal");
    let journal = files.find_map(|file| Some(file.unwrap().path()).filter(is_journal));
    fs::write(journal.unwrap(), b"damaged").unwrap();
    let (code, _, stderr) = place.run(LONG);
    assert_eq!(code, 0, "{stderr}");
    let note =
        "what an interrupted run has left of the form-factors is not used: its journal is damaged";
    assert_eq!(stderr.matches(note).count(), 1, "{stderr}");
    assert!(fs::read(artifact(&place).unwrap()).unwrap() == *undisturbed());
}

#[test]
#[ignore = "slow: five seconds"]
fn recomputing_begins_anew() {
    let _alone = ALONE.lock();
    let place = Place::new();
    kill_after_checkpoint(&place);
    let (code, _, stderr) = place.run(&format!("{LONG} --recompute"));
    assert_eq!(code, 0);
    assert!(!stderr.contains("interrupted"), "{stderr}");
}
