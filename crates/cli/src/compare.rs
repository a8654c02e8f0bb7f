//! `compare`: how far one result is from another.

mod pictures;

use super::compare_args::CompareCommand;
use super::folders::Folders;
use super::input::read;
use super::printable;
use super::run::check_folder_of;
use super::terminal::{say, say_json};
use crate::error::Error;
use pictures::pictures;
use radiosity::compare::{Cell, Errors, compare_tables, parse_table};
use radiosity::{Context, Project, cells, of_cells, subdivide};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The object that `--json` prints. Fields may be added, but not changed or removed.
#[derive(Debug, Serialize)]
struct Json {
    /// The compared files.
    found: String,
    reference: String,
    /// Regions of pictures, surfaces of tables, and `all`.
    regions: BTreeMap<String, Errors>,
    /// The written picture of differences.
    #[serde(skip_serializing_if = "Option::is_none")]
    difference: Option<String>,
}

/// What came out.
struct Compared {
    /// By region or surface.
    named: Vec<(String, Errors)>,
    /// What does not count, in words; empty if everything does.
    left_out: String,
}

pub(crate) fn run(args: &CompareCommand, folders: &Folders) -> Result<(), Error> {
    let project = args
        .scene
        .as_ref()
        .map(|name| folders.load(name.as_ref(), args.outside));
    let project = project.transpose()?;
    if let Some(path) = &args.difference {
        check_folder_of(path)?;
    }
    let is_table = |path: &Path| {
        let ending = path.extension();
        ending.is_some_and(|ending| ending.eq_ignore_ascii_case("csv"))
    };
    let compared = match [&args.found, &args.reference].map(|path| is_table(path)) {
        [false, false] => pictures(args, project.as_ref())?,
        [true, true] => tables(args, project.as_ref())?,
        _ => {
            let problem = "a picture cannot be compared with a table (.csv)";
            return Err(Error::input(problem));
        }
    };
    if args.json {
        let text = |path: &PathBuf| path.display().to_string();
        let json = Json {
            found: text(&args.found),
            reference: text(&args.reference),
            regions: compared.named.into_iter().collect(),
            difference: args.difference.as_ref().map(text),
        };
        return say_json(&json);
    }
    print(&compared)?;
    match &args.difference {
        Some(path) => say(&path.display().to_string()),
        None => Ok(()),
    }
}

fn tables(args: &CompareCommand, project: Option<&Project>) -> Result<Compared, Error> {
    let needs_scene =
        || Error::input("tables do not tell the areas of patches: name their --scene");
    let only_pictures = [
        args.regions.is_some(),
        args.difference.is_some(),
        args.exposure.is_some(),
        args.gamma.is_some(),
    ];
    if only_pictures.contains(&true) {
        let problem =
            "--regions, --difference, --exposure and --gamma are for pictures, not for tables";
        return Err(Error::input(problem));
    }
    let Project { scene, params, .. } = project.ok_or_else(needs_scene)?;
    let cut = of_cells(&params.discretization, args.divisions);
    let cells = cells(scene, &subdivide(scene, &cut, Context::default())?.mesh);
    let table = |path: &Path| parse_table(&read(path)?).map_err(at(path));
    let (found, reference) = (table(&args.found)?, table(&args.reference)?);
    let found = match args.coarsen {
        Some(factor) => found.coarsened(factor).map_err(at(&args.found))?,
        None => found,
    };
    let named = compare_tables(&cells, &found, &reference);
    let named = named.map_err(|error| Error::input(error.to_string()))?;
    let left_out = surfaces_left_out(&cells, &named);
    Ok(Compared { named, left_out })
}

/// The surfaces of which no patch counts.
fn surfaces_left_out(cells: &[Cell], named: &[(String, Errors)]) -> String {
    let counts = |cell: &Cell| named.iter().any(|(name, _)| *name == cell.surface);
    let mut left_out: Vec<String> = Vec::new();
    for cell in cells.iter().filter(|cell| !counts(cell)) {
        let why = if cell.emits { "emits" } else { "unlit" };
        left_out.push(format!("{} ({why})", cell.surface));
    }
    left_out.dedup();
    left_out.join(", ")
}

/// Says which file an error is about.
fn at<E: std::fmt::Display>(path: &Path) -> impl Fn(E) -> Error {
    move |error| Error::input(format!("{} {error}", path.display()))
}

fn print(Compared { named, left_out }: &Compared) -> Result<(), Error> {
    let names: Vec<String> = named
        .iter()
        .map(|(name, _)| printable::name(name))
        .collect();
    let longest = names.iter().map(|name| name.chars().count()).max();
    let width = longest.unwrap_or(0).max(12);
    say(&format!(
        "{:<width$}    RMSE %    bias %    median       90 %       99 %    largest    values",
        ""
    ))?;
    for (name, (_, errors)) in names.iter().zip(named) {
        let Errors {
            rmse_percent: rmse,
            bias_percent: bias,
            percentiles: p,
            values,
            noise_percent: _,
        } = errors;
        say(&format!(
            "{name:<width$} {rmse:>9.3} {bias:>+9.3} {:>9.3} {:>10.3} {:>10.3} {:>10.3} \
             {values:>9}",
            p.p50, p.p90, p.p99, p.max
        ))?;
    }
    say("in percent of the mean of the reference")?;
    if let Some((_, all)) = named.last()
        && let Some(noise) = all.noise_percent
    {
        let without = all.rmse_percent_without_noise();
        say(&format!(
            "of all, the reference's own noise is {noise:.3} %: without it, the RMSE is \
             {without:.3} %"
        ))?;
    }
    if left_out.is_empty() {
        Ok(())
    } else {
        say(&format!("left out: {left_out}"))
    }
}
