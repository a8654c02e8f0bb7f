//! `form-factors`.

use super::args::FormFactorsCommand;
use super::choices::ByArg;
use super::folders::Folders;
use super::run::{check_folder_of, with_threads, write_by};
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

pub(super) fn run(args: &FormFactorsCommand, folders: &Folders) -> Result<(), Error> {
    let export = args.export.as_deref();
    if let Some(path) = export {
        check_arguments(path, args)?;
    }
    let Project {
        scene, mut params, ..
    } = args.scene.load(folders)?;
    args.estimate.factors.apply(&mut params.form_factors);
    params.check().map_err(radiosity::Error::from)?;
    let terminal = Terminal::new(args.estimate.output);
    with_threads(args.estimate.threads, || {
        let store = args.estimate.cache.store(folders);
        let context = Context::new(store.as_ref(), &terminal);
        let patches = subdivide(&scene, &params.discretization, context)?;
        let factors = estimate(&patches, &params.form_factors)?;
        let mut report = Report::new(&patches, &terminal);
        let is_whole = args.rows.by == ByArg::Patch && args.sparse.is_none();
        if let Some(path) = export.filter(|_| is_whole) {
            let bytes = matrix_bytes(patches.mesh.patches.len() as u64);
            large_export(path, bytes).inspect(|warning| terminal.note(warning));
            check_room(path, bytes)?;
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
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    if name.to_lowercase().ends_with(".rows") {
        return Err(Error::with_help(
            "a table that ends in .rows.csv is written beside the matrix, and would not be one",
            "give the matrix another name",
        ));
    }
    check_folder_of(path)
}

/// Says how large a matrix between all patches will be, if it is large. `bytes` are those of .npy
/// and .csv.
fn large_export(path: &Path, [of_npy, of_csv]: [u64; 2]) -> Option<String> {
    let takes = |size| format!("warning: the export will take {} of disk", bytes(size));
    match is_npy(path) {
        true => (of_npy >= LARGE).then(|| format!("{}; `--by surface` writes less", takes(of_npy))),
        false => (of_csv >= LARGE).then(|| {
            format!(
                "{} at most; `--by surface` and `--sparse 1e-6` write less, and a path that ends \
                 in .npy takes {}",
                takes(of_csv),
                bytes(of_npy),
            )
        }),
    }
}

/// Refuses a matrix that does not fit on the disk, before anything is computed for it. How large
/// one of text will be is not known.
fn check_room(path: &Path, [of_npy, _]: [u64; 2]) -> Result<(), Error> {
    if is_npy(path) {
        check_export(path, of_npy)?;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_exports_are_announced() {
        let said = |path: &str, patches| large_export(path.as_ref(), matrix_bytes(patches));
        assert_eq!(said("f.npy", 11_000), None);
        let of_npy = "warning: the export will take 576 MB of disk; `--by surface` writes less";
        assert_eq!(said("f.npy", 12_000).unwrap(), of_npy);
        assert_eq!(said("f.csv", 5_000), None);
        let of_csv = "warning: the export will take 2.0 GB of disk at most; `--by surface` and \
            `--sparse 1e-6` write less, and a path that ends in .npy takes 576 MB";
        assert_eq!(said("f.csv", 12_000).unwrap(), of_csv);
    }
}
