//! What `check` says, and that it is true.

use crate::command::keys;
use crate::place::Place;
use std::fs;

/// What `check` forecasts, and that what it says of files is true.
#[test]
fn check_forecasts_a_run() {
    let place = Place::new();
    let check = place.json("check room.toml --mode regular");
    assert_eq!(
        keys(&check),
        [
            "cached",
            "camera",
            "disk_bytes",
            "export_bytes",
            "lights",
            "memory_bytes",
            "notes",
            "pairs",
            "patches",
            "scene",
            "seconds",
            "surfaces",
            "views"
        ]
    );
    assert_eq!(
        (&check["patches"], &check["pairs"]),
        (&17.into(), &136.into())
    );
    assert_eq!(check["notes"].as_array().unwrap().len(), 0);
    assert_eq!(check["cached"], false);
    place.succeed("form-factors room.toml --cache c --export f.npy");
    let said = place.succeed("check room.toml --cache c");
    assert!(said.contains("136 pairs of patches: cached, "), "{said}");
    place.succeed("form-factors room.toml --cache c --export f.csv");
    place.succeed("solve room.toml --cache c --export light.csv");
    place.succeed("display room.toml --cache c --format ppm");
    let size = |name: &str| fs::metadata(place.path(name)).unwrap().len();
    let forecast = |of: &str| check["export_bytes"][of].as_u64().unwrap();
    assert_eq!(forecast("form_factors_npy"), size("f.npy"));
    assert!(size("f.csv") <= forecast("form_factors_csv"));
    let light = size("light.csv") as f64 / forecast("radiosities_csv") as f64;
    assert!((0.5..1.1).contains(&light), "{light}");
    let header = b"P6\n16 12\n255\n".len() as u64;
    assert!(forecast("picture_ppm") <= size("out/room-smooth.ppm") - header);
}

#[test]
fn check_computes_nothing() {
    let place = Place::new();
    let said = place.succeed("check room.toml --patches 100");
    assert!(
        said.contains("10,008 patches") && said.contains("201 MB of disk"),
        "{said}"
    );
    assert!(!place.path("out").exists() && !place.path("platform-cache").exists());
}
