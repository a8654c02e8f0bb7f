//! Stage 4: rays from the camera.

use crate::fields::Fields;
use crate::image::Image;
use crate::interpolate::{DEFAULT_CREASE_ANGLE, Interpolant};
use crate::{Rgb, add_scaled};
use radiosity_geometry::{Camera, DVec2, Film, Mesh, Occluders, PixelFilter, Ray};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use std::f32::consts::PI;

/// How pictures are sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageParams {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Sub-pixels along each edge of a pixel.
    pub subpixels: u32,
    /// How samples are spread around sub-pixels.
    pub filter: PixelFilter,
    /// Samples per sub-pixel.
    pub samples: u32,
    /// Seed of the sample positions.
    pub seed: u64,
    /// Degrees between normals below which neighbouring triangles are shaded as one smooth
    /// surface.
    pub crease_angle: f64,
}

impl Default for ImageParams {
    /// The course's pictures.
    fn default() -> ImageParams {
        ImageParams {
            width: 640,
            height: 480,
            subpixels: 2,
            filter: PixelFilter::default(),
            samples: 4,
            seed: 0,
            crease_angle: DEFAULT_CREASE_ANGLE,
        }
    }
}

impl ImageParams {
    fn film(&self) -> Film {
        Film {
            width: self.width,
            height: self.height,
            subpixels: self.subpixels,
            filter: self.filter,
        }
    }
}

/// Both pictures of one pass.
#[derive(Clone, Debug, PartialEq)]
pub struct Pictures {
    /// Every patch in its own radiance.
    pub constant: Image,
    /// Radiance interpolated smoothly between patches.
    pub smooth: Image,
}

/// Renders both pictures. `progress` is told how many further rows are done, from any thread.
pub fn render(
    mesh: &Mesh,
    fields: &Fields<'_>,
    camera: &Camera,
    params: &ImageParams,
    progress: &(dyn Fn(u64) + Sync),
) -> Pictures {
    let view = View {
        mesh,
        occluders: Occluders::new(mesh),
        interpolant: Interpolant::new(mesh, fields, params.crease_angle),
        camera,
        params,
    };
    let mut constant = Image::black(params.width, params.height);
    let mut smooth = constant.clone();
    let width = params.width as usize;
    let rows = constant.pixels.par_chunks_mut(width);
    rows.zip(smooth.pixels.par_chunks_mut(width))
        .enumerate()
        .for_each(|(y, (constant, smooth))| {
            for (x, both) in constant.iter_mut().zip(smooth).enumerate() {
                (*both.0, *both.1) = view.pixel(x as u32, y as u32);
            }
            progress(1);
        });
    Pictures { constant, smooth }
}

struct View<'a> {
    mesh: &'a Mesh,
    occluders: Occluders,
    interpolant: Interpolant<'a>,
    camera: &'a Camera,
    params: &'a ImageParams,
}

impl View<'_> {
    /// The radiance of a pixel, patch-constant and smooth. Its random numbers depend on the
    /// seed and its position alone.
    fn pixel(&self, x: u32, y: u32) -> (Rgb, Rgb) {
        let ImageParams { samples, seed, .. } = *self.params;
        let stream = (u64::from(y) << 32 | u64::from(x)) ^ seed.rotate_left(17);
        let mut rng = Pcg64Mcg::seed_from_u64(stream);
        let film = self.params.film();
        let count = film.parts() * samples;
        let weight = 1.0 / (PI * count as f32);
        let (mut constant, mut smooth) = ([0.0; 3], [0.0; 3]);
        for index in 0..count {
            let uniform = DVec2::new(rng.random(), rng.random());
            let ray = film.ray(self.camera, x, y, index / samples, uniform);
            if let Some(both) = self.radiosity(&ray) {
                add_scaled(&mut constant, weight, both.0);
                add_scaled(&mut smooth, weight, both.1);
            }
        }
        (constant, smooth)
    }

    /// The radiosities that a ray sees; none on backs and in the background.
    fn radiosity(&self, ray: &Ray) -> Option<(Rgb, Rgb)> {
        let near = self.camera.near();
        let hit = self.occluders.closest_hit(ray, near, f64::INFINITY, None)?;
        if !hit.front {
            return None;
        }
        let at = self.mesh.locate(hit.face, ray.at(hit.t));
        Some((self.interpolant.constant(&at), self.interpolant.smooth(&at)))
    }
}
