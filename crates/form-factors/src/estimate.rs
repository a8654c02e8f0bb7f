//! Stage 2: the walk over all pairs, and what each estimator makes of them.
//!
//! Patches are met in tiles of eight. What may stand between two tiles is narrowed down on the
//! way from groups of tiles to single patches, so most pairs cost no visibility test at all.
//! Tiles of rows are filled in parallel; each entry depends on its pair alone, so the result is
//! the same for any number of threads.

use crate::accurate::{Accurate, Exchange};
use crate::fixed::FixedSums;
use crate::monte_carlo::{MonteCarlo, Strata};
use crate::obstacles::{Between, Obstacles};
use crate::part::Part;
use crate::regular::{Regular, Scratch};
use crate::surroundings::{Surroundings, look_around};
use crate::tiles::{Group, Tile, Tiling};
use crate::{Estimator, FormFactors};
use radiosity_geometry::{Mesh, Patch};
use radiosity_matrix::{SymmetricMatrix, packed_len, row_blocks_mut};
use rayon::prelude::*;

/// Estimates all form factors of a mesh. `progress` is told how many further pairs are done,
/// from any thread.
pub fn estimate(mesh: &Mesh, estimator: Estimator, progress: &(dyn Fn(u64) + Sync)) -> FormFactors {
    Estimation::new(mesh, estimator).run(progress)
}

/// [`estimate`] in two steps, with a rehearsal between them.
pub struct Estimation<'a> {
    mesh: &'a Mesh,
    /// By patch.
    parts: Vec<Part>,
    tiling: Tiling,
    obstacles: Obstacles,
    method: Method<'a>,
    scale: f64,
}

/// The estimator with what it prepares.
enum Method<'a> {
    Regular(Regular),
    MonteCarlo(MonteCarlo),
    Accurate(Accurate<'a>),
}

/// So many faces are listed between parts that will be looked at more closely, and at last.
const FEW: usize = 64;
const MANY: usize = 1024;

/// What the estimators reuse from pair to pair.
#[derive(Default)]
struct Room {
    regular: Scratch,
    strata: Strata,
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
            Estimator::Accurate { tolerance } => Method::Accurate(Accurate::new(mesh, tolerance)),
        };
        let part = |patch: &Patch| {
            let face = &mesh.faces[patch.face.index()];
            Part::on_face(obstacles.wall(patch), face, patch.polygon.padded_corners())
        };
        Estimation {
            mesh,
            parts: mesh.patches.iter().map(part).collect(),
            tiling,
            obstacles,
            method,
            scale: 1.0 / mesh.total_area(),
        }
    }

    /// Estimates at least so many pairs, spread over all of them, and throws them away: for
    /// predicting how long [`Estimation::run`] will take. Returns how many pairs they were.
    pub fn rehearse(&self, pairs: u64) -> u64 {
        let Tiling { tiles, groups } = &self.tiling;
        let run = |k: u64| {
            // The R2 sequence (Roberts 2018) visits the square of pairs evenly.
            let spread = |inverse: f64, size: usize| {
                (((k + 1) as f64 * inverse).fract() * size as f64) as usize
            };
            let tile = spread(0.754_877_666_246_693, tiles.len());
            let group = &groups[spread(0.569_840_290_998_053, groups.len())];
            let mut sum = 0.0;
            let mut room = Room::default();
            let add = |_, _, value: f32, _| sum += value;
            self.against(tile, group, &mut room, &mut { add });
            std::hint::black_box(sum);
            let patches = |tile: &Tile| tile.patches.len() as u64;
            let of_group = tiles[group.tiles.clone()].iter().map(patches);
            patches(&tiles[tile]) * of_group.sum::<u64>()
        };
        let mut done = 0;
        let mut next = 0;
        while done < pairs {
            let batch = rayon::current_num_threads() as u64;
            done += (next..next + batch).into_par_iter().map(run).sum::<u64>();
            next += batch;
        }
        done
    }

    /// Estimates all pairs. `progress` is told how many further pairs are done, from any thread.
    pub fn run(&self, progress: &(dyn Fn(u64) + Sync)) -> FormFactors {
        let size = self.mesh.patches.len();
        let mut values = vec![0.0; packed_len(size)];
        let errors = FixedSums::new(size);
        self.rows_of_tiles(&mut values)
            .into_par_iter()
            .enumerate()
            .for_each_init(Room::default, |room, (tile, mut rows)| {
                self.fill(tile, &mut rows, room, &errors);
                progress(rows.iter().map(|row| row.len() as u64).sum());
            });
        let areas = self.mesh.patches.iter().map(|patch| patch.area).collect();
        let exchange = SymmetricMatrix::new(size, values).expect("one value per pair was made");
        let errors = match self.method {
            Method::Accurate(_) => Some(errors.into_sums()),
            Method::Regular(_) | Method::MonteCarlo(_) => None,
        };
        let look = |patch| look_around(self.mesh, &self.obstacles, patch);
        let surroundings: Vec<Surroundings> = (0..size).into_par_iter().map(look).collect();
        FormFactors::new(areas, exchange, errors.as_deref(), &surroundings)
    }

    /// The entries `(i, 0 .. i)` of the patches of each tile.
    fn rows_of_tiles<'v>(&self, values: &'v mut [f32]) -> Vec<Vec<&'v mut [f32]>> {
        let rows = row_blocks_mut(self.mesh.patches.len(), values, 1);
        let mut rows: Vec<_> = rows.into_iter().map(|(_, row)| row).collect();
        let tiles = self.tiling.tiles.iter();
        let mut take = |&patch: &usize| std::mem::take(&mut rows[patch]);
        tiles
            .map(|tile| tile.patches.iter().map(&mut take).collect())
            .collect()
    }

    /// Fills the zeroed rows of a tile, and adds the errors of the factors to those of both rows.
    fn fill(&self, tile: usize, rows: &mut [&mut [f32]], room: &mut Room, errors: &FixedSums) {
        let patches = &self.tiling.tiles[tile].patches;
        let area = |patch: usize| self.mesh.patches[patch].area;
        let mut tell = |lane: usize, j: usize, value: f32, error: f64| {
            // Only small faces share their tile with patches that come after.
            if let Some(entry) = rows[lane].get_mut(j) {
                *entry = value;
                if error > 0.0 {
                    let i = patches[lane];
                    errors.add(i, error / area(i));
                    errors.add(j, error / area(j));
                }
            }
        };
        let groups = self.tiling.groups.iter();
        for group in groups.take_while(|group| group.tiles.start <= tile) {
            self.against(tile, group, room, &mut tell);
        }
    }

    /// Estimates the exchange of the patches of a tile with those of a group; tells those that may
    /// not be zero: lane, index, the exchange in units of the total area, its error in scene units.
    fn against(
        &self,
        tile: usize,
        group: &Group,
        room: &mut Room,
        tell: &mut impl FnMut(usize, usize, f32, f64),
    ) {
        let tiles = &self.tiling.tiles;
        let part = &tiles[tile].part;
        // Accurate pairs have a list of their own.
        let most = match self.method {
            Method::Regular(_) | Method::MonteCarlo(_) => MANY,
            Method::Accurate(_) => FEW,
        };
        let Some(between) = self.view(&Between::Many, [part, &group.part], FEW) else {
            return;
        };
        for other in group.tiles.clone() {
            let part_j = &tiles[other].part;
            // The only tile of a group is all of it.
            let narrowed = match group.tiles.len() {
                1 => Some(between.clone()),
                _ => self.view(&between, [part, part_j], FEW),
            };
            let Some(between) = narrowed else { continue };
            if let Method::Regular(regular) = &self.method {
                regular.prepare([tile, other], &mut room.regular);
            }
            for (lane, &i) in tiles[tile].patches.iter().enumerate() {
                if let Some(between) = self.view(&between, [&self.parts[i], part_j], most) {
                    self.exchange((i, lane), &tiles[other], &between, room, tell);
                }
            }
        }
    }

    /// What may stand between two parts, given what may between larger ones around them; `None` if
    /// they cannot see each other's fronts.
    fn view(&self, between: &Between, ends: [&Part; 2], most: usize) -> Option<Between> {
        let [from, to] = ends;
        let same_face = matches!((from.face, to.face), (Some((i, _)), Some((j, _))) if i == j);
        if same_face || !from.may_face(to, self.obstacles.occluders.plane_tolerance()) {
            return None;
        }
        self.obstacles.narrow(between, ends, most)
    }

    /// Estimates the exchange of a patch with those of a tile.
    fn exchange(
        &self,
        (i, lane): (usize, usize),
        tile: &Tile,
        between: &Between,
        room: &mut Room,
        tell: &mut impl FnMut(usize, usize, f32, f64),
    ) {
        let patches = &self.mesh.patches;
        let wall = |patch: usize| self.obstacles.wall(&patches[patch]);
        let others = tile.patches.iter().copied();
        let others = others.enumerate().filter(|&(_, j)| wall(j) != wall(i));
        match &self.method {
            Method::Regular(regular) => {
                let values = regular.exchange(lane, between, &self.obstacles, &mut room.regular);
                others.for_each(|(k, j)| tell(lane, j, values[k], 0.0));
            }
            Method::MonteCarlo(monte_carlo) => {
                for (_, j) in others {
                    let ends = [(i, &patches[i]), (j, &patches[j])];
                    let value = monte_carlo.estimate(ends, &mut room.strata, |p, q| {
                        !between.cuts(&self.obstacles.occluders, (wall(i), p), (wall(j), q))
                    });
                    tell(lane, j, (value * self.scale) as f32, 0.0);
                }
            }
            Method::Accurate(accurate) => {
                for (_, j) in others {
                    let parts = [&self.parts[i], &self.parts[j]];
                    if let Some(between) = self.view(between, parts, MANY) {
                        let exchange = accurate.exchange([i, j], &between, &self.obstacles);
                        let Exchange { value, error } = exchange;
                        tell(lane, j, (value * self.scale) as f32, error);
                    }
                }
            }
        }
    }
}
