//! What is found in the cache, and what is removed from it.

use crate::place::Place;
use std::fs::{self, File};
use std::path::Path;
use std::time::{Duration, SystemTime};

const DAY: Duration = Duration::from_secs(24 * 3600);

fn rendered() -> Place {
    let place = Place::new();
    place.succeed("render room.toml --cache c");
    place
}

/// Has all files of the cache written and used so many days ago.
fn age(place: &Place, days: u32) {
    for file in fs::read_dir(place.path("c")).unwrap() {
        let file = File::options().write(true).open(file.unwrap().path());
        let then = SystemTime::now() - DAY * days;
        file.unwrap().set_modified(then).unwrap();
    }
}

fn size(path: &Path) -> u64 {
    fs::metadata(path).unwrap().len()
}

#[test]
fn a_copied_scene_takes_what_the_first_made() {
    let place = rendered();
    fs::copy(place.path("room.toml"), place.path("copy.toml")).unwrap();
    let report = place.json("render copy.toml --cache c");
    for stage in ["form_factors", "solve"] {
        assert_eq!(report["stages"][stage]["cached"], true, "{stage}");
    }
    let picture = |scene: &str| fs::read(place.path(&format!("out/{scene}-smooth.ppm"))).unwrap();
    assert!(picture("room") == picture("copy"));
    assert_eq!(place.artifacts().len(), 2);
    let list = place.succeed("cache list --cache c");
    let of_copy = list.lines().filter(|line| line.ends_with("  copy"));
    assert_eq!(of_copy.count(), 2, "the last user is named: {list}");
    let changed = place.json("render copy.toml --cache c --patches 2");
    let reason = &changed["stages"]["form_factors"]["reason"];
    assert_eq!(reason, "nothing cached for these inputs");
}

#[test]
fn what_was_not_used_for_long_is_removed() {
    let place = rendered();
    age(&place, 8);
    place.succeed("form-factors room.toml --cache c");
    let said = place.succeed("cache clean --cache c --older 9d");
    assert!(said.starts_with("removed 0 files (0 B) from "), "{said}");
    let said = place.succeed("cache clean --cache c --older 7.5D");
    assert!(said.starts_with("removed 1 file ("), "{said}");
    assert!(said.contains("\nleft: 1 file ("), "{said}");
    assert_eq!(place.artifacts(), [place.artifact("form-factors")]);
}

#[test]
fn the_least_recently_used_is_removed() {
    let place = rendered();
    age(&place, 2);
    place.succeed("form-factors room.toml --cache c");
    let [factors, solution] = ["form-factors", "solution"].map(|stage| place.artifact(stage));
    let both = size(&factors) + size(&solution);
    let said = place.succeed(&format!("cache clean --cache c --keep {both}B"));
    assert!(said.starts_with("removed 0 files"), "{said}");
    let said = place.succeed(&format!(
        "cache clean --cache c --older 1w --keep {}b",
        both - 1
    ));
    assert!(said.starts_with("removed 1 file ("), "{said}");
    assert_eq!(place.artifacts(), [factors]);
    let said = place.succeed("cache clean --cache c --keep 0kB");
    assert!(said.ends_with("left: 0 files (0 B)\n"), "{said}");
    assert_eq!(fs::read_dir(place.path("c")).unwrap().count(), 0);
}

#[test]
fn what_another_process_makes_stays_and_is_told() {
    let place = rendered();
    let factors = place.artifact("form-factors");
    let lock = File::create(factors.with_extension("bin.lock")).unwrap();
    lock.lock().unwrap();
    let said = place.succeed("cache clean --cache c");
    assert!(said.starts_with("removed 1 file ("), "{said}");
    assert!(
        said.contains("of which another process is making 1 file ("),
        "{said}"
    );
    assert_eq!(place.artifacts(), [factors]);
}

#[test]
fn wrong_limits_are_explained() {
    let place = rendered();
    let ages = [
        "7", "d", "week", "-7d", "7 d x", "infd", "nand", "1e300w", "7m",
    ];
    let sizes = ["2", "GB", "-2GB", "2GiB", "2k", "infB", "1e308TB"];
    let wrong = ages.map(|age| ["--older", age, "like 7d"]);
    let wrong = wrong.into_iter();
    for [flag, value, example] in wrong.chain(sizes.map(|size| ["--keep", size, "like 2GB"])) {
        let mut command = place.command("cache clean --cache c");
        let output = command.args([flag, value]).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{value}: {said}");
        let is_plain = said.contains(flag) && said.contains(value) && said.contains(example);
        assert!(is_plain, "{value}: {said}");
    }
    assert_eq!(place.artifacts().len(), 2, "nothing is removed");
}

#[test]
fn the_cache_is_listed_and_emptied() {
    let place = Place::new();
    assert!(place.succeed("cache list").starts_with("0 files"));
    place.succeed("render room.toml");
    let list = place.succeed("cache list");
    assert!(
        list.contains("form-factors") && list.contains("solution"),
        "{list}"
    );
    assert!(
        list.contains("2 files") && list.contains("platform-cache"),
        "{list}"
    );
    assert!(place.succeed("cache clean").starts_with("removed 2 files"));
    assert!(place.succeed("cache list").starts_with("0 files"));
}
