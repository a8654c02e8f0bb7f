//! From a scene file to a picture, `cornell.png` in the folder where it runs:
//! `cargo run --release --example cornell`.

use radiosity::renderer::Shading;
use radiosity::{Context, Project, estimate, expose, render, save_png, solve, subdivide};
use std::error::Error;

const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/cornell.toml");

fn main() -> Result<(), Box<dyn Error>> {
    let Project { scene, params, .. } = Project::open(SCENE.as_ref())?;
    let patches = subdivide(&scene, &params.discretization, Context::default())?;
    let factors = estimate(&patches, &params.form_factors)?;
    let light = solve(&factors, &params.solver)?.light()?;
    let camera = scene.first_camera().ok_or("the scene has no camera")?;
    let shadings = [Shading::Smooth];
    let image = expose(&patches, &light, &[camera], &params.image, &shadings);
    let pictures = render(&patches, &light, &camera, &image, &shadings)?;
    save_png("cornell.png".as_ref(), &pictures[0], &image)?;
    println!("cornell.png");
    Ok(())
}
