//! The accurate estimator, the default: it *integrates* the kernel with nothing in the way, near
//! or far, and *measures* the visible fraction of pairs that something may stand between.

pub(crate) mod contour;
mod error_budget;
mod far_field;
mod gauss;
mod lambert;
pub(crate) mod line_sampling;
mod near_field;
pub(crate) mod patch_quadrature;
mod strata;
mod visible_fraction;

use crate::culling::blocker::Blocker;
use crate::culling::blockers::Blockers;
use crate::hemisphere::{Hemisphere, around_free_part};
use crate::sampling::patch_sampler::PatchSampler;
use crate::sampling::random::Stream;
use crate::tally::Visibility;
use crate::traversal::tile_block::{PairEstimator, TileBlock, TilePair, Workspace};
use crate::traversal::tiled_mesh::{FEW, TiledMesh};
use crate::traversal::tiles::Tile;
use error_budget::ErrorBudget;
use far_field::FarTile;
use line_sampling::{Blocked, Lines};
use patch_quadrature::{PatchQuadrature, Quadratures};
use radiosity_geometry::Mesh;
use radiosity_simd::LANES;
use visible_fraction::{Share, share};

/// The share of a row's tolerance that the unoccluded exchange may use up.
const UNOCCLUDED_SHARE: f64 = 0.02;
/// Seed of all shifts.
const SEED: u64 = 0;

/// Patches, ready for the accurate estimator.
pub(crate) struct Accurate {
    quadratures: Quadratures,
    /// By patch.
    areas: Vec<f64>,
    total_area: f64,
    /// By tile.
    far_tiles: Vec<Option<FarTile>>,
    tolerance: f64,
    budget: ErrorBudget,
}

/// `A_i F_ij` and its standard error, in scene units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairEstimate {
    pub(crate) value: f64,
    pub(crate) error: f64,
    /// By how much the error is larger than it was to be, since there is a limit to samples.
    pub(crate) missed: f64,
    pub(crate) visibility: Visibility,
}

impl PairEstimate {
    /// Of patches with nothing between them.
    pub(crate) fn clear(value: f64, error: f64) -> PairEstimate {
        PairEstimate {
            value,
            error,
            missed: 0.0,
            visibility: Visibility::Clear,
        }
    }
}

impl PairEstimator for Accurate {
    fn fill(
        &self,
        block: &mut TileBlock,
        mesh: &TiledMesh<'_>,
        tiles: TilePair<'_>,
        _workspace: &mut Workspace,
    ) {
        let [tile, other] = [tiles.tile, tiles.other].map(|tile| &mesh.tiling.tiles[tile]);
        for (lane, &i) in tile.patches.iter().enumerate() {
            let ends = [&mesh.bounds[i], &other.bound];
            let Some(blockers) = mesh.view(tiles.blockers, ends, FEW) else {
                continue;
            };
            let far = self.far(i, tiles.other, mesh);
            for (k, j) in mesh.on_other_walls(i, tiles.other) {
                let estimate = self.estimate(mesh, [i, j], far[k], &blockers);
                if let Some(estimate) = estimate.filter(|e| e.value > 0.0 || e.error > 0.0) {
                    block.values[lane][k] = (estimate.value / self.total_area) as f32;
                    block.estimates.push(([lane, k], estimate));
                }
            }
        }
    }

    fn tells_errors(&self) -> bool {
        true
    }

    /// Without what other faces lie on.
    fn areas(&self, _mesh: &Mesh) -> Vec<f64> {
        self.areas.clone()
    }

    fn hemisphere(&self, mesh: &TiledMesh<'_>, patch: usize) -> Hemisphere {
        around_free_part(mesh.mesh, &mesh.blockers, patch)
    }
}

impl Accurate {
    pub(crate) fn new(mesh: &TiledMesh<'_>, tolerance: f64) -> Accurate {
        let quadratures = Quadratures::new(mesh.mesh);
        let far_tile = |tile: &Tile| {
            let patches = tile.patches.iter();
            FarTile::new(&patches.map(|&patch| quadratures.single(patch)).collect())
        };
        let areas = quadratures.areas();
        let mut accurate = Accurate {
            far_tiles: mesh.tiling.tiles.iter().map(far_tile).collect(),
            quadratures,
            total_area: areas.iter().sum(),
            budget: ErrorBudget::new(tolerance, areas.len()),
            areas,
            tolerance,
        };
        accurate.budget = accurate.shared_budget(mesh);
        accurate
    }

    /// The exchange of a pair that may see each other's fronts. `far` is that with nothing between
    /// them, if they are far apart.
    fn estimate(
        &self,
        mesh: &TiledMesh<'_>,
        pair: [usize; 2],
        far: Option<PairEstimate>,
        around: &Blockers,
    ) -> Option<PairEstimate> {
        if far.is_some() && around.is_clear() {
            return far;
        }
        let blockers = mesh.view(around, pair.map(|patch| &mesh.bounds[patch]), FEW)?;
        let unoccluded = far.unwrap_or_else(|| self.near(pair, mesh));
        Some(self.with_blockers(pair, unoccluded, &blockers, mesh))
    }

    /// The exchange of a patch with those of a tile that are far from it, if nothing stood between
    /// them.
    fn far(&self, i: usize, tile: usize, mesh: &TiledMesh<'_>) -> [Option<PairEstimate>; LANES] {
        let error = UNOCCLUDED_SHARE * self.tolerance;
        let tolerance = mesh.blockers.occluders.plane_tolerance();
        match (self.quadratures.single(i), &self.far_tiles[tile]) {
            (Some(patch), Some(tile)) => far_field::exchange(patch, tile, error, tolerance),
            _ => [None; LANES],
        }
    }

    /// The exchange of a pair of patches, if nothing stood between them.
    fn near(&self, pair: [usize; 2], mesh: &TiledMesh<'_>) -> PairEstimate {
        let tolerance = mesh.blockers.occluders.plane_tolerance();
        let pieces = self.pieces(pair);
        let exchanges = pieces.map(|[i, j]| near_field::exchange(i, j, tolerance));
        exchanges.fold(PairEstimate::clear(0.0, 0.0), |sum, exchange| {
            PairEstimate::clear(sum.value + exchange.value, sum.error + exchange.error)
        })
    }

    /// All pieces of a patch with all of another.
    fn pieces(&self, [i, j]: [usize; 2]) -> impl Iterator<Item = [&PatchQuadrature; 2]> {
        let (of_i, of_j) = (self.quadratures.of(i), self.quadratures.of(j));
        of_i.iter()
            .flat_map(move |i| of_j.iter().map(move |j| [i, j]))
    }

    /// The exchange of a pair of patches, with this between them.
    fn with_blockers(
        &self,
        pair: [usize; 2],
        unoccluded: PairEstimate,
        blockers: &Blockers,
        mesh: &TiledMesh<'_>,
    ) -> PairEstimate {
        let clear = unoccluded.value;
        if clear == 0.0 {
            return unoccluded;
        }
        let scene = &mesh.blockers;
        let walls = pair.map(|patch| scene.wall(&mesh.mesh.patches[patch]));
        let listed: Vec<Blocker>;
        let blocked = match blockers {
            Blockers::List(faces) if faces.is_empty() => return unoccluded,
            Blockers::List(faces) => {
                listed = faces.iter().map(|&f| *scene.blocker(f)).collect();
                Blocked::List(&listed)
            }
            Blockers::Tree => Blocked::Tree(&scene.occluders, walls),
        };
        let tolerance = scene.occluders.plane_tolerance();
        let ends = pair.map(|patch| (patch, self.areas[patch]));
        // The same for all pieces: what they may add to the error goes by what they add.
        let wanted = self.budget.of_pair(ends, clear) / clear;
        let is_whole = pair.map(|patch| self.quadratures.single(patch).is_some()) == [true; 2];
        let mut sum = PairEstimate {
            value: 0.0,
            visibility: Visibility::Partial,
            ..unoccluded
        };
        for (piece, elements) in self.pieces(pair).enumerate() {
            let clear = match is_whole {
                true => clear,
                false => near_field::exchange(elements[0], elements[1], tolerance).value,
            };
            if clear > 0.0 {
                let stream = Stream::of_pair(SEED + piece as u64, pair[0], pair[1]);
                let share = visible(elements, &blocked, (stream, wanted), tolerance);
                sum.value += share.value * clear;
                sum.error += share.error * clear;
                sum.missed += share.missed * clear;
            }
        }
        sum
    }
}

/// The visible share of a pair, as the points of the smaller element see the larger one.
fn visible(
    [i, j]: [&PatchQuadrature; 2],
    blocked: &Blocked<'_>,
    (stream, wanted): (Stream, f64),
    tolerance: f64,
) -> Share {
    let (from, across) = if i.area() < j.area() { (i, j) } else { (j, i) };
    let Some(corners) = across.clip(from.corners(), tolerance) else {
        // One lies in the plane of the other, up to rounding.
        return Share::UNKNOWN;
    };
    let lines = Lines::new(
        (&corners, from.normal),
        PatchSampler::new(&across.polygon, across.normal),
        blocked,
    );
    share(&lines, stream, wanted)
}
