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

/// A picture in the making: better with every pass.
pub struct Tracer<'a> {
    world: World,
    camera: &'a Camera,
    filter: SubpixelTents,
    width: u32,
    height: u32,
    seed: u64,
    passes: u32,
    pixels: Vec<Samples>,
}

impl<'a> Tracer<'a> {
    /// Prepares the scene's picture, with its size and filter, as a camera sees it.
    pub fn new(scene: &Scene, camera: &'a Camera, seed: u64) -> Result<Tracer<'a>, MeshError> {
        let faces = subdivide(&scene.undivided(), Divisions::uniform(1))?;
        let (width, height) = (scene.image.width, scene.image.height);
        Ok(Tracer {
            world: World::new(scene, &faces),
            camera,
            filter: SubpixelTents {
                subpixels: scene.image.subpixels,
            },
            width,
            height,
            seed,
            passes: 0,
            pixels: vec![Samples::default(); width as usize * height as usize],
        })
    }

    /// Random walks per pixel in each pass: one for each sub-pixel.
    pub fn samples_per_pass(&self) -> u32 {
        self.filter.parts()
    }

    /// Random walks per pixel so far.
    pub fn samples(&self) -> u32 {
        self.passes * self.samples_per_pass()
    }

    /// Adds a pass. Its random numbers depend on the seed, the pixel and the number of passes
    /// before it alone. `progress` is told how many further rows are done, from any thread.
    pub fn pass(&mut self, progress: &(dyn Fn(u64) + Sync)) {
        let mut pixels = std::mem::take(&mut self.pixels);
        let rows = pixels.par_chunks_mut(self.width as usize);
        rows.enumerate().for_each(|(y, row)| {
            for (x, pixel) in row.iter_mut().enumerate() {
                self.sample_pixel(x as u32, y as u32, pixel);
            }
            progress(1);
        });
        self.pixels = pixels;
        self.passes += 1;
    }

    /// The picture so far.
    pub fn picture(&self) -> TracedPicture {
        TracedPicture {
            width: self.width,
            height: self.height,
            radiance: self.pixels.iter().map(Samples::mean).collect(),
            standard_error: self.pixels.iter().map(Samples::standard_error).collect(),
        }
    }

    /// The estimated root mean square error of the picture so far, relative to its mean, over
    /// the pixels whose radiance times `exposure` is at most 1 in all channels.
    pub fn relative_error(&self, exposure: f64) -> f64 {
        let (mut squares, mut sum) = (0.0, 0.0);
        let mut values = 0.0;
        for pixel in &self.pixels {
            let radiance = pixel.mean();
            if radiance.iter().all(|c| exposure * c <= 1.0) {
                sum += radiance.iter().sum::<f64>();
                squares += pixel.standard_error().iter().map(|e| e * e).sum::<f64>();
                values += 3.0;
            }
        }
        (squares / values).sqrt() / (sum / values)
    }

    fn sample_pixel(&self, x: u32, y: u32, pixel: &mut Samples) {
        let place = u64::from(y) << 32 | u64::from(x);
        let pass = u64::from(self.passes).rotate_left(48);
        let mut rng = Pcg64Mcg::seed_from_u64(place ^ pass ^ self.seed.rotate_left(17));
        let aspect = f64::from(self.width) / f64::from(self.height);
        for part in 0..self.filter.parts() {
            let uniform = DVec2::new(rng.random(), rng.random());
            let offset = self.filter.offset(part, uniform);
            let film_x = (f64::from(x) + offset.x) / f64::from(self.width);
            let film_y = (f64::from(y) + offset.y) / f64::from(self.height);
            let ray = self.camera.ray(film_x, film_y, aspect);
            let seen = self.world.first_front(&ray, self.camera.near());
            let shown = seen.map_or([0.0; 3], |start| radiosity(&self.world, start, &mut rng));
            pixel.add(shown.map(|b| b / PI));
        }
    }
}
