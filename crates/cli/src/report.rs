//! What a run has to say, as lines for people and as JSON for scripts.

use crate::error::Error;
use crate::lines::{
    blind_line, class_line, closed_line, closure_line, error_line, indented, labelled, missed_line,
    row_line, scene_line, unbalanced_lines,
};
use crate::save::Written;
use crate::solve_report::{SolveReport, solution_lines};
use crate::terminal::{Terminal, say_json};
use radiosity::darkness;
use radiosity::geometry::Face;
use radiosity::openings;
use radiosity::stages::{Dimming, Factors, Patches, Solved};
use radiosity::words::{bytes, grouped};
use radiosity::{Energy, Origin, Provenance};
use radiosity::{RowReport, RowSummary};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// Collects what happened; prints each line as soon as it is known.
pub(crate) struct Report<'a> {
    terminal: &'a Terminal,
    json: Json,
}

/// The object that `--json` prints. Fields may be added, but not changed or removed.
#[derive(Debug, Serialize)]
struct Json {
    /// The scene's name.
    scene: String,
    /// How many patches it was cut into.
    patches: usize,
    /// The stages that ran; others are absent.
    stages: Stages,
    /// Written files: `constant` and `smooth` for the first picture format, `constant_png` and
    /// the like for others, `export` for a table.
    outputs: BTreeMap<String, String>,
}

#[derive(Debug, Default, Serialize)]
struct Stages {
    #[serde(skip_serializing_if = "Option::is_none")]
    form_factors: Option<FormFactorReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    solve: Option<SolveReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    display: Option<DisplayReport>,
}

#[derive(Debug, Serialize)]
struct FormFactorReport {
    seconds: f64,
    cached: bool,
    /// Why they were computed, or that nobody needed them; null if cached.
    reason: Option<String>,
    #[serde(flatten)]
    rows: RowReport,
}

/// So many files are told one by one.
const MOST_TOLD: usize = 12;

#[derive(Debug, Serialize)]
pub(crate) struct DisplayReport {
    pub(crate) seconds: f64,
    /// The factor from radiance to brightness, of pictures that are shown as an eye sees them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) exposure: Option<f64>,
}

impl<'a> Report<'a> {
    pub(crate) fn new(patches: &Patches<'_>, terminal: &'a Terminal) -> Report<'a> {
        let (scene, patches) = (patches.scene(), patches.mesh.patches.len());
        terminal.line(&scene_line(scene, patches));
        Report {
            terminal,
            json: Json {
                scene: scene.name.clone(),
                patches,
                stages: Stages::default(),
                outputs: BTreeMap::new(),
            },
        }
    }

    pub(crate) fn form_factors(
        &mut self,
        origin: &Origin,
        rows: &RowSummary,
        factors: &Factors<'_>,
    ) {
        let patches = factors.patches();
        let (scene, mesh) = (patches.scene(), &patches.mesh);
        self.stage_line("form factors", origin);
        // What only blocks takes a share of each row, which no factor has.
        let has_obstructions = mesh.faces.iter().any(Face::is_bare);
        let closed = (scene.closed && !has_obstructions).then(|| closed_line(rows));
        let classes = rows.classes.as_ref();
        let classes = classes.map(|classes| class_line(classes, mesh.patches.len()));
        let details = [Some(row_line(rows)), error_line(rows), closed, classes];
        for line in details.into_iter().flatten() {
            self.terminal.detail(&indented(&line));
        }
        let lines = missed_line(rows).into_iter().chain(closure_line(rows));
        // Where there are lights, they tell more.
        let blind = blind_line(rows).filter(|_| !has_obstructions && scene.lights.is_empty());
        for line in lines.chain(blind) {
            self.terminal.line(&indented(&line));
        }
        if scene.closed && openings::show_in_rows(rows) {
            for line in openings::warnings(scene, mesh) {
                self.terminal.line(&indented(&line));
            }
        }
        if rows.excessive > 0
            && let Some(weakness) = factors.known_weakness()
        {
            let count = mesh.patches.len() as u64;
            let (sum, patch) = rows.largest;
            self.terminal.line(&indented(&format!(
                "note: the form factors from {} of {} patches sum to more than 1, to {sum:.3} at \
                 worst (in `{}`): {weakness}",
                grouped(rows.excessive),
                grouped(count),
                patches.surface_name(patch as usize),
            )));
        }
        let name = |surface: u32| match scene.surfaces.get(surface as usize) {
            Some(surface) => surface.name.clone(),
            None => format!("surface {surface}"),
        };
        for line in unbalanced_lines(rows, name) {
            self.terminal.line(&indented(&line));
        }
        self.json.stages.form_factors = Some(FormFactorReport {
            seconds: origin.seconds,
            cached: origin.is_cached(),
            reason: origin.reason().map(str::to_owned),
            rows: RowReport::of(rows),
        });
    }

    pub(crate) fn solution(
        &mut self,
        solved: &Solved<'_>,
        patches: &Patches<'_>,
        dimming: &Dimming,
        energy: &Energy,
    ) {
        self.stage_line("solution", &solved.origin);
        let light = darkness::light_lines(patches, dimming, energy);
        let lines = solution_lines(solved, energy, self.terminal.is_verbose);
        for line in lines.into_iter().chain(light) {
            self.terminal.line(&indented(&line));
        }
        self.json.stages.solve = Some(SolveReport::of(solved, energy));
    }

    pub(crate) fn display(&mut self, display: DisplayReport) {
        let seconds = format!("{:.2} s", display.seconds);
        let how = match display.exposure {
            Some(factor) => format!("rendered (--exposure {factor})"),
            None => "rendered".to_owned(),
        };
        let line = labelled("pictures", &format!("{how:<36}{seconds:>9}"));
        self.terminal.line(&line);
        self.json.stages.display = Some(display);
    }

    /// Many files, of which not all are told to people.
    pub(crate) fn outputs(&mut self, files: BTreeMap<String, Written>) {
        let more = files.len().saturating_sub(MOST_TOLD);
        for (index, (name, Written { path, replaced })) in files.into_iter().enumerate() {
            let path = path.display().to_string();
            if more <= 1 || index < MOST_TOLD {
                let how = if replaced { " (replaced)" } else { "" };
                self.terminal.line(&indented(&format!("{path}{how}")));
            }
            self.json.outputs.insert(name, path);
        }
        if more > 1 {
            self.terminal
                .line(&indented(&format!("and {more} more files beside them")));
        }
    }

    pub(crate) fn output(&mut self, name: &str, path: &Path) {
        let path = path.display().to_string();
        self.terminal.line(&indented(&path));
        self.json.outputs.insert(name.to_owned(), path);
    }

    /// Prints the JSON object, if one is wanted; an error if something could not be printed.
    pub(crate) fn finish(&self) -> Result<(), Error> {
        if self.terminal.json {
            say_json(&self.json)?;
        }
        self.terminal.finish()
    }

    fn stage_line(&self, stage: &str, origin: &Origin) {
        let how = match &origin.how {
            Provenance::Cached => "cached".to_owned(),
            Provenance::Computed(reason) => format!("computed ({reason})"),
            Provenance::NotNeeded => "not needed".to_owned(),
        };
        let (seconds, size) = (format!("{:.2} s", origin.seconds), bytes(origin.bytes));
        let line = labelled(stage, &format!("{how:<36}{seconds:>9}{size:>9}"));
        self.terminal.line(&line);
        if let Some(file) = &origin.file {
            let line = format!("kept in {}", file.display());
            self.terminal.detail(&indented(&line));
        }
    }
}
