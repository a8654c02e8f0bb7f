//! Stage 2: all rows, or some of them at a time.
//!
//! Pairs are processed in tiles of eight patches. What may stand between two tiles is culled from
//! groups of tiles down to tiles, and by most estimators down to pairs, so that most pairs cost no
//! visibility test at all. An estimator turns two tiles into one block of values and errors
//! ([`PairEstimator`]). Tiles of rows are filled in parallel; each value depends on its pair alone,
//! so the result is the same for any number of threads.

use crate::accurate::Accurate;
use crate::culling::blockers::Blockers;
use crate::hemisphere::Hemisphere;
use crate::monte_carlo::MonteCarlo;
use crate::regular::Regular;
use crate::tally::Tally;
use crate::traversal::tile_block::{PairEstimator, TileBlock, TilePair, Workspace};
use crate::traversal::tiled_mesh::{FEW, TiledMesh};
use crate::traversal::tiles::{Group, Tile, Tiling};
use crate::{Closure, Estimator, FormFactors, Params};
use radiosity_geometry::Mesh;
use radiosity_matrix::{SymmetricMatrix, packed_len};
use radiosity_params::Parameters;
use rayon::prelude::*;
use std::ops::Range;

/// Estimates all form factors of a mesh.
///
/// ```
/// use radiosity_form_factors::{Params, estimate};
/// use radiosity_geometry::{DVec3, Divisions, Shape, subdivide};
///
/// // Two squares of side 1 that face each other over a distance of 1.
/// let square = |corner, edge_a, edge_b| Shape::Parallelogram { corner, edge_a, edge_b };
/// let lower = square(DVec3::ZERO, DVec3::X, DVec3::Y);
/// let upper = square(DVec3::Z, DVec3::Y, DVec3::X);
/// let mesh = subdivide(&[lower.into(), upper.into()], Divisions::uniform(1))?;
/// let factors = estimate(&mesh, &Params::default());
/// assert!((factors.factor(0, 1) - 0.199_825).abs() < 1e-6);
/// # Ok::<(), radiosity_geometry::MeshError>(())
/// ```
///
/// # Panics
///
/// If a parameter is out of its range.
pub fn estimate(mesh: &Mesh, params: &Params) -> FormFactors {
    let checked = params.check();
    checked.unwrap_or_else(|error| panic!("{error}"));
    let estimated = Estimation::new(mesh, params.estimator()).run();
    match params.closure {
        true => Closure::of(&estimated).close(&estimated),
        false => estimated,
    }
}

/// [`estimate`] in steps.
pub struct Estimation<'a> {
    pub(crate) mesh: TiledMesh<'a>,
    pub(crate) estimator: Box<dyn PairEstimator + 'a>,
    /// By patch, the area that takes part.
    pub(crate) areas: Vec<f64>,
    pub(crate) total_area: f64,
}

impl<'a> Estimation<'a> {
    /// Prepares what every pair needs.
    pub fn new(mesh: &'a Mesh, estimator: Estimator) -> Estimation<'a> {
        let tiled = TiledMesh::new(mesh);
        let estimator: Box<dyn PairEstimator + 'a> = match estimator {
            Estimator::Accurate { tolerance } => Box::new(Accurate::new(&tiled, tolerance)),
            Estimator::Regular { points } => Box::new(Regular::new(&tiled, points)),
            Estimator::MonteCarlo {
                points,
                pairs,
                seed,
            } => Box::new(MonteCarlo::new(mesh, (points, pairs), seed)),
        };
        let areas = estimator.areas(mesh);
        Estimation {
            total_area: areas.iter().sum(),
            areas,
            estimator,
            mesh: tiled,
        }
    }

    /// Hands on the blocks of a tile with some tiles of a group, each with the other tile, but for
    /// those that cannot see it.
    pub(crate) fn for_each_block(
        &self,
        tile: usize,
        (group, others): (&Group, Range<usize>),
        workspace: &mut Workspace,
        mut take: impl FnMut(usize, &TileBlock),
    ) {
        let (mesh, tiles) = (&self.mesh, &self.mesh.tiling.tiles);
        let bound = &tiles[tile].bound;
        let Some(of_group) = mesh.view(&Blockers::Tree, [bound, &group.bound], FEW) else {
            return;
        };
        let mut block = TileBlock::default();
        for other in others {
            // The only tile of a group is all of it.
            let of_tile = match group.tiles.len() {
                1 => Some(of_group.clone()),
                _ => mesh.view(&of_group, [bound, &tiles[other].bound], FEW),
            };
            if let Some(blockers) = &of_tile {
                let pair = TilePair {
                    tile,
                    other,
                    blockers,
                };
                block.clear();
                self.estimator.fill(&mut block, mesh, pair, workspace);
                take(other, &block);
            }
        }
    }

    /// Estimates at least so many pairs, spread over all of them, and throws them away: for
    /// predicting how long [`Estimation::run`] will take. Returns how many pairs they were.
    pub fn time_sample(&self, pairs: u64) -> u64 {
        let Tiling { tiles, groups, .. } = &self.mesh.tiling;
        let run = |k: u64| {
            // The R2 sequence (Roberts 2018) visits the square of pairs evenly.
            let spread = |inverse: f64, size: usize| {
                (((k + 1) as f64 * inverse).fract() * size as f64) as usize
            };
            let tile = spread(0.754_877_666_246_693, tiles.len());
            let group = &groups[spread(0.569_840_290_998_053, groups.len())];
            let others = (group, group.tiles.clone());
            self.for_each_block(tile, others, &mut Workspace::default(), |_, block| {
                std::hint::black_box(block);
            });
            let patches = |tile: &Tile| tile.patches.len() as u64;
            let of_group = tiles[group.tiles.clone()].iter().map(patches);
            patches(&tiles[tile]) * of_group.sum::<u64>()
        };
        let mut done = 0;
        let mut next = 0;
        while done < pairs {
            // More and more at once: at the end of each batch threads wait for the slowest pair.
            let batch = next.max(rayon::current_num_threads() as u64);
            done += (next..next + batch).into_par_iter().map(run).sum::<u64>();
            next += batch;
        }
        done
    }

    /// Estimates all pairs.
    pub fn run(&self) -> FormFactors {
        let size = self.areas.len();
        let mut values = vec![0.0; packed_len(size)];
        let tally = Tally::new(size);
        let all = (0..size, &mut values[..]);
        self.fill(all, 0..self.mesh.tiling.tiles.len(), &tally);
        let matrix = SymmetricMatrix::new(size, values).expect("one value per pair was made");
        self.complete(matrix, &tally)
    }

    /// The next rows after the first so many, if they can be estimated by themselves: the fewest
    /// that have at least so many pairs, or all that are left. `None` if there are none left, or
    /// if the ones before end where no such rows do.
    pub fn next_rows(&self, first: usize, pairs: u64) -> Option<Range<usize>> {
        let row_runs = &self.mesh.tiling.row_runs;
        let start = row_runs.binary_search_by_key(&first, |row_run| row_run.patches.start);
        let ends = row_runs[start.ok()?..]
            .iter()
            .map(|row_run| row_run.patches.end);
        let before = packed_len(first) as u64;
        let mut last = first;
        for end in ends {
            last = end;
            if packed_len(end) as u64 - before >= pairs {
                break;
            }
        }
        Some(first..last)
    }

    /// By patch, the area that exchanges light, in square scene units: for the accurate estimator
    /// without what other faces lie on, and 0 where they cover all.
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// What all rows together make, once all are filled.
    pub fn complete(&self, matrix: SymmetricMatrix, tally: &Tally) -> FormFactors {
        let look = |patch| self.estimator.hemisphere(&self.mesh, patch);
        let patches = (0..self.areas.len()).into_par_iter();
        let hemispheres: Vec<Hemisphere> = patches.map(look).collect();
        let errors = self.tells_errors().then(|| tally.sums());
        FormFactors::new(self.areas.clone(), matrix, errors, &hemispheres)
    }

    /// Whether the estimator knows the errors of its rows.
    pub fn tells_errors(&self) -> bool {
        self.estimator.tells_errors()
    }
}
