//! What each command does.

use super::args::{Command, SolveCommand};
use super::cache_folder;
use super::check;
use super::compare;
use super::display;
use super::estimate_args::ThreadArgs;
use super::folders::Folders;
use super::form_factors;
use super::inspect;
use super::reference;
use super::signals::remove_unfinished_on_signals;
use super::terminal::{Terminal, tell};
use crate::error::Error;
use crate::plot::convergence_plot;
use crate::report::Report;
use radiosity::cache::{Changed, Store, replace_file_by};
use radiosity::solver::Params;
use radiosity::stages::{Factors, FormFactorsMade, Solved, mean_irradiance};
use radiosity::{Context, LightExport, Project, estimate, subdivide};
use radiosity_simd::InstructionSet;
use std::io;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

/// Runs a command and prints what it has to say; the exit code is 0, or that of the error.
pub fn run(command: &Command, folders: &Folders) -> ExitCode {
    // A comparison does it when it has something to write: see there.
    if !matches!(command, Command::Compare(_)) {
        remove_unfinished_on_signals();
    }
    if let Some(wish) = InstructionSet::unknown_wish() {
        let best = InstructionSet::current().name();
        tell(&format!(
            "warning: RADIOSITY_SIMD is `{wish}`, which this machine does not have: {best} is used"
        ));
    }
    let result = match command {
        Command::Render(args) | Command::Display(args) => display::run(args, folders),
        Command::FormFactors(args) => form_factors::run(args, folders),
        Command::Solve(args) => solve(args, folders, true),
        Command::Relight(args) => solve(args, folders, false),
        Command::Reference(args) => reference::run(args, folders),
        Command::Compare(args) => compare::run(args, folders),
        Command::Check(args) => check::run(args, folders),
        Command::Cache(args) => cache_folder::run(args, folders),
        Command::Inspect(args) => inspect::run(args, folders),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            tell(&error.report());
            ExitCode::from(error.exit_code())
        }
    }
}

/// `is_anew` says whether a cached solution will not do.
fn solve(args: &SolveCommand, folders: &Folders, is_anew: bool) -> Result<(), Error> {
    let Project {
        scene, mut params, ..
    } = args.scene.load(folders)?;
    args.estimate.factors.apply(&mut params.form_factors);
    args.solve.apply(&mut params.solver);
    params.check().map_err(radiosity::Error::from)?;
    let dimming = args.lights.dimming(&scene)?;
    for path in args.export.iter().chain(&args.plot) {
        check_folder_of(path)?;
    }
    let terminal = Terminal::new(args.estimate.output);
    with_threads(args.estimate.threads, || {
        let store = args.estimate.cache.store(folders);
        let context = Context::new(store.as_ref(), &terminal);
        let patches = subdivide(&scene, &params.discretization, context)?;
        let factors = estimate(&patches, &params.form_factors)?;
        let mut report = Report::new(&patches, &terminal);
        let needs_factors = args.plot.is_some() || args.export.is_some();
        let how = (is_anew, needs_factors);
        let (solved, _held) = solved(&factors, &params.solver, how, &mut report)?;
        let light = solved.relight(&dimming)?;
        report.solution(&solved, &patches, &dimming, &light.energy);
        if let Some(path) = &args.export {
            let irradiance = mean_irradiance(&factors, &light)?;
            let mesh = &patches.mesh;
            let table = LightExport::new(&scene, mesh, &light, &irradiance, args.rows.by.into());
            write(path, context.cache, &table.to_csv())?;
            report.output("export", path);
        }
        if let Some(path) = &args.plot {
            let plot = convergence_plot(&scene.name, &factors, &params.solver)?;
            write(path, context.cache, plot.as_bytes())?;
            report.output("plot", path);
        }
        report.finish()
    })
}

/// The solution, made anew or not, and the form factors, if they are needed afterwards. They are
/// reported as soon as they are there, and before anything is solved.
pub(super) fn solved<'a>(
    factors: &'a Factors<'a>,
    params: &Params,
    (is_anew, needs_factors): (bool, bool),
    report: &mut Report<'_>,
) -> Result<(Solved<'a>, Option<Arc<FormFactorsMade>>), Error> {
    let is_cached = !is_anew && factors.have_solution(params);
    let made = match is_cached && !needs_factors {
        true => None,
        false => Some(factors.made()?),
    };
    if let Some(made) = &made {
        report.form_factors(&made.origin, &made.rows, factors);
    }
    let solved = match is_anew {
        true => radiosity::solve_anew(factors, params),
        false => radiosity::solve(factors, params),
    }?;
    if made.is_none() {
        report.form_factors(&solved.form_factors, &solved.rows, factors);
    }
    Ok((solved, made.filter(|_| needs_factors)))
}

/// Runs with so many threads, or as many as there are processors.
pub(super) fn with_threads(
    args: ThreadArgs,
    run: impl FnOnce() -> Result<(), Error> + Send,
) -> Result<(), Error> {
    let count = args.threads.map_or(0, |count| count as usize);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
    pool?.install(run)
}

/// Refuses a result in a folder that does not exist, before anything is computed for it.
pub(super) fn check_folder_of(path: &Path) -> Result<(), Error> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let error = match std::fs::metadata(folder) {
        Ok(_) if path.is_dir() => std::io::ErrorKind::IsADirectory.into(),
        Ok(metadata) if metadata.is_dir() => return Ok(()),
        Ok(_) => std::io::ErrorKind::NotADirectory.into(),
        Err(error) => error,
    };
    Err(Error::Output {
        path: path.to_owned(),
        error,
    })
}

/// Makes the folder of a result before anything is computed for it.
pub(super) fn make_folder(folder: &Path) -> Result<(), Error> {
    if folder.is_file() {
        let why = "it is a file, and pictures go into a folder; name one with -o";
        return Err(Error::Output {
            path: folder.to_owned(),
            error: io::Error::new(io::ErrorKind::NotADirectory, why),
        });
    }
    std::fs::create_dir_all(folder).map_err(|error| Error::Output {
        path: folder.to_owned(),
        error,
    })
}

/// Writes a result. `cache` is that of what it was made of, if it has one.
pub(super) fn write(path: &Path, cache: Option<&Store>, bytes: &[u8]) -> Result<(), Error> {
    write_by(path, cache, |file| file.write_all(bytes))
}

/// The same for what is written bit by bit.
pub(super) fn write_by(
    path: &Path,
    cache: Option<&Store>,
    write: impl FnOnce(&mut dyn io::Write) -> io::Result<()>,
) -> Result<(), Error> {
    let written = replace_file_by(path, |file| {
        write(file)?;
        cache.map_or(Ok(()), Store::check).map_err(io::Error::other)
    });
    written.map_err(|error| match error.downcast::<Changed>() {
        Ok(changed) => changed.into(),
        Err(error) => Error::Output {
            path: path.to_owned(),
            error,
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use radiosity::cache::{Id, Key};
    use std::fs::OpenOptions;

    #[test]
    fn nothing_is_written_of_a_file_that_was_changed_meanwhile() {
        let folder = tempfile::TempDir::new().unwrap();
        let store = Store::new(folder.path().join("cache"));
        let id = Id {
            scene: "box",
            stage: "form-factors",
            key: Key::of("form-factors", 1, &()),
        };
        // Too large to be read at once.
        store.write(&id, &(), &vec![0.0; 17 << 20]).unwrap();
        let in_use = store.read::<()>(&id).unwrap().into_values().unwrap();
        let path = folder.path().join("result.csv");
        write(&path, Some(&store), b"good").unwrap();
        let file = OpenOptions::new().append(true).open(store.path(&id));
        io::Write::write_all(&mut file.unwrap(), b"more").unwrap();
        let refused = write(&path, Some(&store), b"bad").unwrap_err();
        drop(in_use);
        assert_eq!(refused.exit_code(), 3);
        assert!(
            refused
                .to_string()
                .contains("was changed while it was in use")
        );
        assert_eq!(std::fs::read(&path).unwrap(), b"good");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}
