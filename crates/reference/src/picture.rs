//! The path-traced picture.

use crate::Rgb;
use crate::path::{Walk, walk};
use crate::statistics::Samples;
use crate::world::World;
use radiosity_geometry::{Camera, DVec2, Discretization, Film, MeshError, subdivide};
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
    film: Film,
    seed: u64,
    passes: u32,
    vertices: u64,
    pixels: Vec<Samples>,
}

impl<'a> Tracer<'a> {
    /// Prepares a picture of the scene on a film, as a camera sees it.
    pub fn new(
        scene: &Scene,
        camera: &'a Camera,
        film: Film,
        seed: u64,
    ) -> Result<Tracer<'a>, MeshError> {
        let by_faces = Discretization::uniform(1);
        let faces = subdivide(&by_faces.of_shapes(scene.shapes()), by_faces.default)?;
        let pixels = film.width as usize * film.height as usize;
        Ok(Tracer {
            world: World::new(scene, &faces),
            camera,
            film,
            seed,
            passes: 0,
            vertices: 0,
            pixels: vec![Samples::default(); pixels],
        })
    }

    /// Random walks per pixel in each pass: one for each sub-pixel.
    pub fn samples_per_pass(&self) -> u32 {
        self.film.parts()
    }

    /// Random walks per pixel so far.
    pub fn samples(&self) -> u32 {
        self.passes * self.samples_per_pass()
    }

    /// Points of surfaces where light was gathered so far, the seen ones included: the work
    /// done. Each took a ray to find it, and a ray to an emitter where that faces it.
    pub fn vertices(&self) -> u64 {
        self.vertices
    }

    /// Adds a pass. Its random numbers depend on the seed, the pixel and the number of passes
    /// before it alone. `progress` is told how many further rows are done, from any thread.
    pub fn pass(&mut self, progress: &(dyn Fn(u64) + Sync)) {
        let mut pixels = std::mem::take(&mut self.pixels);
        let rows = pixels.par_chunks_mut(self.film.width as usize);
        let trace_row = |(y, row): (usize, &mut [Samples])| -> u64 {
            let columns = row.iter_mut().enumerate();
            let vertices = columns.map(|(x, pixel)| self.sample_pixel(x as u32, y as u32, pixel));
            let vertices = vertices.sum();
            progress(1);
            vertices
        };
        self.vertices += rows.enumerate().map(trace_row).sum::<u64>();
        self.pixels = pixels;
        self.passes += 1;
    }

    /// The picture so far.
    pub fn picture(&self) -> TracedPicture {
        TracedPicture {
            width: self.film.width,
            height: self.film.height,
            radiance: self.pixels.iter().map(Samples::mean).collect(),
            standard_error: self.pixels.iter().map(Samples::standard_error).collect(),
        }
    }

    /// The estimated root mean square error of the picture so far, relative to its mean, over
    /// the pixels whose radiance times `exposure` is at most 1 in all channels; if there are
    /// none, over all pixels. A black picture has no error.
    pub fn relative_error(&self, exposure: f64) -> f64 {
        let shown = |pixel: &&Samples| pixel.mean().iter().all(|c| exposure * c <= 1.0);
        let unclamped: Vec<&Samples> = self.pixels.iter().filter(shown).collect();
        if unclamped.is_empty() {
            relative_error(self.pixels.iter())
        } else {
            relative_error(unclamped.into_iter())
        }
    }

    /// Adds a sample to each part of a pixel; returns the number of vertices.
    fn sample_pixel(&self, x: u32, y: u32, pixel: &mut Samples) -> u64 {
        let place = u64::from(y) << 32 | u64::from(x);
        let pass = u64::from(self.passes).rotate_left(48);
        let mut rng = Pcg64Mcg::seed_from_u64(place ^ pass ^ self.seed.rotate_left(17));
        let mut vertices = 0;
        for part in 0..self.film.parts() {
            let uniform = DVec2::new(rng.random(), rng.random());
            let (ray, weight) = self.film.ray(self.camera, x, y, part, uniform);
            let seen = self.world.first_front(&ray, self.camera.near());
            let walk = seen.map_or(Walk::default(), |start| walk(&self.world, start, &mut rng));
            pixel.add(walk.radiosity.map(|b| weight * b / PI));
            vertices += u64::from(walk.vertices);
        }
        vertices
    }
}

/// The root mean square of the standard errors relative to the mean; zero in the dark.
fn relative_error<'a>(pixels: impl Iterator<Item = &'a Samples>) -> f64 {
    let (mut squares, mut sum, mut values) = (0.0, 0.0, 0.0);
    for pixel in pixels {
        squares += pixel.standard_error().iter().map(|e| e * e).sum::<f64>();
        sum += pixel.mean().iter().sum::<f64>();
        values += 3.0;
    }
    if sum > 0.0 {
        (squares / values).sqrt() / (sum / values)
    } else {
        0.0
    }
}
