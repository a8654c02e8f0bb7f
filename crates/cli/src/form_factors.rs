//! `form-factors`.

use super::args::FormFactorsCommand;
use super::choices::ByArg;
use super::run::{check_folder_of, with_threads, write_by};
use super::site::Site;
use super::terminal::Terminal;
use crate::error::Error;
use crate::report::Report;
use radiosity::cache::Store;
use radiosity::resources::check_export;
use radiosity::words::bytes;
use radiosity::{Context, FactorTable, Observer, Project, estimate, matrix_bytes, subdivide};
use std::path::{Path, PathBuf};

/// Exports of so many bytes are announced.
const LARGE: u64 = 500_000_000;

pub(super) fn run(args: &FormFactorsCommand, site: &Site) -> Result<(), Error> {
    let export = args.export.as_deref();
    if let Some(path) = export {
        check_arguments(path, args)?;
    }
    let Project {
        scene, mut params, ..
    } = args.scene.load(site)?;
    args.estimate.factors.apply(&mut params.form_factors);
    params.check().map_err(radiosity::Error::from)?;
    let terminal = Terminal::new(args.estimate.output);
    with_threads(args.estimate.threads, || {
        let store = args.estimate.cache.store(site);
        let context = Context::new(store.as_ref(), &terminal);
        let patches = subdivide(&scene, &params.discretization, context)?;
        let factors = estimate(&patches, &params.form_factors)?;
        let mut report = Report::new(&patches, &terminal);
        let is_whole = args.rows.by == ByArg::Patch && args.sparse.is_none();
        if let Some(path) = export.filter(|_| is_whole) {
            announce(path, patches.mesh.patches.len(), &terminal)?;
        }
        let made = match args.recompute {
            true => factors.made_anew(),
            false => factors.made(),
        }?;
        report.form_factors(&made.origin, &made.rows, &factors);
        if let Some(path) = export {
            let by = args.rows.by.into();
            let table = FactorTable::new(&scene, &patches.mesh, &made.form_factors, by)?;
            let rows_path = export_table(&table, path, context.cache, args)?;
            report.output("export", path);
            report.output("export_rows", &rows_path);
        }
        report.finish()
    })
}

/// Refuses what cannot be written, before anything is computed for it.
fn check_arguments(path: &Path, args: &FormFactorsCommand) -> Result<(), Error> {
    if args.sparse.is_some() && is_npy(path) {
        return Err(Error::with_help(
            "--sparse is for .csv alone",
            "leave it out, or export to a path that ends in .csv",
        ));
    }
    check_folder_of(path)
}

/// Says how large a matrix between all patches will be, if it is large, and refuses one that does
/// not fit on the disk, before anything is computed for it.
fn announce(path: &Path, patches: usize, terminal: &Terminal) -> Result<(), Error> {
    let [of_npy, of_csv] = matrix_bytes(patches as u64);
    let (size, takes) = if is_npy(path) {
        let takes = format!("{} of disk; `--by surface` writes less", bytes(of_npy));
        (of_npy, takes)
    } else {
        let takes = format!(
            "up to {} of disk; `--by surface` and `--sparse 1e-6` write less, and a path that ends \
             in .npy takes {}",
            bytes(of_csv),
            bytes(of_npy),
        );
        (of_csv, takes)
    };
    if size >= LARGE {
        terminal.note(&format!("warning: the export will take {takes}"));
    }
    if is_npy(path) {
        check_export(path, size)?;
    }
    Ok(())
}

/// Writes the matrix, and beside it what its rows are; gives the path of that.
fn export_table(
    table: &FactorTable<'_>,
    path: &Path,
    cache: Option<&Store>,
    args: &FormFactorsCommand,
) -> Result<PathBuf, Error> {
    let mut dropped = None;
    write_by(path, cache, |file| match (args.sparse, args.rows.by) {
        _ if is_npy(path) => table.write_npy(file),
        (None, ByArg::Patch) => table.write_matrix(file),
        (least, _) => {
            let sums = table.write_entries(least.unwrap_or(0.0), file)?;
            dropped = least.map(|_| sums);
            Ok(())
        }
    })?;
    let rows_path = path.with_extension("rows.csv");
    write_by(&rows_path, cache, |file| {
        table.write_rows(dropped.as_deref(), file)
    })?;
    Ok(rows_path)
}

fn is_npy(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "npy")
}
