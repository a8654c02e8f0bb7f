//! The path-traced picture.

use crate::Rgb;
use crate::path::radiosity;
use crate::statistics::Samples;
use crate::world::World;
use radiosity_geometry::{Camera, DVec2, Divisions, MeshError, SubpixelTents, subdivide};
use radiosity_scene::Scene;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use std::f64::consts::PI;

/// A picture of linear radiance in W/(m^2 sr), row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct TracedPicture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Radiance of each pixel.
    pub radiance: Vec<Rgb>,
    /// Standard error of each pixel. Samples are spread over sub-pixels, which is not counted:
    /// the true error is a little smaller.
    pub standard_error: Vec<Rgb>,
}

/// Traces the scene's picture with its size and filter, seen by a camera, with so many random
/// walks per pixel.
///
/// Each pixel has random numbers of its own, so the result does not depend on threads.
/// `progress` is told how many further rows are done, from any thread.
pub fn picture(
    scene: &Scene,
    camera: &Camera,
    samples: u32,
    seed: u64,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<TracedPicture, MeshError> {
    let faces = subdivide(&scene.geometry, Divisions::uniform(1))?;
    let world = World::new(scene, &faces);
    let (width, height) = (scene.image.width, scene.image.height);
    let filter = SubpixelTents {
        subpixels: scene.image.subpixels,
    };
    let pixel = |x: u32, y: u32| {
        let stream = (u64::from(y) << 32 | u64::from(x)) ^ seed.rotate_left(17);
        let mut rng = Pcg64Mcg::seed_from_u64(stream);
        let mut sums = Samples::default();
        for sample in 0..samples {
            let uniform = DVec2::new(rng.random(), rng.random());
            let offset = filter.offset(sample % filter.parts(), uniform);
            let film_x = (f64::from(x) + offset.x) / f64::from(width);
            let film_y = (f64::from(y) + offset.y) / f64::from(height);
            let aspect = f64::from(width) / f64::from(height);
            let ray = camera.ray(film_x, film_y, aspect);
            let seen = world.first_front(&ray, camera.near());
            let shown = seen.map_or([0.0; 3], |start| radiosity(&world, start, &mut rng));
            sums.add(shown.map(|b| b / PI));
        }
        (sums.mean(), sums.standard_error())
    };
    let row = |y: u32| {
        let row: Vec<(Rgb, Rgb)> = (0..width).map(|x| pixel(x, y)).collect();
        progress(1);
        row
    };
    let rows: Vec<Vec<(Rgb, Rgb)>> = (0..height).into_par_iter().map(row).collect();
    let (radiance, standard_error) = rows.into_iter().flatten().unzip();
    Ok(TracedPicture {
        width,
        height,
        radiance,
        standard_error,
    })
}
