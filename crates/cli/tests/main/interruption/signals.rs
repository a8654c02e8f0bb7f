//! What is left of a result whose writer is ended by a signal.

use super::ALONE;
use crate::place::Place;
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// What is being written in a place, beside what is cached.
fn unfinished(place: &Place) -> usize {
    let files = fs::read_dir(place.path(".")).unwrap();
    let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    names.filter(|name| name.ends_with(".partial")).count()
}

/// A large result of cached form factors, interrupted by a signal while it is written.
fn interrupted_by(signal: i32) -> Place {
    let _alone = ALONE.lock();
    let place = Place::new();
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/cornell.toml");
    let work = format!("form-factors {scene} --patches 14 --mode regular --points 1 --cache c");
    place.succeed(&work);
    for _ in 0..20 {
        let mut run = Command::new(env!("CARGO_BIN_EXE_radiosity"))
            .args(format!("{work} --export f.csv").split(' '))
            .current_dir(place.path("."))
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        while unfinished(&place) == 0 && run.try_wait().unwrap().is_none() {
            sleep(Duration::from_millis(1));
        }
        let kill = format!("kill -{signal} {}", run.id());
        let _ = Command::new("sh").args(["-c", &kill]).status();
        if run.wait().unwrap().signal() == Some(signal) {
            return place;
        }
        // It was over already.
        fs::remove_file(place.path("f.csv")).unwrap();
    }
    panic!("signal {signal} ends no run; the shell that runs the tests may ignore it");
}

#[test]
fn signals_leave_no_half_results() {
    for signal in [2, 15] {
        let place = interrupted_by(signal);
        assert_eq!(unfinished(&place), 0, "signal {signal}");
        assert!(!place.path("f.csv").exists());
    }
}

#[test]
fn half_results_of_killed_runs_are_removed_by_the_next() {
    let place = interrupted_by(9);
    assert_eq!(unfinished(&place), 1);
    place.write("f.csv.partial", "the user's own");
    place.succeed("solve room.toml --no-cache --export other.csv");
    assert_eq!(unfinished(&place), 1);
    assert!(place.path("f.csv.partial").exists());
}
