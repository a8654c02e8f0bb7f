//! Pictures that do not wait for all form factors.

mod place;

use place::Place;
use std::fs;

#[test]
fn a_preview_needs_neither_form_factors_nor_solution() {
    let place = Place::new();
    let report = place.json("render room.toml --cache c --preview 20");
    let stages = report["stages"].as_object().unwrap();
    assert_eq!(stages.keys().collect::<Vec<_>>(), ["display", "preview"]);
    let share = report["stages"]["preview"]["share"].as_f64().unwrap();
    assert!(share > 0.0 && share < 0.4, "{share}");
    assert!(place.path("out/room-smooth.png").is_file());
    assert!(!place.path("c").exists(), "nothing is cached");
}

#[test]
fn threads_have_no_part_in_a_preview() {
    let place = Place::new();
    for threads in [1, 3] {
        let export = format!("--export {threads}.csv --threads {threads}");
        let (code, _, error) = place.run(&format!("solve room.toml --preview {export}"));
        assert_eq!(code, 0, "{error}");
    }
    let read = |name: &str| fs::read(place.path(name)).unwrap();
    assert_eq!(read("1.csv"), read("3.csv"));
}

#[test]
fn percentages_are_checked() {
    let place = Place::new();
    for wrong in ["0", "101", "many"] {
        let (code, _, error) = place.run(&format!("render room.toml --preview {wrong}"));
        assert!(code == 2 && error.contains("percentage"), "{error}");
    }
}

/// In a closed white box light is never absorbed, and shooting it never comes to an end by itself.
#[test]
fn light_that_does_not_die_away_is_given_up() {
    let place = Place::new();
    let mut scene = "[materials.white]\nreflectance = 1\nemission = 1\n".to_owned();
    for (k, [corner, a, b]) in [
        ["[0, 0, 0]", "[0, 1, 0]", "[1, 0, 0]"],
        ["[0, 0, 1]", "[1, 0, 0]", "[0, 1, 0]"],
        ["[0, 0, 0]", "[0, 0, 1]", "[0, 1, 0]"],
        ["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"],
        ["[0, 0, 0]", "[1, 0, 0]", "[0, 0, 1]"],
        ["[0, 1, 0]", "[0, 0, 1]", "[1, 0, 0]"],
    ]
    .into_iter()
    .enumerate()
    {
        scene.push_str(&format!(
            "[[surfaces]]\nname = \"{k}\"\nmaterial = \"white\"\ndivisions = 4\n\
             parallelogram = {{ corner = {corner}, edge_a = {b}, edge_b = {a} }}\n"
        ));
    }
    place.write("white.toml", &scene);
    let report = place.json("solve white.toml --mode regular --no-cache --preview 100");
    let unshot = report["stages"]["preview"]["unshot"].as_f64().unwrap();
    assert!(unshot > 0.5, "{unshot}");
}
