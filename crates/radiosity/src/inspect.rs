//! What a file of the cache says of itself.

use crate::metadata::{CLOSURE, FORM_FACTORS, FactorFacts, SOLUTION, SolutionFacts};
use crate::row_report::RowReport;
use crate::row_statistics::RowSummary;
use radiosity_cache::{Miss, Opened};
use radiosity_form_factors::{Estimator, RowFacts};
use serde::{Serialize, Serializer};

/// The object that `inspect --json` prints. Fields may be added, but not changed or removed.
#[derive(Debug, Serialize)]
pub struct Inspection {
    /// The stage that made it.
    pub stage: String,
    /// The digest of what it was made from, in hexadecimal digits.
    pub key: String,
    /// What there is to say of form factors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub form_factors: Option<FactorInspection>,
    /// What there is to say of a solution.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solution: Option<SolutionInspection>,
}

/// Form factors.
#[derive(Debug, Serialize)]
pub struct FactorInspection {
    /// How many patches they are of.
    pub patches: usize,
    /// How many surfaces.
    pub surfaces: usize,
    /// What they were estimated by.
    pub estimator: EstimatorReport,
    /// Statistics of the rows.
    #[serde(flatten, serialize_with = "as_reported")]
    pub rows: RowSummary,
    /// How many rows have |fronts + backs + background - 1| below 1e-6, 1e-5, and so on; the last
    /// are all others.
    pub off_by: [u64; CLOSURE_BOUNDS.len() + 1],
    /// Those that are farthest from closed.
    pub worst: Vec<WorstRow>,
}

/// A row that does not add up.
#[derive(Debug, Serialize)]
pub struct WorstRow {
    /// Its number in exported tables.
    pub row: u32,
    /// The surface of its patch.
    pub surface: String,
    /// fronts + backs + background - 1.
    pub excess: f64,
    /// All that is known of it.
    pub facts: RowFacts,
}

/// A solution.
#[derive(Debug, Serialize)]
pub struct SolutionInspection {
    /// How many patches it is of.
    pub patches: usize,
    /// The names of the lights.
    pub lights: Vec<String>,
    /// Passes over the matrix.
    pub sweeps: usize,
    /// Relative residual of the worst light.
    pub residual: f64,
    /// Whether it is as small as was asked for.
    pub converged: bool,
}

/// Under the names that all reports have.
fn as_reported<S: Serializer>(rows: &RowSummary, serializer: S) -> Result<S::Ok, S::Error> {
    RowReport::of(rows).serialize(serializer)
}

/// An estimator with its settings.
#[derive(Debug, Default, Serialize)]
pub struct EstimatorReport {
    /// `regular`, `monte-carlo` or `accurate`.
    pub mode: &'static str,
    /// Points, or strata, along each edge of a patch.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points: Option<u32>,
    /// Pairs of points per pair of patches.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pairs: Option<u32>,
    /// Seed of the random points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// Aimed sum of the errors of a row.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
}

impl EstimatorReport {
    /// In words.
    pub fn text(&self) -> String {
        let setting = |name: &str, value: Option<String>| {
            value.map_or(String::new(), |value| format!(", {name} {value}"))
        };
        [
            self.mode.to_owned(),
            setting("points", self.points.map(|n| n.to_string())),
            setting("pairs", self.pairs.map(|n| n.to_string())),
            setting("seed", self.seed.map(|n| n.to_string())),
            setting("tolerance", self.tolerance.map(|x| x.to_string())),
        ]
        .concat()
    }

    /// For reports.
    pub fn of(estimator: Estimator) -> EstimatorReport {
        match estimator {
            Estimator::Regular { points } => EstimatorReport {
                mode: "regular",
                points: Some(points),
                ..EstimatorReport::default()
            },
            Estimator::MonteCarlo {
                points,
                pairs,
                seed,
            } => EstimatorReport {
                mode: "monte-carlo",
                points: Some(points),
                pairs: Some(pairs),
                seed: Some(seed),
                tolerance: None,
            },
            Estimator::Accurate { tolerance } => EstimatorReport {
                mode: "accurate",
                tolerance: Some(tolerance),
                ..EstimatorReport::default()
            },
        }
    }
}

/// Between the classes of rows by how far from closed they are.
pub const CLOSURE_BOUNDS: [f64; 6] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
/// How many of the worst rows are shown.
const WORST: usize = 5;

impl Inspection {
    /// Reads all of a file. `names` are those of the surfaces, if they are known.
    pub fn of(opened: Opened, names: Option<&[String]>) -> Result<Inspection, Miss> {
        let (stage, key) = (opened.stage.clone(), opened.key.to_string());
        let mut inspection = Inspection {
            stage,
            key,
            form_factors: None,
            solution: None,
        };
        match &inspection.stage[..] {
            FORM_FACTORS | CLOSURE => {
                let (facts, values) = opened.into_artifact::<FactorFacts>()?.into_values()?;
                if !facts.are_sound(values.as_ref().len()) {
                    return Err(Miss::Header);
                }
                inspection.form_factors = Some(FactorInspection::of(&facts, names));
            }
            SOLUTION => {
                let artifact = opened.into_artifact::<SolutionFacts>()?;
                let (facts, values) = artifact.into_values()?;
                if !facts.are_sound(values.as_ref()) {
                    return Err(Miss::Header);
                }
                let (report, lights) = (facts.report, facts.lights);
                inspection.solution = Some(SolutionInspection {
                    patches: facts.visible.len(),
                    lights,
                    sweeps: report.residuals.len(),
                    residual: report.residual,
                    converged: report.converged,
                });
            }
            _ => return Err(Miss::NotACacheFile),
        }
        Ok(inspection)
    }
}

impl FactorInspection {
    fn of(facts: &FactorFacts, names: Option<&[String]>) -> FactorInspection {
        let excess = |row: &RowFacts| row.fronts + row.backs + row.background - 1.0;
        let mut off_by = [0; CLOSURE_BOUNDS.len() + 1];
        for row in &facts.rows {
            let class = CLOSURE_BOUNDS
                .iter()
                .position(|bound| excess(row).abs() < *bound);
            off_by[class.unwrap_or(CLOSURE_BOUNDS.len())] += 1;
        }
        let mut order: Vec<usize> = (0..facts.rows.len()).collect();
        let distance = |patch: &usize| excess(&facts.rows[*patch]).abs();
        order.sort_by(|a, b| distance(b).total_cmp(&distance(a)));
        let surfaces = facts.patches_of_surfaces.len();
        let names = names.filter(|names| names.len() == surfaces);
        let worst = |&patch: &usize| {
            let surface = facts.surface_of(patch);
            WorstRow {
                row: facts.exported_as[patch],
                surface: names.map_or_else(
                    || format!("surface {}", surface + 1),
                    |names| names[surface].clone(),
                ),
                excess: excess(&facts.rows[patch]),
                facts: facts.rows[patch],
            }
        };
        FactorInspection {
            patches: facts.rows.len(),
            surfaces,
            estimator: EstimatorReport::of(facts.estimator),
            rows: RowSummary::new(
                (&facts.areas, &facts.rows),
                |patch| facts.surface_of(patch),
                facts.classes,
                facts.closure,
            ),
            off_by,
            worst: order.iter().take(WORST).map(worst).collect(),
        }
    }
}
