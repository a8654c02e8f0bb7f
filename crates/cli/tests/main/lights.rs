//! Lights that are dimmed without solving.

use crate::place::{Place, SCENE};
use crate::tables::{number, read_table};
use radiosity::{Context, Error, Project, Silent, estimate, solve, subdivide};
use std::fs;

/// The radiosities of a table, without its names.
fn radiosities(place: &Place, name: &str) -> Vec<f64> {
    let rows = read_table(place, name);
    let of_row = |row: &_| ["B_r", "B_g", "B_b"].map(|column| number(row, column));
    rows.iter().flat_map(of_row).collect()
}

/// The room with a second lamp.
fn two_lamps(place: &Place, lamp: &str, wing: &str) {
    let text = SCENE
        .replace("emission = [4, 3, 2]", lamp)
        .replace("[materials.lamp]", &format!("{wing}\n[materials.lamp]"))
        .replace(
            "name = \"wing\"\nmaterial = \"white\"",
            "name = \"wing\"\nmaterial = \"glow\"",
        );
    place.write("room.toml", &text);
}

const GLOW: &str = "[materials.glow]\nreflectance = 0.5\nemission = [1, 2, 3]";

/// What a solution of lamps that say so themselves gives: the residual of 1e-6 of the emission,
/// which is at most a hundred times the least radiosity, remains of either.
#[test]
fn relighting_is_solving_anew() {
    let place = Place::new();
    two_lamps(&place, "emission = [4, 3, 2]", GLOW);
    place.json("solve room.toml --cache c");
    let report = place.json(
        "relight room.toml --cache c --dim lamp=0.5 --tint lamp=1,0.5,2 --dim glow=3 \
         --export a.csv",
    );
    assert_eq!(report["stages"]["solve"]["cached"], true);
    let dimmed = GLOW.replace("[1, 2, 3]", "[3, 6, 9]");
    two_lamps(&place, "emission = [2, 0.75, 2]", &dimmed);
    let fresh = place.json("solve room.toml --no-cache --export b.csv");
    let (relit, solved) = (radiosities(&place, "a.csv"), radiosities(&place, "b.csv"));
    assert_eq!(relit.len(), 3 * 17);
    for (relit, solved) in relit.iter().zip(&solved) {
        assert!((relit - solved).abs() <= 1e-4 * solved, "{relit} {solved}");
    }
    let power = |report: &serde_json::Value, c: usize| {
        report["stages"]["solve"]["energy_balance"]["emitted"][c]
            .as_f64()
            .unwrap()
    };
    for c in 0..3 {
        assert!((power(&report, c) / power(&fresh, c) - 1.0).abs() < 1e-12);
    }
}

/// In the scene as on the command line.
#[test]
fn pictures_are_dimmed_without_solving() {
    let place = Place::new();
    place.json("render room.toml --cache c -o bright");
    let dim = place.json("display room.toml --cache c -o dim --dim lamp=0.25");
    assert_eq!(dim["stages"]["solve"]["cached"], true);
    place.write(
        "room.toml",
        &format!("{SCENE}\n[lights.lamp]\ndim = 0.25\n"),
    );
    let in_scene = place.json("display room.toml --cache c -o scene");
    assert_eq!(in_scene["stages"]["solve"]["cached"], true);
    let read = |folder: &str| fs::read(place.path(&format!("{folder}/room-smooth.ppm"))).unwrap();
    assert_eq!(read("dim"), read("scene"));
    assert_ne!(read("dim"), read("bright"));
}

#[test]
fn lights_that_are_not_there_are_refused() {
    let place = Place::new();
    let (code, _, error) = place.run("relight room.toml --no-cache --dim lmp=1");
    assert_eq!(code, 3);
    insta::assert_snapshot!(error, @"
    error: there is no light `lmp`
       = help: did you mean `lamp`?
    ");
    let (code, _, error) = place.run("relight room.toml --no-cache --dim lamp=1 --dim lamp=2");
    assert!(code == 3 && error.contains("twice"), "{error}");
    for wrong in [
        "--dim lamp",
        "--dim lamp=-1",
        "--tint lamp=1,2",
        "--tint lamp=1,2,x",
    ] {
        let (code, _, error) = place.run(&format!("relight room.toml --no-cache {wrong}"));
        assert_eq!(code, 2, "{error}");
    }
}

/// The oracle sees lights as bright as everybody else: half the light, half of everything.
#[test]
fn the_oracle_is_dimmed_too() {
    let place = Place::new();
    let run = |folder: &str| {
        let arguments = format!("reference room.toml --patches 1 --spp 4 -o {folder}");
        let report = place.json(&arguments);
        let table = report["outputs"]["table"].as_str().unwrap().to_owned();
        radiosities(&place, &table)
    };
    let bright = run("bright");
    place.write("room.toml", &format!("{SCENE}\n[lights.lamp]\ndim = 0.5\n"));
    let dim = run("dim");
    assert!(bright.iter().any(|&number| number > 0.0));
    for (bright, dim) in bright.iter().zip(&dim) {
        // Tables have standard errors to four places.
        assert!((0.5 * bright - dim).abs() <= 1e-4, "{bright} {dim}");
    }
}

/// What single precision does not hold is no solution, by whatever way it comes about, and nothing
/// of it is kept.
#[test]
fn light_out_of_range_is_an_error() {
    let place = Place::new();
    let project = Project::open(&place.path("room.toml")).unwrap();
    let Project {
        mut scene, params, ..
    } = project;
    let store = radiosity::cache::Store::new(place.path("c"));
    let lamp = scene.lights[0].name.clone();
    let mut is_solved = |emission: f64, dim: f64| {
        let is_lamp = |material: &&mut radiosity::scene::Material| material.name == lamp;
        scene.materials.iter_mut().find(is_lamp).unwrap().emission = [1.0, emission, 0.0];
        scene.lights[0].dim = dim;
        let context = Context::new(Some(&store), &Silent);
        let patches = subdivide(&scene, &params.discretization, context).unwrap();
        let factors = estimate(&patches, &params.form_factors).unwrap();
        let solved = solve(&factors, &params.solver);
        match solved.and_then(|solved| solved.light()) {
            Err(Error::Unsolvable { .. }) => false,
            light => light.map(|_| true).unwrap(),
        }
    };
    assert!(!is_solved(1e39, 1.0));
    let solutions = || {
        let entries = store.list().unwrap().into_iter();
        entries
            .filter(|entry| entry.stage.as_deref().ok() == Some("solution"))
            .count()
    };
    assert_eq!(solutions(), 0);
    assert!(is_solved(1e37, 1.0));
    assert!(!is_solved(1e37, 1000.0));
    assert_eq!(solutions(), 1, "brightened, it is the same solution");
}
