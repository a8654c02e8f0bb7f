//! What an estimator finds out about the patches of two tiles, and the trait of estimators.

use crate::accurate::PairEstimate;
use crate::culling::blockers::Blockers;
use crate::hemisphere::{Hemisphere, look_around};
use crate::monte_carlo::Strata;
use crate::regular::RegularWorkspace;
use crate::traversal::tiled_mesh::TiledMesh;
use radiosity_geometry::Mesh;
use radiosity_simd::LANES;

/// An estimator, ready for the patches of a mesh.
pub(crate) trait PairEstimator: Sync {
    /// Finds the exchange of the patches of two tiles that may see each other, in an empty block.
    fn fill(
        &self,
        block: &mut TileBlock,
        mesh: &TiledMesh<'_>,
        tiles: TilePair<'_>,
        workspace: &mut Workspace,
    );

    /// Whether blocks have errors.
    fn tells_errors(&self) -> bool {
        false
    }

    /// By patch, the area that takes part, in square scene units: all of it, but for estimators
    /// that know better.
    fn areas(&self, mesh: &Mesh) -> Vec<f64> {
        mesh.patches.iter().map(|patch| patch.area).collect()
    }

    /// What that area of a patch sees besides fronts.
    fn hemisphere(&self, mesh: &TiledMesh<'_>, patch: usize) -> Hemisphere {
        look_around(&mesh.blockers, &mesh.mesh.patches[patch], [patch, 0])
    }
}

/// Two tiles, and what may stand between them.
#[derive(Clone, Copy)]
pub(crate) struct TilePair<'a> {
    pub(crate) tile: usize,
    pub(crate) other: usize,
    pub(crate) blockers: &'a Blockers,
}

/// What is found out about the patches of a tile and those of another.
#[derive(Default)]
pub(crate) struct TileBlock {
    /// `A_i F_ij` by lane of the tile and lane of the other, in units of the total area.
    pub(crate) values: [[f32; LANES]; LANES],
    /// The same of pairs with their errors, if these are known; the others see nothing of each
    /// other.
    pub(crate) estimates: Vec<([usize; 2], PairEstimate)>,
}

impl TileBlock {
    pub(crate) fn clear(&mut self) {
        self.values = Default::default();
        self.estimates.clear();
    }
}

/// What estimators reuse from tile to tile.
#[derive(Default)]
pub(crate) struct Workspace {
    pub(crate) regular: RegularWorkspace,
    pub(crate) strata: Strata,
}
