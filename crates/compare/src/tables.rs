//! The measure for radiosities of patches.

use crate::errors::{Differences, Errors};
use std::collections::{BTreeMap, HashMap, HashSet};

/// One patch of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Where the table has it, counted from 1.
    pub line: u64,
    /// Name of the surface.
    pub surface: String,
    /// The patch's two coordinates on the surface.
    pub cell: [u32; 2],
    /// W/m^2.
    pub radiosity: [f64; 3],
    /// W/m^2; zero in tables that have none.
    pub standard_error: [f64; 3],
}

/// Radiosities by patch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// In the order of the file.
    pub rows: Vec<Row>,
}

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

/// Why tables cannot be read or compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// The first line is another.
    #[error(
        "must begin with the columns surface,ia,ib,B_r,B_g,B_b (and may go on with se_r,se_g,se_b)"
    )]
    Columns,
    /// A line is wrong.
    #[error("line {line}: {problem}")]
    Line {
        /// Counted from 1.
        line: u64,
        /// What is wrong with it.
        problem: String,
    },
    /// A patch of the scene is in one table only.
    #[error("{table} lacks patch {},{} of `{surface}`: were both made from the same patches?", cell[0], cell[1])]
    Missing {
        /// Which table.
        table: &'static str,
        /// Name of the surface.
        surface: String,
        /// The patch.
        cell: [u32; 2],
    },
    /// A table has a patch that the scene does not have.
    #[error("line {line} of {table}: the scene has no patch {},{} of `{surface}`: name its subdivision with --patches", cell[0], cell[1])]
    Unknown {
        /// Which table.
        table: &'static str,
        /// Counted from 1.
        line: u64,
        /// Name of the surface.
        surface: String,
        /// The patch.
        cell: [u32; 2],
    },
    /// No patch is lit and does not emit.
    #[error("in the reference no patch that does not emit is lit")]
    Nothing,
}

const COLUMNS: [&str; 9] = [
    "surface", "ia", "ib", "B_r", "B_g", "B_b", "se_r", "se_g", "se_b",
];

/// Reads a table: the columns `surface,ia,ib,B_r,B_g,B_b`, with or without `se_r,se_g,se_b`.
pub fn parse_table(bytes: &[u8]) -> Result<Table, TableError> {
    let mut reader = csv::Reader::from_reader(bytes);
    let header = reader
        .headers()
        .map_err(|error| csv_problem(&error))?
        .clone();
    if !(header == COLUMNS[..6] || header == COLUMNS[..]) {
        return Err(TableError::Columns);
    }
    let mut table = Table::default();
    let mut seen = HashSet::new();
    for record in reader.records() {
        let record = record.map_err(|error| csv_problem(&error))?;
        let row = parse_row(&record)?;
        if !seen.insert((row.surface.clone(), row.cell)) {
            return Err(TableError::Line {
                line: row.line,
                problem: "this patch is in the table already".to_owned(),
            });
        }
        table.rows.push(row);
    }
    Ok(table)
}

fn csv_problem(error: &csv::Error) -> TableError {
    let line = error.position().map_or(1, csv::Position::line);
    TableError::Line {
        line,
        problem: error.to_string(),
    }
}

fn parse_row(record: &csv::StringRecord) -> Result<Row, TableError> {
    let line = record.position().map_or(1, csv::Position::line);
    let problem = |column: usize, expected: &str| TableError::Line {
        line,
        problem: format!(
            "`{}` is no {expected}: {}",
            &record[column], COLUMNS[column]
        ),
    };
    let index = |column: usize| record[column].parse::<u32>();
    let index = |column| index(column).map_err(|_| problem(column, "whole number"));
    let number = |column: usize| match record.get(column).map(str::parse::<f64>) {
        None => Ok(0.0),
        Some(Ok(number)) if number.is_finite() => Ok(number),
        Some(_) => Err(problem(column, "number")),
    };
    Ok(Row {
        line,
        surface: record[0].to_owned(),
        cell: [index(1)?, index(2)?],
        radiosity: [number(3)?, number(4)?, number(5)?],
        standard_error: [number(6)?, number(7)?, number(8)?],
    })
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
    }
    let mut all = Differences::default();
    let mut named = Vec::new();
    for surface in order {
        let differences = &by_surface[surface];
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
