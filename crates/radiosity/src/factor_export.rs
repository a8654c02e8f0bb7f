//! Form factors as tables for other programs.
//!
//! The matrix has entry `F[i, j]` from row `i` to column `j`: the share of the power leaving `i`
//! that arrives at `j`. Rows are patches in input order, or surfaces, or groups of them.
//!
//! Long because: one table, and every form in which it is written.

use crate::error::Error;
use crate::export::{faces_in_input_order, input_order};
use crate::remedy::Remedy;
use crate::resources::check_parts;
use crate::row_columns;
use radiosity_compare::table_name;
use radiosity_form_factors::{AggregateFactors, FormFactors, RowFacts};
use radiosity_geometry::{Face, Mesh};
use radiosity_scene::Scene;
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{self, Write};

/// What the rows of an exported matrix are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// Patches, in the order of [`radiosity_table`](crate::radiosity_table).
    Patch,
    /// Surfaces, in scene order.
    Surface,
    /// Groups of surfaces, and of faces of meshes, in the order in which the files name them first.
    Group,
}

/// The form factors of a scene, ready for export.
pub struct FactorTable<'a> {
    rows: Vec<TableRow<'a>>,
    entries: Entries<'a>,
}

/// What is known of a row beside its entries.
struct TableRow<'a> {
    /// The surface or group, as tables have it.
    name: Cow<'a, str>,
    /// Of patches.
    cell: Option<[u32; 2]>,
    area: f64,
    facts: RowFacts,
}

enum Entries<'a> {
    OfPatches {
        form_factors: &'a FormFactors,
        /// The patch of each row.
        order: Vec<usize>,
    },
    OfParts(AggregateFactors),
}

/// Bytes of a matrix between so many patches, surfaces or groups: as `.npy`, and at most about as
/// `.csv`, where most of what a number of seven digits takes is its place.
pub fn matrix_bytes(rows: u64) -> [u64; 2] {
    const OF_HEADER: u64 = 128;
    const OF_NUMBER: u64 = 14;
    [OF_HEADER + 4 * rows * rows, OF_NUMBER * rows * rows]
}

/// Rows that are computed at a time.
const ROWS_AT_A_TIME: usize = 64;

impl<'a> FactorTable<'a> {
    /// The form factors between the patches, surfaces or groups of a scene; an error if the machine
    /// cannot hold those between so many surfaces or groups.
    pub fn new(
        scene: &'a Scene,
        mesh: &Mesh,
        form_factors: &'a FormFactors,
        by: By,
    ) -> Result<FactorTable<'a>, Error> {
        type Name<'a> = fn(&'a Scene, &Face) -> &'a str;
        let (name_of, remedy): (Name<'a>, _) = match by {
            By::Patch => return Ok(FactorTable::of_patches(scene, mesh, form_factors)),
            By::Surface => (
                |scene, face| &scene.surfaces[face.surface.index()].name,
                "export them by patch, or put surfaces into groups and export by group",
            ),
            By::Group => (
                |scene, face| scene.group(face.surface, face.input_index),
                "export them by patch, or put surfaces into fewer groups",
            ),
        };
        let mut names: Vec<&str> = Vec::new();
        let mut part_of_name = BTreeMap::new();
        let mut part_of = vec![0; mesh.patches.len()];
        // Surfaces without patches are no part of the matrix.
        let faces = faces_in_input_order(mesh).into_iter();
        for face in faces.filter(|face| !face.is_bare()) {
            let name = name_of(scene, face);
            let part = *part_of_name.entry(name).or_insert_with(|| {
                names.push(name);
                names.len() - 1
            });
            part_of[face.patches()].fill(part);
        }
        check_parts(names.len(), Remedy::words(remedy))?;
        let aggregate = form_factors.aggregate(&part_of, names.len());
        let row = |(part, name)| TableRow {
            name: table_name(name),
            cell: None,
            area: aggregate.areas[part],
            facts: aggregate.rows[part],
        };
        Ok(FactorTable {
            rows: names.into_iter().enumerate().map(row).collect(),
            entries: Entries::OfParts(aggregate),
        })
    }

    fn of_patches(scene: &'a Scene, mesh: &Mesh, form_factors: &'a FormFactors) -> FactorTable<'a> {
        let order = input_order(scene, mesh);
        let row = |&(patch, cell): &(usize, [u32; 2])| TableRow {
            name: table_name(&scene.surfaces[mesh.patches[patch].surface.index()].name),
            cell: Some(cell),
            area: form_factors.areas[patch],
            facts: form_factors.rows[patch],
        };
        FactorTable {
            rows: order.iter().map(row).collect(),
            entries: Entries::OfPatches {
                form_factors,
                order: order.into_iter().map(|(patch, _)| patch).collect(),
            },
        }
    }

    /// How many rows there are, and columns.
    pub fn size(&self) -> usize {
        self.rows.len()
    }

    /// `F[i, j]`.
    pub fn factor(&self, i: usize, j: usize) -> f64 {
        match &self.entries {
            Entries::OfPatches {
                form_factors,
                order,
            } => form_factors.factor(order[i], order[j]),
            Entries::OfParts(aggregate) => aggregate.factor(i, j),
        }
    }

    /// The matrix as NumPy reads it: `float32`, by rows.
    pub fn write_npy(&self, file: &mut dyn Write) -> io::Result<()> {
        let size = self.size();
        file.write_all(&npy_header(size))?;
        self.for_each_row(|_, row| {
            row.iter()
                .try_for_each(|factor| file.write_all(&factor.to_le_bytes()))
        })
    }

    /// The matrix as plain numbers, one line per row.
    pub fn write_matrix(&self, file: &mut dyn Write) -> io::Result<()> {
        let mut file = csv::Writer::from_writer(file);
        self.for_each_row(|_, row| Ok(file.write_record(row.iter().map(f32::to_string))?))?;
        file.flush()
    }

    /// All entries of at least `least` that are not 0: between patches as `row,column,F`, else by
    /// name as `from,to,F,error`, with bounds of their errors, empty where the estimator does not
    /// tell. Gives the sum of the others in each row.
    pub fn write_entries(&self, least: f64, file: &mut dyn Write) -> io::Result<Vec<f64>> {
        let mut file = csv::Writer::from_writer(file);
        let mut dropped = vec![0.0; self.size()];
        match self.entries {
            Entries::OfPatches { .. } => file.write_record(["row", "column", "F"])?,
            Entries::OfParts(_) => file.write_record(["from", "to", "F", "error"])?,
        }
        self.for_each_row(|i, row| {
            for (j, &factor) in row.iter().enumerate() {
                if factor == 0.0 || f64::from(factor) < least {
                    dropped[i] += f64::from(factor);
                    continue;
                }
                match &self.entries {
                    Entries::OfPatches { .. } => {
                        file.write_record([i.to_string(), j.to_string(), factor.to_string()])?;
                    }
                    Entries::OfParts(aggregate) => {
                        let [from, to] = [i, j].map(|part| &*self.rows[part].name);
                        let factor = format!("{:.9e}", aggregate.factor(i, j));
                        file.write_record([from, to, &factor, &short(aggregate.error(i, j))])?;
                    }
                }
            }
            Ok(())
        })?;
        file.flush()?;
        Ok(dropped)
    }

    /// What the rows are: their areas and what is known of them, one line each. `dropped` are sums
    /// of entries that were left out of the matrix.
    pub fn write_rows(&self, dropped: Option<&[f64]>, file: &mut dyn Write) -> io::Result<()> {
        let mut file = csv::Writer::from_writer(file);
        let is_cells = self.rows.iter().any(|row| row.cell.is_some());
        let mut columns = vec!["row", "name"];
        columns.extend(is_cells.then_some(["ia", "ib"]).into_iter().flatten());
        columns.push("area");
        columns.extend(row_columns::columns(&RowFacts::default(), 0.0).map(|column| column.name));
        columns.extend(dropped.map(|_| "dropped"));
        file.write_record(columns)?;
        for (k, row) in self.rows.iter().enumerate() {
            let mut record = vec![k.to_string(), row.name.to_string()];
            record.extend(
                row.cell
                    .into_iter()
                    .flatten()
                    .map(|index| index.to_string()),
            );
            record.push(row.area.to_string());
            record.extend(row_columns::columns(&row.facts, row.area).map(|column| column.text()));
            record.extend(dropped.map(|dropped| short(Some(dropped[k]))));
            file.write_record(record)?;
        }
        file.flush()
    }

    /// Computes rows in parallel and hands them on in order.
    fn for_each_row(
        &self,
        mut take: impl FnMut(usize, &[f32]) -> io::Result<()>,
    ) -> io::Result<()> {
        let size = self.size();
        let entries = |i| (0..size).map(|j| self.factor(i, j) as f32).collect();
        for first in (0..size).step_by(ROWS_AT_A_TIME) {
            let some = first..size.min(first + ROWS_AT_A_TIME);
            let rows: Vec<Vec<f32>> = some.clone().into_par_iter().map(entries).collect();
            some.zip(&rows).try_for_each(|(i, row)| take(i, row))?;
        }
        Ok(())
    }
}

/// Three digits, or nothing.
fn short(number: Option<f64>) -> String {
    number.map_or(String::new(), |number| format!("{number:.2e}"))
}

/// The head of a NumPy file, format 1.0: a Python dictionary, padded so that data begin at a
/// multiple of 64 bytes.
fn npy_header(size: usize) -> Vec<u8> {
    const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";
    let dictionary =
        format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({size}, {size}), }}");
    let unpadded = MAGIC.len() + 2 + dictionary.len() + 1;
    let padding = " ".repeat(unpadded.next_multiple_of(64) - unpadded);
    let text = format!("{dictionary}{padding}\n");
    let length = u16::try_from(text.len()).expect("a short dictionary");
    [MAGIC, &length.to_le_bytes(), text.as_bytes()].concat()
}
