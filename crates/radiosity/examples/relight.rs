//! One solution, two settings of the lamps: nothing is solved for the second.
//! `cargo run --release --example relight`.

use radiosity::solver::relit;
use radiosity::{Pipeline, Silent, Sources, scene};
use std::error::Error;

const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/cornell.toml");
const BLUE: &str = "[materials.blue]\n";

fn main() -> Result<(), Box<dyn Error>> {
    // A second lamp: the blue wall glows.
    let text = std::fs::read_to_string(SCENE)?;
    let text = text.replace(BLUE, &format!("{BLUE}emission = [0, 0, 0.5]\n"));
    let scene = scene::parse(SCENE.as_ref(), &text)?;
    let pipeline = Pipeline::new(&scene, None, &Silent)?;
    let solved = pipeline.solution(Sources::Cached)?;

    let relight = |lamp: f64, wall: f64| {
        // The lights are in the order of their materials' names.
        relit(&solved.solution.lights, &[[wall; 3], [lamp; 3]])
    };
    let (day, night) = (relight(1.0, 0.0), relight(0.05, 1.0));
    println!("W/m^2              day   night");
    let patches = &pipeline.mesh().patches;
    for (index, surface) in scene.surfaces.iter().enumerate() {
        let is_own = |&patch: &usize| patches[patch].surface.index() == index;
        let own: Vec<usize> = (0..patches.len()).filter(is_own).collect();
        let [day, night] = [mean(&day, &own), mean(&night, &own)];
        println!("{:<14}{day:>8.3}{night:>8.3}", surface.name);
    }
    Ok(())
}

/// Over the channels of some patches, which are all of one size.
fn mean(radiosity: &[[f32; 3]], patches: &[usize]) -> f32 {
    let values = patches.iter().flat_map(|&patch| radiosity[patch]);
    values.sum::<f32>() / (3 * patches.len()) as f32
}
