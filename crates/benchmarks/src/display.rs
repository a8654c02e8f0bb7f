//! How fast pictures are, and how near the truth: beside the course's loop and a path tracer.

mod views;

use crate::Error;
use crate::figure::{Figure, Target, show};
use crate::timing::best_seconds;
use crate::{course, course_display, form_factors};
use radiosity::geometry::Camera;
use radiosity::image::{PictureFormat, encode};
use radiosity::renderer::Shading;
use radiosity::scene::Scene;
use radiosity::{Context, Project, estimate, render, solve, subdivide};
use std::path::Path;
use views::{GOOD, Truth, beside_the_tracer, exact_view, gathered_view};

const BOTH: [Shading; 2] = [Shading::Constant, Shading::Smooth];
/// How often pictures are timed.
const RUNS: u32 = 5;
/// Patches along each edge whose pictures with exact direct light are shown.
const SIZES: [u32; 3] = [12, 24, 48];
/// Patches along each edge that light is gathered from.
const GATHERED: [u32; 2] = [12, 24];

const TIMES_THE_COURSE: f64 = 25.0;
const WHOLE_RUN: f64 = 110.0;

pub(crate) fn run(root: &Path, json: bool) -> Result<(), Error> {
    let project = Project::open(&root.join("scenes/cornell-course.toml"))?;
    let mut figures = beside_the_course(&project)?;
    show(&figures, json);
    figures.clear();
    let truth = Truth::read(root)?;
    let mut errors = Vec::new();
    for divisions in SIZES {
        let (found, more) = exact_view(&project, divisions, &truth)?;
        errors.push((divisions, found));
        figures.extend(more);
    }
    let good = errors.iter().find(|(divisions, _)| *divisions == GOOD);
    let view = good.map(|(_, view)| view).expect("it is one of the sizes");
    for divisions in GATHERED {
        figures.extend(gathered_view(&project, divisions, &truth)?);
    }
    figures.extend(beside_the_tracer(&project, &truth, view)?);
    show(&figures, json);
    Ok(())
}

fn figure(name: &str, value: f64, unit: &'static str, target: Option<Target>) -> Figure {
    Figure::new(format!("display.{name}"), Some(value), unit, target)
}

pub(crate) fn first_camera(scene: &Scene) -> Result<Camera, radiosity::Error> {
    let camera = scene.first_camera();
    camera.ok_or_else(|| radiosity::Error::no_camera(scene))
}

/// Both pictures of the course, and its whole run.
fn beside_the_course(project: &Project) -> Result<Vec<Figure>, Error> {
    let Project { scene, params, .. } = project;
    let patches = subdivide(scene, &params.discretization, Context::default())?;
    let factors = estimate(&patches, &params.form_factors)?;
    let light = solve(&factors, &params.solver)?.light()?;
    let camera = first_camera(scene)?;
    let ours = best_seconds(RUNS, || {
        let pictures = render(&patches, &light, &camera, &params.image, &BOTH);
        std::hint::black_box(pictures.is_ok());
    });
    let (mesh, made) = (&patches.mesh, factors.made()?);
    let course = best_seconds(1, || {
        for is_smooth in [false, true] {
            std::hint::black_box(course_display::render(mesh, &light.radiosity, is_smooth));
        }
    });
    let course_factors = form_factors::baseline_seconds(mesh);
    let whole = course + course_factors + course::seconds(&made.form_factors);
    let folder = tempfile::tempdir()?;
    let mut problem = None;
    let cold = best_seconds(RUNS, || problem = cold_run(project, folder.path()).err());
    if let Some(problem) = problem {
        return Err(problem);
    }
    let most = Some(Target::AtLeast(TIMES_THE_COURSE));
    Ok(vec![
        figure(
            "both.seconds",
            ours,
            "s, 640 x 480 x 16 samples, all threads",
            None,
        ),
        figure(
            "both.course",
            course,
            "s, the course's loop, one thread",
            None,
        ),
        figure(
            "both.speedup",
            course / ours,
            "times the course's loop",
            most,
        ),
        figure(
            "run.seconds",
            cold,
            "s from the scene to both pictures as PPM and PNG",
            None,
        ),
        figure(
            "run.course",
            whole,
            "s, the course's three loops, one thread",
            None,
        ),
        figure(
            "run.speedup",
            whole / cold,
            "times the course's loops",
            Some(Target::AtLeast(WHOLE_RUN)),
        ),
    ])
}

/// Everything that `render` does without a cache, but for words.
fn cold_run(project: &Project, folder: &Path) -> Result<(), Error> {
    let Project { scene, params, .. } = project;
    let patches = subdivide(scene, &params.discretization, Context::default())?;
    let factors = estimate(&patches, &params.form_factors)?;
    let light = solve(&factors, &params.solver)?.light()?;
    let (camera, params) = (first_camera(scene)?, &params.image);
    let pictures = render(&patches, &light, &camera, params, &BOTH)?;
    let tone = params.tone_map();
    for (name, image) in ["constant", "smooth"].into_iter().zip(&pictures) {
        let shown = tone.apply(image);
        for (ending, format) in [
            ("ppm", PictureFormat::Ppm),
            ("png", PictureFormat::Png(tone.transfer)),
        ] {
            let path = folder.join(format!("{name}.{ending}"));
            let written = std::fs::write(&path, encode(&shown, format, &[]));
            written?;
        }
    }
    Ok(())
}
