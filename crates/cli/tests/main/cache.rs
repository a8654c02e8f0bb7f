//! What is found in the cache.

use crate::place::Place;
use std::fs;

fn rendered() -> Place {
    let place = Place::new();
    place.succeed("render room.toml --cache c");
    place
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
    assert_eq!(reason, "inputs changed");
}
