//! `reference`: the oracle's pictures and tables.

use super::folders::Folders;
use super::reference_args::ReferenceCommand;
use super::reference_report::{Json, PictureReport};
use super::run::{make_folder, with_threads, write};
use super::terminal::{Terminal, say_json};
use crate::error::Error;
use crate::lines::{indented, labelled};
use radiosity::geometry::Discretization;
use radiosity::image::{Exposure, Image, PictureFormat, encode, encode_pfm};
use radiosity::params::NumberOrWord;
use radiosity::reference::{Tracer, cell_means};
use radiosity::renderer::ImageParams;
use radiosity::resources::check_image;
use radiosity::scene::Scene;
use radiosity::words::grouped;
use radiosity::{Context, Observer, Project, Stage, of_cells, reference_table, subdivide};
use radiosity_simd::InstructionSet;
use std::collections::BTreeMap;
use std::path::Path;
use std::slice;
use std::time::{Duration, Instant};

/// With fewer passes bright outliers, which are clamped, still hide most of the error.
const FEWEST_PASSES: u32 = 16;
/// What an interrupted run loses at most.
const SAVE_INTERVAL: Duration = Duration::from_secs(10);

pub(crate) fn run(args: &ReferenceCommand, folders: &Folders) -> Result<(), Error> {
    let Project {
        scene, mut params, ..
    } = folders.load(&args.scene, args.outside)?;
    args.image.apply(&mut params.image);
    params.check().map_err(radiosity::Error::from)?;
    let folder = args.output.as_ref().unwrap_or(&folders.output);
    make_folder(folder)?;
    let terminal = Terminal::brief(args.json);
    with_threads(args.threads, || {
        let json = if args.cells || args.divisions.is_some() {
            table(args, &scene, &params.discretization, folder, &terminal)?
        } else {
            picture(args, &scene, &params.image, folder, &terminal)?
        };
        for path in json.outputs.values() {
            terminal.line(&indented(path));
        }
        if args.json {
            say_json(&json)?;
        }
        terminal.finish()
    })
}

/// The mean radiosity of each patch, as a table.
fn table(
    args: &ReferenceCommand,
    scene: &Scene,
    params: &Discretization,
    folder: &Path,
    terminal: &Terminal,
) -> Result<Json, Error> {
    let cut = of_cells(params, args.divisions);
    let mesh = subdivide(scene, &cut, Context::default())?.mesh;
    let (start, patches) = (Instant::now(), mesh.patches.len());
    terminal.begin(Stage::Reference, patches as u64);
    terminal.update(
        format!("{} patches", grouped(patches as u64)),
        patches as u64,
    );
    let advance = |done| terminal.advance(done);
    let cells = cell_means(scene, &mesh, args.spp, args.seed, &advance);
    terminal.end();
    let path = folder.join(format!("{}-reference.csv", scene.name));
    write(&path, None, &reference_table(scene, &mesh, &cells).to_csv())?;
    let seconds = start.elapsed().as_secs_f64();
    terminal.line(&format!(
        "{:<14}{} patches, {} walks each{seconds:>14.2} s",
        "reference",
        grouped(patches as u64),
        grouped(u64::from(args.spp)),
    ));
    Ok(Json {
        scene: scene.name.clone(),
        walks: args.spp,
        seconds,
        instruction_set: InstructionSet::current().name(),
        picture: None,
        patches: Some(patches),
        outputs: BTreeMap::from([("table", path.display().to_string())]),
    })
}

fn picture(
    args: &ReferenceCommand,
    scene: &Scene,
    params: &ImageParams,
    folder: &Path,
    terminal: &Terminal,
) -> Result<Json, Error> {
    let camera = scene.first_camera();
    let camera = camera.ok_or_else(|| radiosity::Error::no_camera(scene))?;
    check_image(params.width, params.height)?;
    let tracer = Tracer::new(scene, &camera, params.film(), args.seed);
    let of_mesh = |error| radiosity::Error::of_mesh(scene, &Discretization::uniform(1), &error);
    let mut tracer = tracer.map_err(of_mesh)?;
    let start = Instant::now();
    let percent = trace(args, (scene, params), &mut tracer, folder, terminal)?;
    let (exposure, outputs) = save(scene, params, &tracer, folder)?;
    let seconds = start.elapsed().as_secs_f64();
    let rate = tracer.vertices() as f64 / seconds / rayon::current_num_threads() as f64;
    let walks = tracer.samples();
    let line = format!("{walks} walks per pixel (--exposure {exposure})");
    let line = labelled("reference", &format!("{line:<44}{seconds:>9.2} s"));
    terminal.line(&line);
    terminal.line(&indented(&format!(
        "estimated error {percent:.2} %; {:.2} million vertices a second on each thread",
        rate / 1e6,
    )));
    Ok(Json {
        scene: scene.name.clone(),
        walks: tracer.samples(),
        seconds,
        instruction_set: InstructionSet::current().name(),
        picture: Some(PictureReport {
            error_percent: percent,
            exposure,
            vertices: tracer.vertices(),
            vertices_per_second_and_thread: rate,
        }),
        patches: None,
        outputs,
    })
}

/// Adds passes until the picture is as good as was asked for, and saves it now and then; returns
/// its estimated error in percent.
fn trace(
    args: &ReferenceCommand,
    (scene, params): (&Scene, &ImageParams),
    tracer: &mut Tracer<'_>,
    folder: &Path,
    terminal: &Terminal,
) -> Result<f64, Error> {
    let start = Instant::now();
    let mut saved = start;
    let height = u64::from(params.height);
    terminal.begin(Stage::Reference, height);
    loop {
        tracer.pass(&|rows| terminal.advance(rows));
        let percent = 100.0 * tracer.relative_error(params.exposure.number().unwrap_or(0.0));
        let passes = tracer.samples() / tracer.samples_per_pass();
        let expected = expected_passes(args, tracer, start.elapsed().as_secs_f64(), percent);
        if passes >= expected {
            terminal.end();
            return Ok(percent);
        }
        let walks = tracer.samples();
        terminal.update(
            format!("{walks} walks per pixel, error {percent:.2} %"),
            u64::from(expected) * height,
        );
        if saved.elapsed() >= SAVE_INTERVAL {
            save(scene, params, tracer, folder)?;
            saved = Instant::now();
        }
    }
}

/// How many passes the picture will have taken when it is done; no more than it has, if it is.
fn expected_passes(args: &ReferenceCommand, tracer: &Tracer<'_>, seconds: f64, error: f64) -> u32 {
    let passes = tracer.samples() / tracer.samples_per_pass();
    let share = match (args.time, args.error) {
        (Some(limit), _) => seconds / limit,
        // Errors fall with the square root of the samples.
        (_, Some(wanted)) => (wanted / error).powi(2),
        _ => return args.spp.div_ceil(tracer.samples_per_pass()),
    };
    let least = if args.error.is_some() {
        FEWEST_PASSES
    } else {
        // A standard error needs two samples.
        2_u32.div_ceil(tracer.samples_per_pass())
    };
    let expected = if share >= 1.0 {
        passes
    } else {
        ((f64::from(passes) / share) as u32).max(passes + 1)
    };
    expected.max(least)
}

/// Writes radiance and standard error as float maps, and the picture for people; tells its
/// exposure.
fn save(
    scene: &Scene,
    params: &ImageParams,
    tracer: &Tracer<'_>,
    folder: &Path,
) -> Result<(f64, BTreeMap<&'static str, String>), Error> {
    let traced = tracer.picture();
    let image = |pixels: &[[f64; 3]]| Image {
        width: traced.width,
        height: traced.height,
        pixels: pixels
            .iter()
            .map(|p| p.map(|channel| channel as f32))
            .collect(),
    };
    let (radiance, error) = (image(&traced.radiance), image(&traced.standard_error));
    let measured = || Exposure::of(slice::from_ref(&radiance));
    let exposure = params.exposure.number().or_else(measured).unwrap_or(1.0);
    let levels = params.for_screens(exposure).tone_map().apply(&radiance);
    let facts = [("Exposure", exposure.to_string())];
    let png = encode(&levels, PictureFormat::Png(params.gamma), &facts);
    let files = [
        ("radiance", "reference.pfm", encode_pfm(&radiance)),
        ("standard_error", "reference-error.pfm", encode_pfm(&error)),
        ("png", "reference.png", png),
    ];
    let mut paths = BTreeMap::new();
    for (name, ending, bytes) in files {
        let path = folder.join(format!("{}-{ending}", scene.name));
        write(&path, None, &bytes)?;
        paths.insert(name, path.display().to_string());
    }
    Ok((exposure, paths))
}
