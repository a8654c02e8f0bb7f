//! Pictures with exact direct light and gathered ones, beside the truth and a path tracer.

use super::{RUNS, figure, first_camera};
use crate::Error;
use crate::figure::{Figure, Target};
use crate::timing::best_seconds;
use radiosity::compare::compare_pictures;
use radiosity::form_factors::Mode;
use radiosity::geometry::{Divisions, PixelFilter};
use radiosity::image::{DecodeParams, Decoded, Image, Regions, decode_picture, decode_regions};
use radiosity::params::NumberOrWord;
use radiosity::reference::Tracer;
use radiosity::renderer::{ImageParams, Shading};
use radiosity::{Context, Project, estimate, render, solve, subdivide};
use std::path::Path;
use std::time::Instant;

/// Of the form factors.
const TOLERANCE: f64 = 0.01;
/// The size that is promised to be within a percent.
pub(super) const GOOD: u32 = 24;
/// Passes of the path tracer, of four samples a pixel, that tell its speed.
const PASSES: u32 = 4;

/// Percent, seconds and times that are promised.
const PERCENT: f64 = 1.0;
const GATHERED_PERCENT: f64 = 0.6;
const VIEW_SECONDS: f64 = 0.5;
const COLD_SECONDS: f64 = 1.2;
const TIMES_THE_TRACER: f64 = 50.0;
/// Million vertices of paths per second and thread.
const TRACER_RATE: f64 = 5.0;

/// The path-traced picture, and its regions.
pub(super) struct Truth {
    picture: Decoded,
    regions: Regions,
}

impl Truth {
    pub(super) fn read(root: &Path) -> Result<Truth, Error> {
        let read = |name: &str| {
            let path = root.join("tests/data").join(name);
            std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))
        };
        let params = DecodeParams::default();
        let picture = decode_picture(&read("cornell-radiance-box.exr")?, &params);
        let regions = decode_regions(&read("cornell-regions.png")?);
        Ok(Truth {
            picture: picture?,
            regions: regions?,
        })
    }

    /// Away from edges, in percent.
    fn error(&self, found: &Image, params: &ImageParams) -> Result<f64, Error> {
        let exposure = params.exposure.number().unwrap_or(0.0);
        let errors = compare_pictures(found, &self.picture, Some(&self.regions), exposure);
        let errors = errors?;
        let away = errors.iter().find(|(name, _)| name == "0-2");
        Ok(away.expect("the map has these regions").1.rmse_percent)
    }
}

/// What a further view takes, and how far it is from the truth.
pub(super) struct View {
    seconds: f64,
    error: f64,
}

fn nearly_exact(project: &Project, divisions: u32) -> Project {
    let mut project = project.clone();
    let params = &mut project.params;
    params.discretization.default = Divisions::uniform(divisions);
    params.form_factors.mode = Mode::Accurate;
    params.form_factors.tolerance = TOLERANCE;
    params.image.filter = PixelFilter::Box;
    project
}

/// All light gathered at samples.
pub(super) fn gathered_view(
    project: &Project,
    divisions: u32,
    truth: &Truth,
) -> Result<Vec<Figure>, Error> {
    let Project { scene, params, .. } = &nearly_exact(project, divisions);
    let camera = first_camera(scene)?;
    let patches = subdivide(scene, &params.discretization, Context::default())?;
    let factors = estimate(&patches, &params.form_factors)?;
    let light = solve(&factors, &params.solver)?.light()?;
    let start = Instant::now();
    let params = &params.image;
    let pictures = render(&patches, &light, &camera, params, &[Shading::Gathered])?;
    let seconds = start.elapsed().as_secs_f64();
    let error = truth.error(&pictures[0], params)?;
    let most = Some(Target::Between(0.0, GATHERED_PERCENT));
    let named = |what: &str, value, unit, target| {
        figure(&format!("gathered.{divisions}.{what}"), value, unit, target)
    };
    Ok(vec![
        named(
            "error",
            error,
            "% away from edges, 4 directions a sample",
            most,
        ),
        named(
            "seconds",
            seconds,
            "s for a further view, all threads",
            None,
        ),
    ])
}

/// Exact direct light, from nearly exact form factors.
pub(super) fn exact_view(
    project: &Project,
    divisions: u32,
    truth: &Truth,
) -> Result<(View, Vec<Figure>), Error> {
    let Project { scene, params, .. } = &nearly_exact(project, divisions);
    let (camera, image) = (first_camera(scene)?, &params.image);
    let start = Instant::now();
    let patches = subdivide(scene, &params.discretization, Context::default())?;
    let factors = estimate(&patches, &params.form_factors)?;
    let light = solve(&factors, &params.solver)?.light()?;
    let pictures = || render(&patches, &light, &camera, image, &[Shading::Exact]);
    let first = pictures()?;
    let cold = start.elapsed().as_secs_f64();
    let seconds = best_seconds(RUNS, || {
        std::hint::black_box(pictures().is_ok());
    });
    let error = truth.error(&first[0], image)?;
    let most = |most: f64| (divisions == GOOD).then_some(Target::Between(0.0, most));
    let named = |what: &str, value, unit, target| {
        figure(&format!("exact.{divisions}.{what}"), value, unit, target)
    };
    let figures = vec![
        named("error", error, "% away from edges", most(PERCENT)),
        named(
            "seconds",
            seconds,
            "s for a further view, all threads",
            most(VIEW_SECONDS),
        ),
        named(
            "cold",
            cold,
            "s with form factors and solution",
            most(COLD_SECONDS),
        ),
    ];
    Ok((View { seconds, error }, figures))
}

/// The time that the path tracer takes to the same error: its square falls with the number of
/// samples.
pub(super) fn beside_the_tracer(
    project: &Project,
    truth: &Truth,
    view: &View,
) -> Result<Vec<Figure>, Error> {
    let params = ImageParams {
        filter: PixelFilter::Box,
        ..project.params.image
    };
    let camera = first_camera(&project.scene)?;
    let mut tracer = Tracer::new(&project.scene, &camera, params.film(), 1)?;
    let start = Instant::now();
    (0..PASSES).for_each(|_| tracer.pass(&|_| ()));
    let seconds = start.elapsed().as_secs_f64();
    let threads = rayon::current_num_threads() as f64;
    let rate = 1e-6 * tracer.vertices() as f64 / seconds / threads;
    let traced = tracer.picture();
    let image = Image {
        width: traced.width,
        height: traced.height,
        pixels: traced
            .radiance
            .iter()
            .map(|p| p.map(|c| c as f32))
            .collect(),
    };
    let error = truth.error(&image, &params)?;
    let equal = seconds * (error / view.error).powi(2);
    Ok(vec![
        figure(
            "tracer.rate",
            rate,
            "million path vertices/s and thread",
            Some(Target::AtLeast(TRACER_RATE)),
        ),
        figure(
            "tracer.error",
            error,
            "% away from edges, 16 samples a pixel",
            None,
        ),
        figure("tracer.equal", equal, "s to the error of the view", None),
        figure(
            "tracer.speedup",
            equal / view.seconds,
            "times the path tracer",
            Some(Target::AtLeast(TIMES_THE_TRACER)),
        ),
    ])
}
