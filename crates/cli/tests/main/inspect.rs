//! What the command says of cached files.

use crate::place::Place;
use std::fs;

fn file(place: &Place, stage: &str) -> String {
    place.artifact(stage).to_str().unwrap().to_owned()
}

fn solved() -> Place {
    let place = Place::new();
    place.succeed("solve room.toml --cache c");
    place
}

#[test]
fn form_factors_are_described() {
    let place = solved();
    let form_factors = file(&place, "form-factors");
    let said = place.succeed(&format!("inspect {form_factors} --scene room.toml"));
    for part in [
        "no byte is damaged",
        "accurate, tolerance 0.01; 17 patches of 4 surfaces",
        "rows by |fronts + backs + background - 1|",
        "worst rows",
        "in row ",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(
        !said.contains("`surface "),
        "surfaces have their names: {said}"
    );
    let found = place.json(&format!("inspect {form_factors}"));
    let found = &found["form_factors"];
    assert_eq!(found["patches"], 17);
    assert_eq!(found["estimator"]["mode"], "accurate");
    assert!(found["row_sum_mean"].is_f64());
    assert_eq!(found["worst"].as_array().unwrap().len(), 5);
    let counts = found["off_by"].as_array().unwrap();
    let rows: u64 = counts.iter().map(|count| count.as_u64().unwrap()).sum();
    assert_eq!(rows, 17);
    let worst = &found["worst"][0];
    let facts = ["fronts", "backs", "background"].map(|f| worst["facts"][f].as_f64().unwrap());
    let excess = facts.iter().sum::<f64>() - 1.0;
    assert!((worst["excess"].as_f64().unwrap() - excess).abs() < 1e-12);
    let name = worst["surface"].as_str().unwrap();
    assert!(name.starts_with("surface "), "no scene is at hand: {name}");
}

/// The scene that used a file last is looked up for the names of its surfaces.
#[test]
fn the_last_scene_names_surfaces() {
    let place = solved();
    fs::create_dir(place.path("scenes")).unwrap();
    fs::copy(place.path("room.toml"), place.path("scenes/room.toml")).unwrap();
    fs::copy(place.path("block.obj"), place.path("scenes/block.obj")).unwrap();
    let said = place.succeed(&format!("inspect {}", file(&place, "form-factors")));
    assert!(
        said.contains("`floor`") && !said.contains("`surface "),
        "{said}"
    );
}

#[test]
fn solutions_are_described() {
    let place = solved();
    let solution = file(&place, "solution");
    let said = place.succeed(&format!("inspect {solution}"));
    assert!(
        said.contains("17 patches") && said.contains("sweeps: residual"),
        "{said}"
    );
    let found = place.json(&format!("inspect {solution}"));
    assert_eq!(found["solution"]["converged"], true);
}

#[test]
fn what_cannot_be_read_is_explained() {
    let place = solved();
    let form_factors = file(&place, "form-factors");
    let mut bytes = fs::read(&form_factors).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    fs::write(&form_factors, bytes).unwrap();
    for (path, part) in [
        (&form_factors[..], "data is damaged (block 0)"),
        ("room.toml", "is not a cache file"),
        ("nothing.bin", "cannot be read"),
    ] {
        let (code, message) = place.fail(&format!("inspect {path}"));
        assert_eq!(code, 3);
        assert!(
            message.contains(part) && message.contains("help: "),
            "{message}"
        );
    }
}
