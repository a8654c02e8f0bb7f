//! `render` and `display`.

use super::args::DisplayCommand;
use super::live::Live;
use super::run::{light, make_folder, store, with_threads};
use super::save::Folder;
use super::series::{Series, Sheet, check_names};
use super::site::Site;
use super::terminal::Terminal;
use crate::error::Error;
use crate::report::{DisplayReport, Report};
use radiosity::Pipeline;
use radiosity::scene::Scene;
use radiosity::{How, Sources};
use std::time::Instant;

pub(super) fn run(args: &DisplayCommand, site: &Site) -> Result<(), Error> {
    let mut scene = site.load(&args.scene.scene, args.scene.outside)?;
    args.scene.apply(&mut scene);
    args.estimate.apply(&mut scene);
    args.solve.apply(&mut scene);
    args.lights.apply(&mut scene)?;
    args.display.apply(&mut scene);
    with_threads(args.estimate.threads, || display(args, &scene, site))
}

fn display(args: &DisplayCommand, scene: &Scene, site: &Site) -> Result<(), Error> {
    let folder = args.display.output.as_ref().unwrap_or(&site.output);
    let terminal = Terminal::new(args.estimate.json);
    let store = store(&args.estimate, site);
    let mut pipeline = Pipeline::new(scene, store.as_ref(), &terminal)?;
    let shots = args.display.views.shots(scene, pipeline.mesh())?;
    let looks = args.display.show.looks(scene, pipeline.mesh())?;
    check_names(&args.display, &looks, &shots)?;
    make_folder(folder)?;
    let needs_factors = looks.iter().any(|look| look.quantity.needs_factors());
    if needs_factors {
        pipeline.keep_form_factors();
    }
    let mut report = Report::new(scene, pipeline.mesh(), &terminal);
    let (light, how) = light(&pipeline, Sources::Cached, &mut report)?;
    if needs_factors && how == How::NotNeeded {
        let made = pipeline.form_factors(Sources::Cached)?;
        report.form_factors(&made.origin, &made.rows, &pipeline);
    }
    let start = Instant::now();
    let mut series = Series {
        args: &args.display,
        pipeline: &pipeline,
        looks: &looks,
        shots: &shots,
        live: Live::new(!args.estimate.json && !args.display.no_live),
        folder: Folder::new(folder, &args.display.format, &pipeline),
        sheet: Sheet::default(),
    };
    series.take(&light)?;
    report.display(DisplayReport {
        seconds: start.elapsed().as_secs_f64(),
    });
    report.outputs(series.folder.written);
    report.finish()
}
