//! How fast pictures are, and how near the truth: beside the course's loop and a path tracer.

use super::{Figure, Target, best_seconds, course, course_display, form_factors};
use radiosity::compare::compare_pictures;
use radiosity::geometry::{Divisions, PixelFilter};
use radiosity::image::{
    DecodeParams, Decoded, Image, PictureFormat, Regions, ToneMap, Transfer, decode_picture,
    decode_regions, encode,
};
use radiosity::reference::Tracer;
use radiosity::renderer::Shading;
use radiosity::scene::{Mode, Scene, load};
use radiosity::{Error, Pipeline, Silent, Sources};
use std::path::Path;
use std::time::Instant;

const BOTH: [Shading; 2] = [Shading::Constant, Shading::Smooth];
/// How often pictures are timed.
const RUNS: u32 = 5;
/// Patches along each edge whose pictures with exact direct light are shown, and the tolerance of
/// their form factors.
const SIZES: [u32; 3] = [12, 24, 48];
const TOLERANCE: f64 = 0.01;
/// The size that is promised to be within a percent.
const GOOD: u32 = 24;
/// Passes of the path tracer, of four samples a pixel, that tell its speed.
const PASSES: u32 = 4;

/// Patches along each edge that light is gathered from.
const GATHERED: [u32; 2] = [12, 24];

const TIMES_THE_COURSE: f64 = 25.0;
const WHOLE_RUN: f64 = 110.0;
const PERCENT: f64 = 1.0;
const GATHERED_PERCENT: f64 = 0.6;
const VIEW_SECONDS: f64 = 0.5;
const COLD_SECONDS: f64 = 1.2;
const TIMES_THE_TRACER: f64 = 50.0;
/// Million vertices of paths per second and thread.
const TRACER_RATE: f64 = 5.0;

pub(super) fn run(root: &Path, json: bool) -> Result<(), Error> {
    let scene = load(&root.join("scenes/cornell.toml"))?;
    let mut figures = beside_the_course(&scene)?;
    super::show(&figures, json);
    figures.clear();
    let truth = Truth::read(root)?;
    let mut errors = Vec::new();
    for divisions in SIZES {
        let (found, more) = exact_view(&scene, divisions, &truth)?;
        errors.push((divisions, found));
        figures.extend(more);
    }
    let good = errors.iter().find(|(divisions, _)| *divisions == GOOD);
    let view = good.map(|(_, view)| view).expect("it is one of the sizes");
    for divisions in GATHERED {
        figures.extend(gathered_view(&scene, divisions, &truth)?);
    }
    figures.extend(beside_the_tracer(&scene, &truth, view)?);
    super::show(&figures, json);
    Ok(())
}

fn figure(name: &str, value: f64, unit: &'static str, target: Option<Target>) -> Figure {
    Figure::new(format!("display.{name}"), Some(value), unit, target)
}

/// Both pictures of the course, and its whole run.
fn beside_the_course(scene: &Scene) -> Result<Vec<Figure>, Error> {
    let pipeline = Pipeline::new(scene, None, &Silent)?;
    let made = pipeline.form_factors(Sources::Cached)?.form_factors;
    let light = pipeline.solution(Sources::Cached)?.light;
    let ours = best_seconds(RUNS, || {
        std::hint::black_box(pipeline.pictures(&light, &BOTH).is_ok());
    });
    let mesh = pipeline.mesh();
    let course = best_seconds(1, || {
        for is_smooth in [false, true] {
            std::hint::black_box(course_display::render(mesh, &light.radiosity, is_smooth));
        }
    });
    let course_factors = form_factors::baseline_seconds(mesh);
    let whole = course + course_factors + course::seconds(&made);
    let folder = tempfile::tempdir().map_err(|error| Error::Output {
        path: std::env::temp_dir(),
        error,
    })?;
    let mut problem = None;
    let cold = best_seconds(RUNS, || problem = cold_run(scene, folder.path()).err());
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
fn cold_run(scene: &Scene, folder: &Path) -> Result<(), Error> {
    let pipeline = Pipeline::new(scene, None, &Silent)?;
    let light = pipeline.solution(Sources::Cached)?.light;
    let pictures = pipeline.pictures(&light, &BOTH)?;
    let transfer = Transfer::Gamma(2.2);
    let tone = ToneMap::clamped(scene.image.exposure.factor().unwrap_or(1.0), transfer);
    for (name, image) in ["constant", "smooth"].into_iter().zip(&pictures) {
        let shown = tone.apply(image);
        for (ending, format) in [
            ("ppm", PictureFormat::Ppm),
            ("png", PictureFormat::Png(transfer)),
        ] {
            let path = folder.join(format!("{name}.{ending}"));
            let written = std::fs::write(&path, encode(&shown, format, &[]));
            written.map_err(|error| Error::Output { path, error })?;
        }
    }
    Ok(())
}

fn unreadable(error: impl std::fmt::Display) -> Error {
    Error::Input(error.to_string())
}

/// The path-traced picture, and its regions.
struct Truth {
    picture: Decoded,
    regions: Regions,
}

impl Truth {
    fn read(root: &Path) -> Result<Truth, Error> {
        let read = |name: &str| {
            let path = root.join("tests/data").join(name);
            std::fs::read(&path)
                .map_err(|error| Error::Input(format!("{}: {error}", path.display())))
        };
        let params = DecodeParams::default();
        let picture = decode_picture(&read("cornell-radiance-box.exr")?, &params);
        let regions = decode_regions(&read("cornell-regions.png")?);
        Ok(Truth {
            picture: picture.map_err(unreadable)?,
            regions: regions.map_err(unreadable)?,
        })
    }

    /// Away from edges, in percent.
    fn error(&self, found: &Image, scene: &Scene) -> Result<f64, Error> {
        let exposure = scene.image.exposure.factor().unwrap_or(0.0);
        let errors = compare_pictures(found, &self.picture, Some(&self.regions), exposure);
        let errors = errors.map_err(unreadable)?;
        let away = errors.iter().find(|(name, _)| name == "0-2");
        Ok(away.expect("the map has these regions").1.rmse_percent)
    }
}

/// What a further view takes, and how far it is from the truth.
struct View {
    seconds: f64,
    error: f64,
}

fn nearly_exact(scene: &Scene, divisions: u32) -> Scene {
    let mut scene = scene.clone();
    scene.divisions = Divisions::uniform(divisions);
    scene.form_factors.mode = Mode::Accurate;
    scene.form_factors.tolerance = TOLERANCE;
    scene.image.filter = PixelFilter::Box;
    scene
}

/// All light gathered at samples.
fn gathered_view(scene: &Scene, divisions: u32, truth: &Truth) -> Result<Vec<Figure>, Error> {
    let scene = nearly_exact(scene, divisions);
    let pipeline = Pipeline::new(&scene, None, &Silent)?;
    let light = pipeline.solution(Sources::Cached)?.light;
    let start = Instant::now();
    let pictures = pipeline.pictures(&light, &[Shading::Gathered])?;
    let seconds = start.elapsed().as_secs_f64();
    let error = truth.error(&pictures[0], &scene)?;
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
fn exact_view(scene: &Scene, divisions: u32, truth: &Truth) -> Result<(View, Vec<Figure>), Error> {
    let scene = nearly_exact(scene, divisions);
    let start = Instant::now();
    let pipeline = Pipeline::new(&scene, None, &Silent)?;
    let light = pipeline.solution(Sources::Cached)?.light;
    let pictures = pipeline.pictures(&light, &[Shading::Exact])?;
    let cold = start.elapsed().as_secs_f64();
    let seconds = best_seconds(RUNS, || {
        std::hint::black_box(pipeline.pictures(&light, &[Shading::Exact]).is_ok());
    });
    let error = truth.error(&pictures[0], &scene)?;
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

/// The time that the path tracer takes to the same error: its square falls with the number of samples.
fn beside_the_tracer(scene: &Scene, truth: &Truth, view: &View) -> Result<Vec<Figure>, Error> {
    let mut scene = scene.clone();
    scene.image.filter = PixelFilter::Box;
    let camera = scene.camera.ok_or_else(|| Error::no_camera(&scene))?;
    let mut tracer =
        Tracer::new(&scene, &camera, 1).map_err(|error| Error::Mesh(error.to_string()))?;
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
    let error = truth.error(&image, &scene)?;
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
