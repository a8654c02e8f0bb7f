//! From a scene file to a picture, `cornell.png` in the folder where it runs:
//! `cargo run --release --example cornell`.

use radiosity::image::{PictureFormat, encode};
use radiosity::renderer::Shading;
use radiosity::settings::{tone_map, transfer};
use radiosity::{Pipeline, Silent, Sources, scene};
use std::error::Error;

const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/cornell.toml");

fn main() -> Result<(), Box<dyn Error>> {
    let scene = scene::load(SCENE.as_ref())?;
    let pipeline = Pipeline::new(&scene, None, &Silent)?;
    let solved = pipeline.solution(Sources::Cached)?;
    let pictures = pipeline.pictures(&solved.light, &[Shading::Smooth])?;

    let levels = tone_map(&scene.image).apply(&pictures[0]);
    let format = PictureFormat::Png(transfer(scene.image.gamma));
    std::fs::write("cornell.png", encode(&levels, format, &[]))?;
    println!("cornell.png");
    Ok(())
}
