//! Stage 2: all rows, or some of them at a time.
//!
//! Patches are met in tiles of eight. What may stand between two tiles is narrowed down on the
//! way from groups of tiles to single patches, or for the regular rule to tiles (`pairs.rs`), so
//! most pairs cost no visibility test at all. Tiles of rows are filled in parallel; each entry
//! depends on its pair alone, so the result is the same for any number of threads.

use crate::accurate::Accurate;
use crate::monte_carlo::{MonteCarlo, Strata};
use crate::obstacles::Obstacles;
use crate::pairs::TileBlock;
use crate::part::Part;
use crate::regular::{Regular, Scratch};
use crate::surroundings::{Surroundings, around_free_part, look_around};
use crate::tally::Tally;
use crate::tiles::{Tile, Tiling};
use crate::{Closure, Estimator, FormFactors, Params};
use radiosity_geometry::{Mesh, Patch};
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
    pub(crate) mesh: &'a Mesh,
    /// By patch.
    pub(crate) parts: Vec<Part>,
    pub(crate) tiling: Tiling,
    pub(crate) obstacles: Obstacles,
    pub(crate) method: Method<'a>,
    /// By patch, the area that exchanges light.
    pub(crate) areas: Vec<f64>,
    pub(crate) scale: f64,
}

/// The estimator with what it prepares.
pub(crate) enum Method<'a> {
    Regular(Regular),
    MonteCarlo(MonteCarlo),
    Accurate(Accurate<'a>),
}

/// What the estimators reuse from pair to pair.
#[derive(Default)]
pub(crate) struct Room {
    pub(crate) regular: Scratch,
    pub(crate) strata: Strata,
}

impl<'a> Estimation<'a> {
    /// Prepares what every pair needs.
    pub fn new(mesh: &'a Mesh, estimator: Estimator) -> Estimation<'a> {
        let obstacles = Obstacles::new(mesh);
        let tiling = Tiling::new(mesh, &obstacles.walls);
        let method = match estimator {
            Estimator::Regular { points } => {
                Method::Regular(Regular::new(mesh, &obstacles, &tiling, points))
            }
            Estimator::MonteCarlo {
                points,
                pairs,
                seed,
            } => Method::MonteCarlo(MonteCarlo::new(points, pairs, seed)),
            Estimator::Accurate { tolerance } => {
                Method::Accurate(Accurate::new(mesh, &tiling, tolerance))
            }
        };
        let part = |patch: &Patch| {
            let face = &mesh.faces[patch.face.index()];
            Part::on_face(obstacles.wall(patch), face, patch.polygon.padded_corners())
        };
        let areas = match &method {
            Method::Accurate(accurate) => accurate.areas(),
            Method::Regular(_) | Method::MonteCarlo(_) => {
                mesh.patches.iter().map(|patch| patch.area).collect()
            }
        };
        let mut estimation = Estimation {
            mesh,
            parts: mesh.patches.iter().map(part).collect(),
            tiling,
            obstacles,
            method,
            scale: 1.0 / areas.iter().sum::<f64>(),
            areas,
        };
        let budget = match (&estimation.method, estimator) {
            (Method::Accurate(accurate), Estimator::Accurate { tolerance }) => {
                Some(estimation.budget(accurate, tolerance))
            }
            _ => None,
        };
        if let (Method::Accurate(accurate), Some(budget)) = (&mut estimation.method, budget) {
            accurate.budget = budget;
        }
        estimation
    }

    /// Estimates at least so many pairs, spread over all of them, and throws them away: for
    /// predicting how long [`Estimation::run`] will take. Returns how many pairs they were.
    pub fn time_sample(&self, pairs: u64) -> u64 {
        let Tiling { tiles, groups, .. } = &self.tiling;
        let run = |k: u64| {
            // The R2 sequence (Roberts 2018) visits the square of pairs evenly.
            let spread = |inverse: f64, size: usize| {
                (((k + 1) as f64 * inverse).fract() * size as f64) as usize
            };
            let tile = spread(0.754_877_666_246_693, tiles.len());
            let group = &groups[spread(0.569_840_290_998_053, groups.len())];
            let mut sum = 0.0;
            let mut room = Room::default();
            let add = |_, told: TileBlock<'_>| sum += told.values.iter().sum::<f32>();
            let patches = |tile: &Tile| tile.patches.len() as u64;
            let lanes = 0..tiles[tile].patches.len();
            self.against(
                (tile, lanes),
                (group, group.tiles.clone()),
                &mut room,
                &mut { add },
            );
            std::hint::black_box(sum);
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
        let size = self.mesh.patches.len();
        let mut values = vec![0.0; packed_len(size)];
        let tally = Tally::new(size);
        let all = (0..size, &mut values[..]);
        self.fill(all, 0..self.tiling.tiles.len(), &tally);
        let matrix = SymmetricMatrix::new(size, values).expect("one value per pair was made");
        self.complete(matrix, &tally)
    }

    /// The next rows after the first so many, if they can be estimated by themselves: the fewest
    /// that have at least so many pairs, or all that are left. `None` if there are none left, or
    /// if the ones before end where no such rows do.
    pub fn next_rows(&self, first: usize, pairs: u64) -> Option<Range<usize>> {
        let strips = &self.tiling.strips;
        let start = strips.binary_search_by_key(&first, |strip| strip.patches.start);
        let ends = strips[start.ok()?..].iter().map(|strip| strip.patches.end);
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
        let look = |patch| match self.method {
            Method::Accurate(_) => around_free_part(self.mesh, &self.obstacles, patch),
            Method::Regular(_) | Method::MonteCarlo(_) => {
                look_around(&self.obstacles, &self.mesh.patches[patch], [patch, 0])
            }
        };
        let patches = 0..self.mesh.patches.len();
        let surroundings: Vec<Surroundings> = patches.into_par_iter().map(look).collect();
        let errors = self.tells_errors().then(|| tally.sums());
        FormFactors::new(self.areas.clone(), matrix, errors, &surroundings)
    }

    /// Whether the estimator knows the errors of its rows.
    pub fn tells_errors(&self) -> bool {
        match self.method {
            Method::Accurate(_) => true,
            Method::Regular(_) | Method::MonteCarlo(_) => false,
        }
    }
}
