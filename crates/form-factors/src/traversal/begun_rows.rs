//! Rows in parts: some rows at a time, against some tiles at a time.

use crate::estimate::Estimation;
use crate::tally::{ClassSums, RowError, Tally};
use crate::traversal::tile_block::Workspace;
use crate::traversal::tiles::Group;
use radiosity_matrix::{packed_len, rows_mut};
use radiosity_simd::LANES;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::time::{Duration, Instant};

/// Rows on their way: see [`Estimation::begin`].
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct BegunRows<V = Vec<f32>> {
    /// Which rows.
    pub rows: Range<usize>,
    /// Their values, one row after the other.
    pub values: V,
    /// They are estimated against the first so many tiles.
    tiles: usize,
    /// How many tiles the next part adds.
    #[serde(skip, default = "one")]
    step: usize,
}

fn one() -> usize {
    1
}

/// Parts that take less than this are followed by larger ones.
const STEP: Duration = Duration::from_millis(10);

impl Estimation<'_> {
    /// Rows that [`Estimation::next_rows`] gave, with nothing of them estimated yet.
    pub fn begin(&self, rows: Range<usize>) -> BegunRows {
        let pairs = packed_len(rows.end) - packed_len(rows.start);
        self.begin_in(rows, vec![0.0; pairs])
    }

    /// The same with values in another place, which are zero and as many as the rows have.
    pub fn begin_in<V: AsMut<[f32]>>(&self, rows: Range<usize>, values: V) -> BegunRows<V> {
        BegunRows {
            rows,
            values,
            tiles: 0,
            step: 1,
        }
    }

    /// Whether these are rows that may follow after the first so many, as [`Estimation::begin`] and
    /// [`Estimation::go_on`] leave them.
    pub fn has_begun(&self, begun: &BegunRows, first: usize) -> bool {
        let BegunRows {
            rows,
            values,
            tiles,
            ..
        } = begun;
        self.next_rows(first, 0).as_ref() == Some(rows)
            && values.len() == packed_len(rows.end) - packed_len(rows.start)
            && *tiles <= self.tiles_before(rows)
    }

    /// Goes on with rows for one part: some hundred pairs where pairs are slow. Returns how many
    /// pairs these are. Adds to the tally.
    ///
    /// The result depends neither on the number of threads nor on the parts.
    pub fn go_on<V: AsMut<[f32]>>(&self, begun: &mut BegunRows<V>, tally: &Tally) -> u64 {
        let next = self.tiles_before(&begun.rows).min(begun.tiles + begun.step);
        let start = Instant::now();
        let rows = (begun.rows.clone(), begun.values.as_mut());
        let pairs = self.fill(rows, begun.tiles..next, tally);
        begun.tiles = next;
        if start.elapsed() < STEP {
            begun.step *= 2;
        }
        pairs
    }

    /// Whether rows are estimated against all tiles.
    pub fn is_finished<V>(&self, begun: &BegunRows<V>) -> bool {
        begun.tiles == self.tiles_before(&begun.rows)
    }

    /// How many tiles rows are estimated against: those of groups that begin before their end.
    fn tiles_before(&self, rows: &Range<usize>) -> usize {
        let groups = &self.mesh.tiling.groups;
        let count = groups.partition_point(|group| group.patches.start < rows.end);
        groups[..count].last().map_or(0, |last| last.tiles.end)
    }

    /// Fills what rows have with some of the tiles, and counts these pairs.
    pub(crate) fn fill(
        &self,
        (rows, values): (Range<usize>, &mut [f32]),
        others: Range<usize>,
        tally: &Tally,
    ) -> u64 {
        let row_runs = self.mesh.tiling.row_runs.iter();
        let tiles = row_runs
            .filter(|row_run| rows.contains(&row_run.patches.start))
            .flat_map(|row_run| row_run.tiles.clone());
        let mut slices = rows_mut(rows.clone(), values);
        let mut take = |&patch: &usize| std::mem::take(&mut slices[patch - rows.start]);
        let of_tile = |tile: usize| {
            let patches = &self.mesh.tiling.tiles[tile].patches;
            (tile, patches.iter().map(&mut take).collect())
        };
        let tiles: Vec<(usize, Vec<&mut [f32]>)> = tiles.map(of_tile).collect();
        let of_tile = |workspace: &mut Workspace, (tile, mut rows): (usize, Vec<&mut [f32]>)| {
            let mut pairs = 0;
            for (group, others) in self.groups_of(tile, &others) {
                let patches = self.mesh.tiling.tiles[others.clone()].iter();
                let patches = patches.flat_map(|other| &other.patches);
                let before = |row: &[f32]| patches.clone().filter(|&&j| j < row.len()).count();
                pairs += rows.iter().map(|row| before(row)).sum::<usize>() as u64;
                self.fill_tile(tile, (group, others), &mut rows, workspace, tally);
            }
            pairs
        };
        let pairs = tiles.into_par_iter().map_init(Workspace::default, of_tile);
        pairs.sum()
    }

    /// Of some tiles those in groups that begin before a tile's end, group by group.
    fn groups_of(
        &self,
        tile: usize,
        others: &Range<usize>,
    ) -> impl Iterator<Item = (&Group, Range<usize>)> {
        let groups = &self.mesh.tiling.groups;
        let first = groups.partition_point(|group| group.tiles.end <= others.start);
        let Range { start, end } = others.clone();
        let before = move |group: &&Group| group.tiles.start < end && group.tiles.start <= tile;
        groups[first..].iter().take_while(before).map(move |group| {
            let some = start.max(group.tiles.start)..end.min(group.tiles.end);
            (group, some)
        })
    }

    /// Fills what the zeroed rows of a tile have with some tiles of a group, and adds to the tally.
    fn fill_tile(
        &self,
        tile: usize,
        others: (&Group, Range<usize>),
        rows: &mut [&mut [f32]],
        workspace: &mut Workspace,
        tally: &Tally,
    ) {
        let tiles = &self.mesh.tiling.tiles;
        let patches = &tiles[tile].patches;
        let mut errors = TileErrors::default();
        self.for_each_block(tile, others, workspace, |other, block| {
            let others = &tiles[other].patches;
            for (row, values) in rows.iter_mut().zip(&block.values) {
                for (&j, &value) in others.iter().zip(values) {
                    // Only small faces share their tile with patches that come after.
                    if let Some(entry) = row.get_mut(j) {
                        *entry = value;
                    }
                }
            }
            for ([lane, k], estimate) in &block.estimates {
                let j = others[*k];
                if j < rows[*lane].len() {
                    errors.rows[*lane] += RowError::of(estimate, self.areas[patches[*lane]]);
                    tally.add_error(j, RowError::of(estimate, self.areas[j]));
                    // In a mean over rows a pair counts twice.
                    let error = 2.0 * estimate.error / self.total_area;
                    errors.classes.add(estimate.visibility, error);
                }
            }
        });
        if self.tells_errors() {
            for (&patch, error) in patches.iter().zip(errors.rows) {
                tally.add_error(patch, error);
            }
            tally.add_classes(&errors.classes);
        }
    }
}

/// The errors of a tile's rows, as far as they go.
#[derive(Default)]
struct TileErrors {
    rows: [RowError; LANES],
    classes: ClassSums,
}
