//! The measure for radiosities of patches.

use crate::errors::{Differences, Errors};
use crate::table::{Row, Table, TableError};
use std::collections::{BTreeMap, HashMap};

/// A patch that both tables must have.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Name of the surface.
    pub surface: String,
    /// The patch's two coordinates on the surface.
    pub cell: [u32; 2],
    /// Its weight.
    pub area: f64,
    /// Emitters are left out: their radiosity is known beforehand.
    pub emits: bool,
}

/// The errors of radiosities against a reference, each patch weighted by its area, over the
/// patches that do not emit, of the surfaces that the reference shows lit: for every surface, and
/// for `"all"`. Both tables must have exactly the patches of `cells`.
pub fn compare_tables(
    cells: &[Cell],
    found: &Table,
    reference: &Table,
) -> Result<Vec<(String, Errors)>, TableError> {
    let found = by_cell(cells, found, "the table")?;
    let reference = by_cell(cells, reference, "the reference")?;
    let mut by_surface: BTreeMap<&str, Differences> = BTreeMap::new();
    let mut order: Vec<&str> = Vec::new();
    for (cell, (found, reference)) in cells.iter().zip(found.iter().zip(&reference)) {
        if cell.emits {
            continue;
        }
        if !by_surface.contains_key(cell.surface.as_str()) {
            order.push(&cell.surface);
        }
        let differences = by_surface.entry(&cell.surface).or_default();
        for (&found, &reference) in found.radiosity.iter().zip(&reference.radiosity) {
            differences.add(cell.area, reference, found);
        }
        for error in reference.standard_error.into_iter().flatten() {
            differences.add_noise(cell.area, error);
        }
    }
    let mut all = Differences::default();
    let mut named = Vec::new();
    for surface in order {
        let mut differences = by_surface.remove(surface).unwrap_or_default();
        // A dark surface has no errors: it is unlit.
        if let Some(errors) = differences.errors() {
            named.push((surface.to_owned(), errors));
            all.append(differences);
        }
    }
    named.push(("all".to_owned(), all.errors().ok_or(TableError::Nothing)?));
    Ok(named)
}

/// The rows of a table in the order of the cells.
fn by_cell<'a>(
    cells: &[Cell],
    table: &'a Table,
    name: &'static str,
) -> Result<Vec<&'a Row>, TableError> {
    let mut rows: HashMap<(&str, [u32; 2]), &Row> = HashMap::new();
    rows.extend(
        table
            .rows
            .iter()
            .map(|row| ((row.surface.as_str(), row.cell), row)),
    );
    let mut found = Vec::with_capacity(cells.len());
    for cell in cells {
        let row = rows.remove(&(cell.surface.as_str(), cell.cell));
        found.push(row.ok_or_else(|| TableError::Missing {
            table: name,
            surface: cell.surface.clone(),
            cell: cell.cell,
        })?);
    }
    match rows.into_values().min_by_key(|row| row.line) {
        None => Ok(found),
        Some(row) => Err(TableError::Unknown {
            table: name,
            line: row.line,
            surface: row.surface.clone(),
            cell: row.cell,
        }),
    }
}
