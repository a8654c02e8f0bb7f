//! Rows in parts: some rows at a time, against some tiles at a time.

use crate::estimate::{Estimation, Room};
use crate::pairs::Told;
use crate::tally::{ClassSums, RowError, Tally};
use crate::tiles::Group;
use radiosity_matrix::{packed_len, rows_mut};
use radiosity_simd::LANES;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::time::{Duration, Instant};

/// Rows on their way: see [`Estimation::begin`].
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Begun {
    /// Which rows.
    pub rows: Range<usize>,
    /// Their values, one row after the other.
    pub values: Vec<f32>,
    /// Against so many tiles they are estimated.
    tiles: usize,
}

/// Parts that take less than this are followed by larger ones.
const STEP: Duration = Duration::from_millis(10);

impl Estimation<'_> {
    /// Rows that [`Estimation::next_rows`] gave, with nothing of them estimated yet.
    pub fn begin(&self, rows: Range<usize>) -> Begun {
        let pairs = packed_len(rows.end) - packed_len(rows.start);
        Begun {
            values: vec![0.0; pairs],
            rows,
            tiles: 0,
        }
    }

    /// Whether these are rows that may follow after the first so many, as [`Estimation::begin`] and
    /// [`Estimation::go_on`] leave them.
    pub fn has_begun(&self, begun: &Begun, first: usize) -> bool {
        let Begun {
            rows,
            values,
            tiles,
        } = begun;
        self.next_rows(first, 0).as_ref() == Some(rows)
            && values.len() == packed_len(rows.end) - packed_len(rows.start)
            && *tiles <= self.tiles_before(rows)
    }

    /// Goes on with rows until they are finished, or `is_time` to stop: it is asked after each
    /// part, of some hundred pairs where pairs are slow. Returns whether they are finished. Adds to
    /// the tally.
    ///
    /// The result depends neither on the number of threads nor on where it stops.
    pub fn go_on(
        &self,
        begun: &mut Begun,
        tally: &Tally,
        progress: &(dyn Fn(u64) + Sync),
        is_time: &(dyn Fn() -> bool + Sync),
    ) -> bool {
        let end = self.tiles_before(&begun.rows);
        let mut step = 1;
        while begun.tiles < end {
            let next = end.min(begun.tiles + step);
            let start = Instant::now();
            self.fill(begun, begun.tiles..next, tally, progress);
            begun.tiles = next;
            if is_time() {
                break;
            }
            if start.elapsed() < STEP {
                step *= 2;
            }
        }
        begun.tiles == end
    }

    /// How many tiles rows are estimated against: those of groups that begin before their end.
    fn tiles_before(&self, rows: &Range<usize>) -> usize {
        let groups = &self.tiling.groups;
        let count = groups.partition_point(|group| group.patches.start < rows.end);
        groups[..count].last().map_or(0, |last| last.tiles.end)
    }

    /// Fills what rows have with some of the tiles.
    pub(crate) fn fill(
        &self,
        begun: &mut Begun,
        others: Range<usize>,
        tally: &Tally,
        progress: &(dyn Fn(u64) + Sync),
    ) {
        let Begun { rows, values, .. } = begun;
        let strips = self.tiling.strips.iter();
        let tiles = strips
            .filter(|strip| rows.contains(&strip.patches.start))
            .flat_map(|strip| strip.tiles.clone());
        let mut slices = rows_mut(rows.clone(), values);
        let mut take = |&patch: &usize| std::mem::take(&mut slices[patch - rows.start]);
        let of_tile = |tile: usize| {
            let patches = &self.tiling.tiles[tile].patches;
            (tile, patches.iter().map(&mut take).collect())
        };
        let tiles: Vec<(usize, Vec<&mut [f32]>)> = tiles.map(of_tile).collect();
        tiles
            .into_par_iter()
            .for_each_init(Room::default, |room, (tile, mut rows)| {
                for (group, others) in self.groups_of(tile, &others) {
                    let patches = self.tiling.tiles[others.clone()].iter();
                    let patches = patches.flat_map(|other| &other.patches);
                    let before = |row: &[f32]| patches.clone().filter(|&&j| j < row.len()).count();
                    let pairs: usize = rows.iter().map(|row| before(row)).sum();
                    self.fill_tile(tile, (group, others), &mut rows, room, tally);
                    progress(pairs as u64);
                }
            });
    }

    /// Of some tiles those in groups that begin before a tile's end, group by group.
    fn groups_of(
        &self,
        tile: usize,
        others: &Range<usize>,
    ) -> impl Iterator<Item = (&Group, Range<usize>)> {
        let groups = &self.tiling.groups;
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
        room: &mut Room,
        tally: &Tally,
    ) {
        let patches = &self.tiling.tiles[tile].patches;
        let area = |patch: usize| self.areas[patch];
        let mut classes = ClassSums::default();
        let mut errors = [RowError::default(); LANES];
        let mut tell = |lane: usize, told: Told<'_>| {
            let row = &mut *rows[lane];
            for (&j, &value) in told.others.iter().zip(told.values) {
                // Only small faces share their tile with patches that come after.
                let Some(entry) = row.get_mut(j) else {
                    continue;
                };
                *entry = value;
                if let Some(exchange) = told.estimate {
                    errors[lane] += RowError::of(&exchange, area(patches[lane]));
                    tally.add_error(j, RowError::of(&exchange, area(j)));
                    // In a mean over rows a pair counts twice.
                    classes.add(exchange.sight, 2.0 * exchange.error * self.scale);
                }
            }
        };
        self.against((tile, 0..patches.len()), others, room, &mut tell);
        if self.tells_errors() {
            for (&patch, error) in patches.iter().zip(errors) {
                tally.add_error(patch, error);
            }
            tally.add_classes(&classes);
        }
    }
}
