//! Stage 4: images of what cameras see.

use crate::Rgb;
use crate::fields::Fields;
use crate::irradiance_filter::{Fragment, IrradianceFilter};
use crate::params::ImageParams;
use crate::pixel_filter::filtered;
use crate::pixel_sampler::PixelSampler;
use crate::shade::Shader;
use radiosity_geometry::{Camera, Mesh};
use radiosity_image::Image;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// How the light on patches is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shading {
    /// Every patch in its own radiance.
    Constant,
    /// Radiance interpolated smoothly between patches.
    Smooth,
    /// Direct light as it is at each sample, and the rest interpolated smoothly.
    Exact,
    /// The rest gathered at each sample, too.
    Gathered,
}

impl Shading {
    /// How many there are.
    pub(crate) const COUNT: usize = 4;
}

/// The light on a mesh, ready to be looked at from anywhere.
pub struct Renderer<'a> {
    mesh: &'a Mesh,
    shader: Shader<'a>,
}

impl<'a> Renderer<'a> {
    /// For pictures by each of some shadings, of which `params` tell crease angle and directions.
    ///
    /// # Panics
    ///
    /// If a shading is asked for twice.
    pub fn new(
        mesh: &'a Mesh,
        fields: &Fields<'a>,
        params: &ImageParams,
        shadings: &[Shading],
    ) -> Renderer<'a> {
        let is_new = |k: usize| !shadings[..k].contains(&shadings[k]);
        assert!((0..shadings.len()).all(is_new), "each shading once");
        Renderer {
            mesh,
            shader: Shader::new(mesh, fields, params, shadings),
        }
    }

    /// What a camera sees: an image of linear radiance, W/(m^2 sr), by each of the shadings.
    ///
    /// ```
    /// use radiosity_geometry::{Camera, DVec3, Divisions, Shape, subdivide};
    /// use radiosity_renderer::{Fields, ImageParams, Renderer, Shading};
    ///
    /// let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    /// let square = Shape::Quad(corners.map(DVec3::from));
    /// let mesh = subdivide(&[square.into()], Divisions::uniform(1))?;
    /// // One patch, which emits 2 W/m^2 and reflects nothing.
    /// let (emitted, nothing) = ([[2.0; 3]], [[0.0; 3]]);
    /// let fields = Fields {
    ///     sources: &emitted,
    ///     reflectance: &nothing,
    ///     indirect: &nothing,
    ///     visible: &[1.0],
    ///     shown: &emitted,
    ///     emission: &emitted,
    ///     direct: &nothing,
    ///     direct_gain: &nothing,
    ///     gathered_gain: &nothing,
    /// };
    /// let params = ImageParams { width: 4, height: 3, ..ImageParams::default() };
    /// let renderer = Renderer::new(&mesh, &fields, &params, &[Shading::Smooth]);
    ///
    /// let camera = Camera::new(2.0 * DVec3::Z, DVec3::NEG_Z, DVec3::Y, 30.0, 0.0)?;
    /// let images = renderer.render(&camera, &params);
    /// let radiance = 2.0 / std::f32::consts::PI;
    /// assert_eq!(images[0].pixels.len(), 12);
    /// assert!((images[0].pixels[5][0] - radiance).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn render(&self, camera: &Camera, params: &ImageParams) -> Vec<Image> {
        let mut rendering = self.begin(camera, params);
        while rendering.advance().is_some() {}
        rendering.finish()
    }

    /// [`Renderer::render`] some rows at a time, to show progress.
    pub fn begin<'s>(&'s self, camera: &'s Camera, params: &ImageParams) -> Rendering<'s> {
        Rendering::new(self, camera, params)
    }
}

/// Pictures on their way.
pub struct Rendering<'s> {
    renderer: &'s Renderer<'s>,
    /// As they are wanted.
    params: ImageParams,
    /// With the pixels that are sampled: for wide filters, the sub-pixels.
    sampled: ImageParams,
    sampler: PixelSampler<'s>,
    /// Row after row; of each pixel, the shadings one after the other.
    pixels: Vec<Rgb>,
    /// Of each row that is done, what was gathered in it.
    fragments: Vec<Vec<Fragment>>,
    /// So many rows are next.
    step: usize,
}

/// Rows that take less than this are followed by more at a time.
const STEP: Duration = Duration::from_millis(50);
/// Rows of the first step for each thread: threads wait for each other at its end.
const FIRST_ROWS: usize = 2;

impl<'s> Rendering<'s> {
    fn new(renderer: &'s Renderer<'s>, camera: &'s Camera, params: &ImageParams) -> Rendering<'s> {
        let is_wide = params.filter.is_wide();
        let sampled = if is_wide { params.of_parts() } else { *params };
        let count = renderer.shader.shadings().len();
        let size = sampled.width as usize * sampled.height as usize;
        Rendering {
            renderer,
            params: *params,
            sampler: PixelSampler::new(renderer.mesh, &renderer.shader, camera, &sampled),
            pixels: vec![[0.0; 3]; size * count],
            fragments: Vec::new(),
            step: FIRST_ROWS * rayon::current_num_threads(),
            sampled,
        }
    }

    /// How many rows there are.
    pub fn rows(&self) -> u32 {
        self.sampled.height
    }

    /// Takes some more rows and tells how many; `None` if all are done.
    pub fn advance(&mut self) -> Option<u32> {
        let (first, length) = (self.fragments.len(), self.row_length());
        let rows = self.step.min(self.sampled.height as usize - first);
        if rows == 0 || length == 0 {
            return None;
        }
        let start = Instant::now();
        let pixels = &mut self.pixels[first * length..(first + rows) * length];
        let rows = pixels.par_chunks_mut(length).enumerate();
        let sampler = &self.sampler;
        let take = |(y, row): (usize, &mut [Rgb])| sampler.sample_row((first + y) as u32, row);
        self.fragments.par_extend(rows.map(take));
        if start.elapsed() < STEP {
            self.step *= 2;
        }
        Some((self.fragments.len() - first) as u32)
    }

    /// The pictures, once all rows are done.
    pub fn finish(mut self) -> Vec<Image> {
        let shader = &self.renderer.shader;
        if let Some(index) = shader.index_of(Shading::Gathered) {
            self.add_gathered(index);
        }
        let count = shader.shadings().len();
        let image = |k: usize| Image {
            width: self.sampled.width,
            height: self.sampled.height,
            pixels: self.pixels.iter().skip(k).step_by(count).copied().collect(),
        };
        let images = (0..count).map(image);
        if self.params.filter.is_wide() {
            let ImageParams {
                subpixels, filter, ..
            } = self.params;
            return images
                .map(|parts| filtered(&parts, subpixels, filter))
                .collect();
        }
        images.collect()
    }

    fn row_length(&self) -> usize {
        self.sampled.width as usize * self.renderer.shader.shadings().len()
    }

    /// Adds what was gathered to every pixel of one of the shadings.
    fn add_gathered(&mut self, index: usize) {
        let count = self.renderer.shader.shadings().len();
        let length = self.row_length();
        let rows = &self.fragments;
        let filter = IrradianceFilter::new(self.renderer.mesh, rows);
        let row = |(y, row): (usize, &mut [Rgb])| {
            for fragment in &rows[y] {
                let irradiance = filter.irradiance(y, fragment);
                let pixel = &mut row[fragment.x as usize * count + index];
                (0..3).for_each(|c| pixel[c] += fragment.gain[c] * irradiance[c]);
            }
        };
        let chunks = self.pixels.par_chunks_mut(length.max(1));
        chunks.enumerate().for_each(row);
    }
}
