//! Radiosities by patch, as CSV.

use crate::table_name::{name_in_table, table_name};
use std::collections::{HashMap, HashSet};

/// One patch of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its line in the file, counted from 1.
    pub line: u64,
    /// Name of the surface.
    pub surface: String,
    /// The patch's two coordinates on the surface.
    pub cell: [u32; 2],
    /// W/m^2.
    pub radiosity: [f64; 3],
    /// W/m^2, if the table tells.
    pub standard_error: Option<[f64; 3]>,
}

/// Radiosities by patch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// In the order of the file.
    pub rows: Vec<Row>,
}

impl Table {
    /// The means over blocks of `factor x factor` cells of each surface, which are of one size:
    /// cells of parallelograms are. Without standard errors, since those of neighbours may hang
    /// together.
    pub fn coarsened(&self, factor: u32) -> Result<Table, TableError> {
        let mut sums: Vec<(Row, u32)> = Vec::new();
        let mut places = HashMap::new();
        for row in &self.rows {
            let cell = row.cell.map(|index| index / factor.max(1));
            let place = *places
                .entry((row.surface.as_str(), cell))
                .or_insert_with(|| {
                    let standard_error = None;
                    let radiosity = [0.0; 3];
                    let blank = Row {
                        cell,
                        radiosity,
                        standard_error,
                        ..row.clone()
                    };
                    sums.push((blank, 0));
                    sums.len() - 1
                });
            let (sum, count) = &mut sums[place];
            *count += 1;
            sum.radiosity = std::array::from_fn(|c| sum.radiosity[c] + row.radiosity[c]);
        }
        let mean = |(mut sum, count): (Row, u32)| {
            if count != factor * factor {
                return Err(TableError::Block {
                    line: sum.line,
                    factor,
                    count,
                });
            }
            sum.radiosity = sum.radiosity.map(|total| total / f64::from(count));
            Ok(sum)
        };
        let rows = sums.into_iter().map(mean).collect::<Result<_, _>>()?;
        Ok(Table { rows })
    }

    /// The table as [`parse_table`] reads it, radiosities rounded to single precision and
    /// standard errors to three digits; without those, if not all rows have one.
    pub fn to_csv(&self) -> Vec<u8> {
        let has_errors = self.rows.iter().all(|row| row.standard_error.is_some());
        let columns = if has_errors {
            COLUMNS.len()
        } else {
            WITHOUT_ERRORS
        };
        let in_memory = "memory takes all bytes";
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&COLUMNS[..columns]).expect(in_memory);
        for row in &self.rows {
            let mut record = vec![table_name(&row.surface).into_owned()];
            record.extend(row.cell.map(|index| index.to_string()));
            record.extend(row.radiosity.map(|b| (b as f32).to_string()));
            let errors = row.standard_error.filter(|_| has_errors);
            record.extend(errors.into_iter().flatten().map(|e| format!("{e:.2e}")));
            writer.write_record(record).expect(in_memory);
        }
        writer.into_inner().expect(in_memory)
    }
}

/// Why tables cannot be read or compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// The first line lacks a column.
    #[error(
        "must have the columns surface,ia,ib,B_r,B_g,B_b (and may have se_r,se_g,se_b and others)"
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
    /// Cells cannot be averaged in blocks.
    #[error("line {line}: the block of {factor} x {factor} cells that begins here has {count}")]
    Block {
        /// Counted from 1.
        line: u64,
        /// Cells along each edge of a block.
        factor: u32,
        /// How many were found.
        count: u32,
    },
    /// A patch of the scene is in one table only.
    #[error(
        "{table} lacks patch {},{} of `{surface}`: were both made from the same patches?",
        cell[0], cell[1]
    )]
    Missing {
        /// Which table.
        table: &'static str,
        /// Name of the surface.
        surface: String,
        /// The patch.
        cell: [u32; 2],
    },
    /// A table has a patch that the scene does not have.
    #[error(
        "line {line} of {table}: the scene has no patch {},{} of `{surface}`: \
         name its subdivision with --patches",
        cell[0], cell[1]
    )]
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
/// How many columns a table has that does not tell of errors.
const WITHOUT_ERRORS: usize = 6;

/// Reads a table: the columns `surface,ia,ib,B_r,B_g,B_b`, with or without `se_r,se_g,se_b`; others
/// are passed over. Names may have an apostrophe before them, as [`table_name`] says.
///
/// ```
/// use radiosity_compare::parse_table;
///
/// let table = parse_table(b"surface,ia,ib,B_r,B_g,B_b\nfloor,0,1,0.5,0.25,0.125\n")?;
/// assert_eq!(table.rows[0].cell, [0, 1]);
/// assert_eq!(table.rows[0].radiosity, [0.5, 0.25, 0.125]);
///
/// let error = parse_table(b"surface,ia,ib,B_r,B_g,B_b\nfloor,0,x,1,1,1\n").unwrap_err();
/// assert_eq!(error.to_string(), "line 2: `x` is no whole number: ib");
/// # Ok::<(), radiosity_compare::TableError>(())
/// ```
pub fn parse_table(bytes: &[u8]) -> Result<Table, TableError> {
    let mut reader = csv::Reader::from_reader(bytes);
    let header = reader
        .headers()
        .map_err(|error| csv_problem(&error))?
        .clone();
    let columns = Columns::of(&header).ok_or(TableError::Columns)?;
    let mut table = Table::default();
    let mut seen = HashSet::new();
    for record in reader.records() {
        let record = record.map_err(|error| csv_problem(&error))?;
        let row = columns.row(&record)?;
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

/// Where the columns of a table are.
struct Columns {
    places: Vec<usize>,
}

impl Columns {
    /// Those of errors count if all three are there; others may be there too.
    fn of(header: &csv::StringRecord) -> Option<Columns> {
        let place = |name: &&str| header.iter().position(|column| column == *name);
        let places: Option<Vec<usize>> = COLUMNS[..WITHOUT_ERRORS].iter().map(place).collect();
        let errors: Option<Vec<usize>> = COLUMNS[WITHOUT_ERRORS..].iter().map(place).collect();
        let mut places = places?;
        places.extend(errors.into_iter().flatten());
        Some(Columns { places })
    }

    fn row(&self, record: &csv::StringRecord) -> Result<Row, TableError> {
        let line = record.position().map_or(1, csv::Position::line);
        let field = |column: usize| &record[self.places[column]];
        let problem = |column: usize, expected: &str| TableError::Line {
            line,
            problem: format!("`{}` is no {expected}: {}", field(column), COLUMNS[column]),
        };
        let index = |column: usize| field(column).parse::<u32>();
        let index = |column| index(column).map_err(|_| problem(column, "whole number"));
        let number = |column: usize| match field(column).parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(problem(column, "number")),
        };
        let numbers = |first: usize| Ok([number(first)?, number(first + 1)?, number(first + 2)?]);
        let has_errors = self.places.len() > WITHOUT_ERRORS;
        Ok(Row {
            line,
            surface: name_in_table(field(0)).to_owned(),
            cell: [index(1)?, index(2)?],
            radiosity: numbers(3)?,
            standard_error: has_errors.then(|| numbers(6)).transpose()?,
        })
    }
}
