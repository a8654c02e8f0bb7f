//! Whenever the command is killed, and whatever the disk refuses: what was kept is used, and the
//! artifact has the same bytes in the end.

mod place;

use place::Place;
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
const KILLS: u32 = 24;
/// Runs that share the processors would take longer to their checkpoints.
static ALONE: Mutex<()> = Mutex::new(());

fn artifact(place: &Place) -> Option<PathBuf> {
    let files = fs::read_dir(place.path("c")).ok()?;
    let mut paths = files.map(|entry| entry.unwrap().path());
    paths.find(|path| path.extension().is_some_and(|e| e == "bin"))
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

#[test]
fn killed_runs_go_on_where_they_were() {
    let _alone = ALONE.lock();
    let expected = undisturbed();
    let place = Place::new();
    let mut kills = 0;
    while kills < KILLS {
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
    assert_eq!(left.len(), 1, "{left:?}");
}

/// A file that may not grow is refused like one on a full disk.
#[test]
#[cfg(unix)]
fn a_full_disk_stops_the_run_and_loses_nothing() {
    let _alone = ALONE.lock();
    let expected = undisturbed();
    let place = Place::new();
    // In units of 512 bytes: half of the artifact.
    let limit = expected.len() / 1024;
    let binary = env!("CARGO_BIN_EXE_radiosity");
    let refused = |arguments: &str| {
        let limited = format!("trap '' XFSZ; ulimit -f {limit}; exec {binary} {arguments}");
        let refused = Command::new("sh")
            .args(["-c", &limited])
            .current_dir(place.path("."))
            .output()
            .unwrap();
        let stderr = String::from_utf8(refused.stderr).unwrap();
        assert_eq!(refused.status.code(), Some(4), "{stderr}");
        assert!(stderr.contains("error: cannot write"), "{stderr}");
        stderr
    };
    let anew = refused(&format!("{LONG} --recompute"));
    assert!(
        anew.contains("make room there and run the same command again; or"),
        "{anew}"
    );
    let again = refused(LONG);
    assert!(
        again.contains("make room there and run the same command again, which goes on at"),
        "{again}"
    );
    let (code, _, stderr) = place.run(LONG);
    assert_eq!(code, 0, "{stderr}");
    assert!(stderr.contains("an interrupted run has left"), "{stderr}");
    assert!(fs::read(artifact(&place).unwrap()).unwrap() == *expected);
}

#[test]
fn recomputing_begins_anew() {
    let _alone = ALONE.lock();
    let place = Place::new();
    let mut run = start(&place);
    assert!(checkpoint_after(None, &place, &mut run));
    run.kill().unwrap();
    run.wait().unwrap();
    let (code, _, stderr) = place.run(&format!("{LONG} --recompute"));
    assert_eq!(code, 0);
    assert!(!stderr.contains("interrupted"), "{stderr}");
}
