//! `reference`: the oracle's pictures and tables.

use super::args::ReferenceCommand;
use super::run::{make_folder, with_threads, write};
use super::site::Site;
use super::terminal::{Terminal, say};
use crate::error::Error;
use crate::export::reference_csv;
use crate::observer::{Observer, Stage};
use crate::resources::{check_image, grouped};
use radiosity_geometry::{Divisions, subdivide};
use radiosity_reference::{Tracer, cell_means};
use radiosity_renderer::{Image, PictureFormat, ToneMap, encode, encode_pfm};
use radiosity_scene::Scene;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Passes between looks at the error, which takes time itself.
const PASSES_PER_LOOK: u32 = 4;

pub(crate) fn run(args: &ReferenceCommand, site: &Site) -> Result<(), Error> {
    let mut scene = site.load(&args.scene)?;
    if let Some((width, height)) = args.size {
        (scene.image.width, scene.image.height) = (width, height);
    }
    let folder = args.output.as_ref().unwrap_or(&site.output);
    make_folder(folder)?;
    with_threads(args.threads, || match args.patches {
        Some((a, b)) => cells(args, &scene, Divisions::Count { a, b }, folder),
        None => picture(args, &scene, folder),
    })
}

/// The mean radiosity of each cell, whatever divisions the surfaces have of their own.
fn cells(
    args: &ReferenceCommand,
    scene: &Scene,
    divisions: Divisions,
    folder: &Path,
) -> Result<(), Error> {
    let mesh =
        subdivide(&scene.undivided(), divisions).map_err(|error| Error::of_mesh(scene, &error))?;
    let terminal = Terminal::new(false);
    let start = Instant::now();
    terminal.begin(Stage::Reference, mesh.patches.len() as u64);
    let advance = |done| terminal.advance(done);
    let cells = cell_means(scene, &mesh, args.spp, args.seed, &advance);
    terminal.end();
    let path = folder.join(format!("{}-reference.csv", scene.name));
    write(&path, &reference_csv(scene, &mesh, &cells))?;
    say(&format!(
        "{:<14}{} patches, {} walks each{:>14.2} s",
        "reference",
        grouped(cells.len() as u64),
        grouped(u64::from(args.spp)),
        start.elapsed().as_secs_f64(),
    ))?;
    say(&format!("{:<14}{}", "", path.display()))
}

fn picture(args: &ReferenceCommand, scene: &Scene, folder: &Path) -> Result<(), Error> {
    let camera = scene.camera.as_ref().ok_or(Error::NoCamera)?;
    let (width, height) = (scene.image.width, scene.image.height);
    check_image(width, height)?;
    let of_mesh = |error| Error::of_mesh(scene, &error);
    let mut tracer = Tracer::new(scene, camera, args.seed).map_err(of_mesh)?;
    let terminal = Terminal::new(false);
    let start = Instant::now();
    let passes = args.spp.div_ceil(tracer.samples_per_pass());
    let error = |tracer: &Tracer<'_>| 100.0 * tracer.relative_error(scene.image.exposure);
    let enough = |tracer: &Tracer<'_>, done: u32| match (args.time, args.error) {
        (Some(seconds), _) => start.elapsed().as_secs_f64() >= seconds,
        (_, Some(percent)) => done.is_multiple_of(PASSES_PER_LOOK) && error(tracer) <= percent,
        _ => done == passes,
    };
    for done in 1.. {
        terminal.begin(Stage::Reference, u64::from(height));
        tracer.pass(&|rows| terminal.advance(rows));
        terminal.end();
        if enough(&tracer, done) {
            break;
        }
    }
    let outputs = save(scene, &tracer, folder)?;
    say(&format!(
        "{:<14}{} walks per pixel, estimated error {:.2} %{:>14.2} s",
        "reference",
        tracer.samples(),
        error(&tracer),
        start.elapsed().as_secs_f64(),
    ))?;
    outputs
        .iter()
        .try_for_each(|path| say(&format!("{:<14}{}", "", path.display())))
}

/// Writes radiance and standard error as float maps, and the picture for people.
fn save(scene: &Scene, tracer: &Tracer<'_>, folder: &Path) -> Result<Vec<PathBuf>, Error> {
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
    let (exposure, gamma) = (scene.image.exposure, scene.image.gamma);
    let shown = ToneMap { exposure, gamma }.apply(&radiance);
    let files = [
        ("reference.pfm", encode_pfm(&radiance)),
        ("reference-error.pfm", encode_pfm(&error)),
        (
            "reference.png",
            encode(&shown, PictureFormat::Png { gamma }),
        ),
    ];
    let mut paths = Vec::new();
    for (ending, bytes) in files {
        let path = folder.join(format!("{}-{ending}", scene.name));
        write(&path, &bytes)?;
        paths.push(path);
    }
    Ok(paths)
}
