//! What each command does.

use super::args::{
    CheckArgs, Command, DisplayArgs, DisplayCommand, EstimateArgs, FormFactorsCommand, FormatArg,
    SolveCommand,
};
use super::cache_folder;
use super::site::Site;
use super::terminal::Terminal;
use crate::artifact::Sources;
use crate::error::Error;
use crate::export::radiosity_csv;
use crate::pipeline::Pipeline;
use crate::report::{DisplayReport, Report, check_lines};
use radiosity_cache::{Store, replace_file};
use radiosity_renderer::{Image, PictureFormat, Pictures, ToneMap, encode};
use radiosity_scene::{ImageSettings, Scene};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Runs a command and prints what it has to say; the exit code is 0, or that of the error.
pub fn run(command: &Command, site: &Site) -> ExitCode {
    let result = match command {
        Command::Render(args) => display(args, site, Sources::Cached),
        Command::Display(args) => display(args, site, Sources::Cached),
        Command::FormFactors(args) => form_factors(args, site),
        Command::Solve(args) => solve(args, site),
        Command::Check(args) => check(args, site),
        Command::Cache(args) => cache_folder::run(args, site),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(error.exit_code())
        }
    }
}

fn form_factors(args: &FormFactorsCommand, site: &Site) -> Result<(), Error> {
    let mut scene = site.load(&args.scene.scene)?;
    args.scene.apply(&mut scene);
    let sources = if args.recompute {
        Sources::Computed
    } else {
        Sources::Cached
    };
    with_pipeline(&mut scene, &args.estimate, site, |pipeline, report, _| {
        let made = pipeline.form_factors(sources)?;
        report.form_factors(&made.origin, &made.rows, pipeline);
        Ok(())
    })
}

fn solve(args: &SolveCommand, site: &Site) -> Result<(), Error> {
    let mut scene = site.load(&args.scene.scene)?;
    args.scene.apply(&mut scene);
    args.solve.apply(&mut scene);
    with_pipeline(
        &mut scene,
        &args.estimate,
        site,
        |pipeline, report, scene| {
            let solved = pipeline.solution(Sources::Computed)?;
            report.form_factors(&solved.form_factors, &solved.rows, pipeline);
            report.solution(&solved.origin, &solved.solution);
            if let Some(path) = &args.export {
                let csv = radiosity_csv(scene, pipeline.mesh(), &solved.solution);
                write(path, &csv)?;
                report.output("export", path);
            }
            Ok(())
        },
    )
}

fn display(args: &DisplayCommand, site: &Site, sources: Sources) -> Result<(), Error> {
    let mut scene = site.load(&args.scene.scene)?;
    args.scene.apply(&mut scene);
    args.solve.apply(&mut scene);
    args.display.apply(&mut scene);
    if scene.camera.is_none() {
        return Err(Error::NoCamera);
    }
    with_pipeline(
        &mut scene,
        &args.estimate,
        site,
        |pipeline, report, scene| {
            let solved = pipeline.solution(sources)?;
            report.form_factors(&solved.form_factors, &solved.rows, pipeline);
            report.solution(&solved.origin, &solved.solution);
            let start = Instant::now();
            let pictures = pipeline.pictures(&solved.solution)?;
            let folder = args.display.output.as_ref().unwrap_or(&site.output);
            let outputs = save(&pictures, scene, &args.display, folder)?;
            report.display(DisplayReport {
                seconds: start.elapsed().as_secs_f64(),
            });
            for (name, path) in outputs {
                report.output(&name, &path);
            }
            Ok(())
        },
    )
}

fn check(args: &CheckArgs, site: &Site) -> Result<(), Error> {
    let mut scene = site.load(&args.scene.scene)?;
    args.scene.apply(&mut scene);
    check_lines(&scene)?
        .iter()
        .for_each(|line| println!("{line}"));
    Ok(())
}

/// Sets up what all stages need, runs some of them, and prints the report.
fn with_pipeline(
    scene: &mut Scene,
    args: &EstimateArgs,
    site: &Site,
    stages: impl FnOnce(&Pipeline<'_>, &mut Report<'_>, &Scene) -> Result<(), Error> + Send,
) -> Result<(), Error> {
    args.apply(scene);
    let store = (!args.cache.no_cache)
        .then(|| Store::new(args.cache.folder.as_ref().unwrap_or(&site.cache)));
    let terminal = Terminal::new(args.json);
    let mut threads = rayon::ThreadPoolBuilder::new();
    if let Some(count) = args.threads {
        threads = threads.num_threads(count as usize);
    }
    let pool = threads.build().expect("the system can start threads");
    pool.install(|| {
        let pipeline = Pipeline::new(scene, store.as_ref(), &terminal)?;
        let mut report = Report::new(scene, pipeline.mesh(), &terminal);
        stages(&pipeline, &mut report, scene)?;
        if args.json {
            println!("{}", report.json());
        }
        Ok(())
    })
}

/// Writes both pictures in all formats; returns the name and path of each file. The first
/// format's files are called `constant` and `smooth`, others have the format appended.
fn save(
    pictures: &Pictures,
    scene: &Scene,
    args: &DisplayArgs,
    folder: &Path,
) -> Result<BTreeMap<String, PathBuf>, Error> {
    std::fs::create_dir_all(folder).map_err(|error| Error::Output {
        path: folder.to_owned(),
        error,
    })?;
    let mut outputs = BTreeMap::new();
    for (kind, image) in [
        ("constant", &pictures.constant),
        ("smooth", &pictures.smooth),
    ] {
        for (index, format) in args.format.iter().enumerate() {
            let (label, ending) = match format {
                FormatArg::Ppm => ("ppm", "ppm"),
                FormatArg::PlainPpm => ("plain_ppm", "plain.ppm"),
                FormatArg::Png => ("png", "png"),
            };
            let path = folder.join(format!("{}-{kind}.{ending}", scene.name));
            write(&path, &encoded(image, &scene.image, *format))?;
            let name = if index == 0 {
                kind.to_owned()
            } else {
                format!("{kind}_{label}")
            };
            outputs.insert(name, path);
        }
    }
    Ok(outputs)
}

fn encoded(image: &Image, settings: &ImageSettings, format: FormatArg) -> Vec<u8> {
    let ImageSettings {
        exposure, gamma, ..
    } = *settings;
    let picture = ToneMap { exposure, gamma }.apply(image);
    let format = match format {
        FormatArg::Ppm => PictureFormat::Ppm,
        FormatArg::PlainPpm => PictureFormat::PlainPpm,
        FormatArg::Png => PictureFormat::Png { gamma },
    };
    encode(&picture, format)
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    replace_file(path, &[bytes]).map_err(|error| Error::Output {
        path: path.to_owned(),
        error,
    })
}
