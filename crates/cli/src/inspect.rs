//! `inspect`.

use super::args::InspectCommand;
use super::folders::Folders;
use super::input::check_regular;
use super::terminal::{say, say_json};
use crate::error::Error;
use crate::lines::{
    class_line, closure_line, error_line, indented, labelled, missed_line, row_line,
};
use radiosity::cache::{Miss, last_user, open};
use radiosity::inspect::{
    CLOSURE_BOUNDS, FactorInspection, Inspection, SolutionInspection, WorstRow,
};
use radiosity::words::{PATCHES, SURFACES, bytes, counted, grouped};
use std::path::Path;

/// The longest bar of the histogram, in characters.
const LONGEST_BAR: f64 = 40.0;

pub(super) fn run(args: &InspectCommand, folders: &Folders) -> Result<(), Error> {
    // A name alone, as `cache list` gives it, is that of a file in the cache.
    let cached = folders.cache.join(&args.file);
    let path = match args.file.exists() || !cached.is_file() {
        true => &args.file,
        false => &cached,
    };
    let unusable = |miss: Miss| unusable(path, &miss);
    check_regular(path)?;
    let opened = open(path).map_err(unusable)?;
    let names = surface_names(path, args, folders)?;
    let inspection = Inspection::of(opened, names.as_deref()).map_err(unusable)?;
    if args.json {
        return say_json(&inspection);
    }
    let size = std::fs::metadata(path).map_or(0, |metadata| metadata.len());
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    say(&labelled(
        "file",
        &format!("{name}, {}: no byte is damaged", bytes(size)),
    ))?;
    lines(&inspection).iter().try_for_each(|line| say(line))
}

/// All that is said of what a file holds.
fn lines(inspection: &Inspection) -> Vec<String> {
    let mut lines = vec![labelled("key", &inspection.key)];
    lines.extend(inspection.form_factors.iter().flat_map(factor_lines));
    if let Some(solution) = &inspection.solution {
        lines.push(solution_line(solution));
        lines.push(labelled("lights", &solution.lights.join(", ")));
    }
    lines
}

fn unusable(path: &Path, miss: &Miss) -> Error {
    let help = match miss {
        Miss::Io(_) => "give the path of a file in the cache; `cache list` names them",
        Miss::NotACacheFile => {
            "give a .bin file of the cache; unfinished ones are named .partial, and the command \
             that began one goes on with it"
        }
        _ => "the command that needs it makes it anew",
    };
    let named = path.display().to_string();
    Error::with_help(
        miss.to_string().replacen("the cached file", &named, 1),
        help,
    )
}

/// The names of the scene's surfaces, if it is there and can be read: the one that was named, or
/// the one that used the file last.
fn surface_names(
    path: &Path,
    args: &InspectCommand,
    folders: &Folders,
) -> Result<Option<Vec<String>>, Error> {
    let scene = match &args.scene {
        Some(scene) => Some(folders.load(scene, args.outside)?),
        None => last_user(path).and_then(|name| folders.load(name.as_ref(), args.outside).ok()),
    };
    let names = |project: radiosity::Project| {
        let surfaces = project.scene.surfaces.into_iter();
        surfaces.map(|surface| surface.name).collect()
    };
    Ok(scene.map(names))
}

fn factor_lines(found: &FactorInspection) -> Vec<String> {
    let made = format!(
        "{}; {} of {}",
        found.estimator.text(),
        counted(found.patches, PATCHES),
        counted(found.surfaces, SURFACES),
    );
    let mut lines = vec![
        labelled("form factors", &made),
        labelled("rows", &row_line(&found.rows)),
    ];
    let more = error_line(&found.rows)
        .into_iter()
        .chain(missed_line(&found.rows))
        .chain(closure_line(&found.rows));
    lines.extend(more.map(|line| indented(&line)));
    let classes = found.rows.classes.as_ref();
    lines.extend(classes.map(|c| indented(&class_line(c, found.patches))));
    lines.push(labelled(
        "closure",
        "rows by |fronts + backs + background - 1|",
    ));
    lines.extend(histogram(&found.off_by).iter().map(|line| indented(line)));
    lines.extend(
        found
            .worst
            .iter()
            .enumerate()
            .map(|(k, row)| labelled(if k == 0 { "worst rows" } else { "" }, &worst_line(row))),
    );
    lines
}

/// A bar for each class of rows.
fn histogram(closure: &[u64]) -> Vec<String> {
    let most = closure.iter().copied().max().unwrap_or(0).max(1) as f64;
    let line = |(k, &count): (usize, &u64)| {
        let class = match CLOSURE_BOUNDS.get(k) {
            Some(bound) => format!("below {bound:.0e}"),
            None => format!("above {:.0e}", CLOSURE_BOUNDS[k - 1]),
        };
        let length = (LONGEST_BAR * count as f64 / most).ceil() as usize;
        let line = format!("{class:<12}{:>9}  {}", grouped(count), "#".repeat(length));
        line.trim_end().to_owned()
    };
    closure.iter().enumerate().map(line).collect()
}

fn worst_line(row: &WorstRow) -> String {
    let facts = &row.facts;
    let error = facts
        .error
        .map_or(String::new(), |error| format!(" +- {error:.1e}"));
    format!(
        "{:+.1e} in row {}, `{}`: fronts {:.6}{error}, backs {:.4}, background {:.4}, both +- \
         {:.0e}",
        row.excess,
        row.row,
        row.surface,
        facts.fronts,
        facts.backs,
        facts.background,
        facts.rays_error,
    )
}

fn solution_line(found: &SolutionInspection) -> String {
    let end = if found.converged {
        ""
    } else {
        ", not converged"
    };
    let text = format!(
        "{}, {}: residual {:.1e}{end}",
        counted(found.patches, PATCHES),
        counted(found.sweeps, ["sweep", "sweeps"]),
        found.residual,
    );
    labelled("solution", &text)
}

#[cfg(test)]
mod tests;
