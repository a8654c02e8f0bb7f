//! A mesh as estimators meet it: its patches in tiles, and what may stand between them.

use crate::accurate::line_sampling::MOST_BLOCKERS;
use crate::culling::blockers::{AllBlockers, Blockers};
use crate::culling::convex_bound::ConvexBound;
use crate::traversal::tiles::Tiling;
use radiosity_geometry::{Mesh, Patch};

/// So many faces are listed between two bounds; among more, segments find their way by the tree.
pub(crate) const FEW: usize = MOST_BLOCKERS;

pub(crate) struct TiledMesh<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) tiling: Tiling,
    pub(crate) blockers: AllBlockers,
    /// By patch.
    pub(crate) bounds: Vec<ConvexBound>,
}

impl<'a> TiledMesh<'a> {
    pub(crate) fn new(mesh: &'a Mesh) -> TiledMesh<'a> {
        let blockers = AllBlockers::new(mesh);
        let bound = |patch: &Patch| {
            let face = &mesh.faces[patch.face.index()];
            ConvexBound::on_face(blockers.wall(patch), face, patch.polygon.padded_corners())
        };
        TiledMesh {
            mesh,
            tiling: Tiling::new(mesh, &blockers.walls),
            bounds: mesh.patches.iter().map(bound).collect(),
            blockers,
        }
    }

    /// The patches of a tile that may see one of another, with their lanes: those on other walls.
    pub(crate) fn on_other_walls(
        &self,
        i: usize,
        tile: usize,
    ) -> impl Iterator<Item = (usize, usize)> {
        let wall = |patch: usize| self.blockers.wall(&self.mesh.patches[patch]);
        let tile = &self.tiling.tiles[tile];
        // A tile on one wall would not be in view if the patch were on it, too.
        let on_one_wall = tile.bound.face.is_some();
        let patches = tile.patches.iter().copied().enumerate();
        patches.filter(move |&(_, j)| on_one_wall || wall(j) != wall(i))
    }

    /// What may stand between two bounds, given what may between larger ones around them; `None` if
    /// they cannot see each other's fronts. Of all faces up to `most` are listed.
    pub(crate) fn view(
        &self,
        around: &Blockers,
        ends: [&ConvexBound; 2],
        most: usize,
    ) -> Option<Blockers> {
        match self.may_see(ends) {
            true => self.blockers.narrow(around, ends, most),
            false => None,
        }
    }

    /// Whether a point of each may lie in front of the other.
    pub(crate) fn may_see(&self, [from, to]: [&ConvexBound; 2]) -> bool {
        let same_face = matches!((from.face, to.face), (Some((i, _)), Some((j, _))) if i == j);
        !same_face && from.may_face(to, self.blockers.occluders.plane_tolerance())
    }
}
