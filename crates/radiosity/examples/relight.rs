//! One solution, two settings of the lamps: nothing is solved for the second.
//! `cargo run --release --example relight`.

use radiosity::stages::Dimming;
use radiosity::{Context, Project, estimate, solve, subdivide};
use std::error::Error;

const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/cornell.toml");
const BLUE: &str = "[materials.blue]\n";

fn main() -> Result<(), Box<dyn Error>> {
    // A second lamp: the blue wall glows.
    let text = std::fs::read_to_string(SCENE)?;
    let text = text.replace(BLUE, &format!("{BLUE}emission = [0, 0, 0.5]\n"));
    let Project { scene, params, .. } = Project::parse(SCENE.as_ref(), &text)?;
    let patches = subdivide(&scene, &params.discretization, Context::default())?;
    let factors = estimate(&patches, &params.form_factors)?;
    let solved = solve(&factors, &params.solver)?;

    let relight = |lamp: f64, wall: f64| {
        let mut dimming = Dimming::of(&scene);
        dimming.light("lamp")?.dim = lamp;
        dimming.light("blue")?.dim = wall;
        solved.relight(&dimming)
    };
    let [day, night] = [relight(1.0, 0.0)?, relight(0.05, 1.0)?];
    println!("W/m^2              day   night");
    for (index, surface) in scene.surfaces.iter().enumerate() {
        let of_surface = |patch: &usize| patches.mesh.patches[*patch].surface.index() == index;
        let own: Vec<usize> = (0..patches.mesh.patches.len()).filter(of_surface).collect();
        let [day, night] = [&day, &night].map(|light| mean(&light.radiosity, &own));
        println!("{:<14}{day:>8.3}{night:>8.3}", surface.name);
    }
    Ok(())
}

/// Over the channels of some patches, which are all of one size.
fn mean(radiosity: &[[f32; 3]], patches: &[usize]) -> f32 {
    let values = patches.iter().flat_map(|&patch| radiosity[patch]);
    values.sum::<f32>() / (3 * patches.len()) as f32
}
