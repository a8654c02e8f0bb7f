//! What the modes are judged by: long random walks and path-traced pictures.

use crate::Error;
use crate::display::first_camera;
use crate::figure::Figure;
use radiosity::compare::{Errors, Table, compare_pictures, compare_tables};
use radiosity::geometry::Mesh;
use radiosity::image::{Decoded, Image};
use radiosity::params::NumberOrWord;
use radiosity::reference::{Tracer, cell_means};
use radiosity::renderer::Shading;
use radiosity::scene::Scene;
use radiosity::{
    Context, Params, Project, cells, estimate, radiosity_table, reference_table, render, solve,
    subdivide,
};

/// Random walks of the oracle, shared by all patches.
const WALKS: usize = 40_000_000;
/// Of each of the two pictures.
const PASSES: u32 = 16;

/// What the modes are judged by.
pub(super) struct Oracle {
    table: Table,
    picture: Decoded,
    /// Root mean square errors, in percent of the mean.
    table_noise: f64,
    picture_noise: f64,
}

/// The errors of one mode, in percent.
pub(super) struct Accuracy {
    pub(super) rmse: f64,
    pub(super) bias: f64,
    pub(super) picture_rmse: f64,
    /// Time of the form factors.
    pub(super) seconds: f64,
}

impl Oracle {
    pub(super) fn of(project: &Project) -> Result<Oracle, Error> {
        let Project { scene, params, .. } = project;
        let patches = subdivide(scene, &params.discretization, Context::default())?;
        let mesh = &patches.mesh;
        let walks = WALKS.div_ceil(mesh.patches.len()) as u32;
        let means = cell_means(scene, mesh, walks, 1, &|_| ());
        let [a, b] = [trace(project, 2)?, trace(project, 3)?];
        // Half their difference has the variance of their mean.
        let halves = picture_rmse(&a, &decoded(b.clone()), params)?;
        let mean = |(a, b): (&[f32; 3], &[f32; 3])| std::array::from_fn(|c| 0.5 * (a[c] + b[c]));
        let pixels = a.pixels.iter().zip(&b.pixels).map(mean).collect();
        let table = reference_table(scene, mesh, &means);
        let itself = table_errors(scene, mesh, &table, &table)?;
        Ok(Oracle {
            table,
            table_noise: itself.noise_percent.unwrap_or(0.0),
            picture: decoded(Image { pixels, ..a }),
            picture_noise: 0.5 * halves,
        })
    }

    pub(super) fn noise(&self, scene: &str) -> [Figure; 2] {
        let noises = [
            ("radiosity", self.table_noise),
            ("picture", self.picture_noise),
        ];
        noises.map(|(what, noise)| {
            let name = format!("oracle.{scene}.{what}_noise");
            Figure::new(name, Some(noise), "%", None)
        })
    }

    /// Renders a scene and compares; `None` if it has no solution.
    pub(super) fn judge(&self, project: &Project) -> Result<Option<Accuracy>, Error> {
        let Project { scene, params, .. } = project;
        let patches = subdivide(scene, &params.discretization, Context::default())?;
        let factors = estimate(&patches, &params.form_factors)?;
        let solved = match solve(&factors, &params.solver) {
            Err(radiosity::Error::Unsolvable { .. }) => return Ok(None),
            solved => solved?,
        };
        let light = solved.light()?;
        let found = radiosity_table(scene, &patches.mesh, &light.mean_radiosity());
        let all = table_errors(scene, &patches.mesh, &found, &self.table)?;
        let camera = first_camera(scene)?;
        let smooth = render(&patches, &light, &camera, &params.image, &[Shading::Smooth])?;
        let squares = picture_rmse(&smooth[0], &self.picture, params)?.powi(2);
        Ok(Some(Accuracy {
            rmse: all.rmse_percent_without_noise(),
            bias: all.bias_percent,
            picture_rmse: (squares - self.picture_noise.powi(2)).max(0.0).sqrt(),
            seconds: solved.form_factors.seconds,
        }))
    }
}

/// Over the patches that do not emit; over all, where all emit.
fn table_errors(
    scene: &Scene,
    mesh: &Mesh,
    found: &Table,
    reference: &Table,
) -> Result<Errors, Error> {
    let mut cells = cells(scene, mesh);
    if cells.iter().all(|cell| cell.emits) {
        cells.iter_mut().for_each(|cell| cell.emits = false);
    }
    let errors = compare_tables(&cells, found, reference);
    let errors = errors?;
    Ok(errors[errors.len() - 1].1)
}

fn trace(project: &Project, seed: u64) -> Result<Image, Error> {
    let mut tracer = tracer(project, seed)?;
    (0..PASSES).for_each(|_| tracer.pass(&|_| ()));
    let traced = tracer.picture();
    let to_f32 = |pixel: &[f64; 3]| pixel.map(|channel| channel as f32);
    Ok(Image {
        width: traced.width,
        height: traced.height,
        pixels: traced.radiance.iter().map(to_f32).collect(),
    })
}

pub(super) fn tracer(project: &Project, seed: u64) -> Result<Tracer<'_>, Error> {
    let Project { scene, params, .. } = project;
    let camera = scene.camera.as_ref();
    let camera = camera.ok_or_else(|| radiosity::Error::no_camera(scene))?;
    Ok(Tracer::new(scene, camera, params.image.film(), seed)?)
}

fn decoded(image: Image) -> Decoded {
    Decoded {
        image,
        levels: false,
    }
}

/// Over the pixels that the reference shows unclamped, in percent of their mean.
fn picture_rmse(found: &Image, reference: &Decoded, params: &Params) -> Result<f64, Error> {
    let errors = compare_pictures(
        found,
        reference,
        None,
        params.image.exposure.number().unwrap_or(0.0),
    );
    let errors = errors?;
    Ok(errors[errors.len() - 1].1.rmse_percent)
}
