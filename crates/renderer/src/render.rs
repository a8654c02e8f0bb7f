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

/// How light is shown beside the shading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadingParams {
    /// Degrees between normals below which neighbouring faces of a mesh are shaded as one smooth
    /// surface.
    pub crease_angle: f64,
    /// Directions in which [`Shading::Gathered`] looks from each sample.
    pub directions: u32,
}

impl Default for ShadingParams {
    fn default() -> ShadingParams {
        ShadingParams {
            crease_angle: 30.0,
            directions: 4,
        }
    }
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
    /// For pictures by each of some shadings.
    ///
    /// # Panics
    ///
    /// If a shading is asked for twice.
    pub fn new(
        mesh: &'a Mesh,
        fields: &Fields<'a>,
        params: &ShadingParams,
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
    /// `progress` is told how many further rows are done, from any thread.
    ///
    /// ```
    /// use radiosity_geometry::{Camera, DVec3, Divisions, Shape, Surface, subdivide};
    /// use radiosity_renderer::{Fields, ImageParams, Renderer, Shading, ShadingParams};
    ///
    /// let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    /// let square = Surface {
    ///     shape: Shape::Quad(corners.map(DVec3::from)),
    ///     divisions: None,
    /// };
    /// let mesh = subdivide(&[square], Divisions::uniform(1))?;
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
    /// let renderer = Renderer::new(&mesh, &fields, &ShadingParams::default(), &[Shading::Smooth]);
    ///
    /// let camera = Camera::new(2.0 * DVec3::Z, DVec3::NEG_Z, DVec3::Y, 30.0, 0.0)?;
    /// let params = ImageParams { width: 4, height: 3, ..ImageParams::default() };
    /// let images = renderer.render(&camera, &params, &|_| ());
    /// let radiance = 2.0 / std::f32::consts::PI;
    /// assert_eq!(images[0].pixels.len(), 12);
    /// assert!((images[0].pixels[5][0] - radiance).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn render(
        &self,
        camera: &Camera,
        params: &ImageParams,
        progress: &(dyn Fn(u64) + Sync),
    ) -> Vec<Image> {
        if params.filter.is_wide() {
            let parts = self.render(camera, &params.of_parts(), progress);
            let images = parts
                .iter()
                .map(|parts| filtered(parts, params.subpixels, params.filter));
            return images.collect();
        }
        let sampler = PixelSampler::new(self.mesh, &self.shader, camera, params);
        let (width, height) = (params.width as usize, params.height as usize);
        let count = self.shader.shadings().len();
        let mut pixels = vec![[0.0; 3]; width * height * count];
        let rows = pixels.par_chunks_mut((width * count).max(1)).enumerate();
        let take = |(y, row): (usize, &mut [Rgb])| {
            let fragments = sampler.sample_row(y as u32, row);
            progress(1);
            fragments
        };
        let fragments: Vec<Vec<Fragment>> = rows.map(take).collect();
        if let Some(index) = self.shader.index_of(Shading::Gathered) {
            self.add_gathered(&fragments, &mut pixels, (width, index));
        }
        let image = |k: usize| Image {
            width: params.width,
            height: params.height,
            pixels: pixels.iter().skip(k).step_by(count).copied().collect(),
        };
        (0..count).map(image).collect()
    }

    /// Adds what was gathered to every pixel of one of the shadings.
    fn add_gathered(
        &self,
        rows: &[Vec<Fragment>],
        pixels: &mut [Rgb],
        (width, index): (usize, usize),
    ) {
        let count = self.shader.shadings().len();
        let filter = IrradianceFilter::new(self.mesh, rows);
        let row = |(y, row): (usize, &mut [Rgb])| {
            for fragment in &rows[y] {
                let irradiance = filter.irradiance(y, fragment);
                let pixel = &mut row[fragment.x as usize * count + index];
                (0..3).for_each(|c| pixel[c] += fragment.gain[c] * irradiance[c]);
            }
        };
        let chunks = pixels.par_chunks_mut((width * count).max(1));
        chunks.enumerate().for_each(row);
    }
}
