//! What the files of the cache hold beside their arrays.

use crate::energy::Energy;
use crate::export::faces_in_input_order;
use crate::row_columns::is_finite;
use crate::row_statistics::RowSummary;
use radiosity_form_factors::{Classes, ClosureFacts, Estimator, FormFactors, RowFacts};
use radiosity_geometry::{Face, Mesh};
use radiosity_matrix::{Exchange, packed_len};
use radiosity_solver::Convergence;
use serde::{Deserialize, Serialize};

/// The stage of form factors as they are estimated.
pub const FORM_FACTORS: &str = "form-factors";
/// That of form factors whose rows are made to sum to 1.
pub const CLOSURE: &str = "closure";
/// That of radiosities.
pub const SOLUTION: &str = "solution";
/// Raise it whenever the layout of [`FactorFacts`] changes: it is part of their keys.
pub const FACTORS_VERSION: u32 = 11;
/// The same for [`SolutionFacts`].
pub const SOLUTION_VERSION: u32 = 13;

/// Beside the matrix of form factors.
#[derive(Debug, Serialize, Deserialize)]
pub struct FactorFacts {
    /// What they were estimated by.
    pub estimator: Estimator,
    /// How many patches each surface has: theirs come one after the other.
    pub patches_of_surfaces: Vec<u32>,
    /// The number of each patch's row in exported tables.
    pub exported_as: Vec<u32>,
    /// Per patch.
    pub areas: Vec<f64>,
    /// Per patch, the area of the part that exchanges light.
    pub elements: Vec<f64>,
    /// Per patch.
    pub rows: Vec<RowFacts>,
    /// Pairs by how much they see of each other, if the estimator tells.
    pub classes: Option<Classes>,
    /// How rows were made to sum to 1, if they were.
    pub closure: Option<ClosureFacts>,
}

/// Beside the radiosities.
#[derive(Debug, Serialize, Deserialize)]
pub struct SolutionFacts {
    /// How the solution was reached.
    pub report: Convergence,
    /// The rows of the form factors that it was made from.
    pub rows: RowSummary,
    /// The names of the lights, in the order of their radiosities. Their direct parts follow.
    pub lights: Vec<String>,
    /// Of each light, where its power goes.
    pub energies: Vec<Energy>,
    /// Of each patch, the share that exchanges light.
    pub elements: Vec<f32>,
    /// Of each patch, the share that can be seen; 0 where next to nothing can.
    pub visible: Vec<f32>,
}

impl FactorFacts {
    pub(crate) fn new(mesh: &Mesh, estimator: Estimator, made: &FormFactors) -> FactorFacts {
        FactorFacts {
            estimator,
            patches_of_surfaces: patches_of_surfaces(mesh),
            exported_as: exported_as(mesh),
            areas: made.areas.clone(),
            elements: made.exchange.areas().to_vec(),
            rows: made.rows.clone(),
            classes: made.classes,
            closure: made.closure,
        }
    }

    /// Facts that take as much room as those that are not known yet.
    pub(crate) fn blank(mesh: &Mesh, estimator: Estimator, tells_errors: bool) -> FactorFacts {
        let row = RowFacts {
            error: tells_errors.then_some(0.0),
            ..RowFacts::default()
        };
        FactorFacts {
            estimator,
            patches_of_surfaces: patches_of_surfaces(mesh),
            exported_as: exported_as(mesh),
            areas: vec![0.0; mesh.patches.len()],
            elements: vec![0.0; mesh.patches.len()],
            rows: vec![row; mesh.patches.len()],
            classes: tells_errors.then(Classes::default),
            closure: None,
        }
    }

    /// Whether they fit together, and to so many values, as facts of a program that is right do:
    /// whoever wrote a file, reading it must not fail later. Factors that are no numbers make sums
    /// of rows that are none, so the matrix itself need not be looked through.
    pub(crate) fn are_sound(&self, values: usize) -> bool {
        let patches = self.rows.len();
        let counts = self
            .patches_of_surfaces
            .iter()
            .map(|&count| u64::from(count));
        let mut rows = self.rows.iter().zip(&self.areas);
        let mut elements = self.elements.iter().zip(&self.areas);
        packed_len(patches) == values
            && counts.sum::<u64>() == patches as u64
            && self.exported_as.len() == patches
            && self.areas.len() == patches
            && self.elements.len() == patches
            && elements.all(|(element, area)| (0.0..=*area).contains(element))
            && self.exported_as.iter().all(|&row| (row as usize) < patches)
            && rows.all(|(row, area)| area.is_finite() && is_finite(row, *area))
    }

    /// The surface of a patch, by its number in the scene.
    pub(crate) fn surface_of(&self, patch: usize) -> usize {
        let mut end = 0;
        let ends = self.patches_of_surfaces.iter().map(|&count| {
            end += count as usize;
            end
        });
        ends.take_while(|&end| end <= patch).count()
    }
}

impl SolutionFacts {
    /// The same, of a solution and its values.
    pub(crate) fn are_sound(&self, values: &[f32]) -> bool {
        let (patches, lights) = (self.visible.len(), self.lights.len());
        let numbers = values.iter().chain(&self.visible).chain(&self.elements);
        values.len() == 6 * lights * patches
            && numbers.copied().all(f32::is_finite)
            && self.elements.len() == patches
            && self.energies.len() == lights
            && self.rows.largest.1 < (patches as u64).max(1)
    }
}

fn exported_as(mesh: &Mesh) -> Vec<u32> {
    let mut rows = vec![0; mesh.patches.len()];
    let patches = faces_in_input_order(mesh)
        .into_iter()
        .flat_map(Face::patches);
    patches.zip(0..).for_each(|(patch, row)| rows[patch] = row);
    rows
}

fn patches_of_surfaces(mesh: &Mesh) -> Vec<u32> {
    let last = mesh.faces.iter().map(|face| face.surface.index()).max();
    let mut counts = vec![0; last.map_or(0, |last| last + 1)];
    for face in &mesh.faces {
        counts[face.surface.index()] += face.grid.cells() as u32;
    }
    counts
}
