//! `render` and `display`.

use super::args::DisplayCommand;
use super::folders::Folders;
use super::run::{make_folder, solved, with_threads};
use super::save::Folder;
use super::series::{Series, Sheet, check_names};
use super::terminal::Terminal;
use super::thumbnail::Thumbnail;
use crate::error::Error;
use crate::report::{DisplayReport, Report};
use radiosity::geometry::Camera;
use radiosity::params::NumberOrWord;
use radiosity::scene::Scene;
use radiosity::{Context, Params, Project, estimate, expose, subdivide};
use std::time::Instant;

pub(super) fn run(args: &DisplayCommand, folders: &Folders) -> Result<(), Error> {
    let Project {
        scene, mut params, ..
    } = args.scene.load(folders)?;
    args.estimate.factors.apply(&mut params.form_factors);
    args.solve.apply(&mut params.solver);
    args.display.apply(&mut params.image);
    params.check().map_err(radiosity::Error::from)?;
    with_threads(args.estimate.threads, || {
        display(args, &scene, &params, folders)
    })
}

fn display(
    args: &DisplayCommand,
    scene: &Scene,
    params: &Params,
    folders: &Folders,
) -> Result<(), Error> {
    let dimming = args.lights.dimming(scene)?;
    let folder = args.display.output.as_ref().unwrap_or(&folders.output);
    let terminal = Terminal::new(args.estimate.output);
    let store = args.estimate.cache.store(folders);
    let context = Context::new(store.as_ref(), &terminal);
    let patches = subdivide(scene, &params.discretization, context)?;
    let factors = estimate(&patches, &params.form_factors)?;
    let shots = args.display.views.shots(scene, &patches.mesh)?;
    let looks = args.display.show.looks(scene, params, &patches.mesh)?;
    check_names(&args.display, &looks, &shots)?;
    make_folder(folder)?;
    let mut report = Report::new(&patches, &terminal);
    let needs_factors = looks.iter().any(|look| look.quantity.needs_factors());
    let (solved, _held) = solved(
        &factors,
        &params.solver,
        (false, needs_factors),
        &mut report,
    )?;
    let light = solved.relight(&dimming)?;
    report.solution(&solved, &patches, &dimming, &light.energy);
    let start = Instant::now();
    let shadings = args.display.shadings();
    let cameras: Vec<Camera> = shots.iter().map(|shot| shot.camera).collect();
    let image = expose(&patches, &light, &cameras, &params.image, &shadings);
    let mut series = Series {
        args: &args.display,
        params: &image,
        factors: &factors,
        looks: &looks,
        shots: &shots,
        live: Thumbnail::new(!args.estimate.output.json && !args.display.no_live),
        folder: Folder::new(folder, &args.display.format, &solved, params, &dimming),
        sheet: Sheet::default(),
    };
    series.take(&light)?;
    let has_exposure = looks.iter().any(|look| !look.is_number());
    report.display(DisplayReport {
        seconds: start.elapsed().as_secs_f64(),
        exposure: image.exposure.number().filter(|_| has_exposure),
    });
    report.outputs(series.folder.written);
    report.finish()
}
