//! The regular rule of the university course: all pairs of the fixed points of two patches, eight
//! patches at a time, and all that makes it fast. A plain loop over pairs of points reads in
//! [`monte_carlo`](crate::monte_carlo).

mod blocked_mask;
mod point_sum;
mod reduced_points;
mod tile_points;

use crate::culling::blockers::{AllBlockers, Blockers};
use crate::kernel::kernel;
use crate::traversal::tile_block::{PairEstimator, TileBlock, TilePair, Workspace};
use crate::traversal::tiled_mesh::TiledMesh;
use blocked_mask::{Mark, Over, TileBearings};
use point_sum::{FarPointSum, PointSum, Source};
use radiosity_geometry::{Occluders, SegmentPacket};
use radiosity_simd::{LANES, dispatch};
use rayon::prelude::*;
use std::borrow::Cow;
use tile_points::{Lanes, LocalPoints, TilePoints, Units};

/// So many faces are listed between a patch and a tile, where tiles have too many between them: the
/// rule tries a face on all segments of a pair at once.
const MOST_LISTED: usize = 256;

/// The regular points of all patches.
pub(crate) struct Regular {
    /// By tile.
    samples: Vec<TilePoints>,
    units: Units,
}

/// What is computed once for a pair of tiles, and room for the rest.
#[derive(Default)]
pub(crate) struct RegularWorkspace {
    tiles: Option<[usize; 2]>,
    local: [LocalPoints; 2],
    bearings: [TileBearings; 2],
    sources: Vec<Source>,
    blocked: Vec<u8>,
}

impl PairEstimator for Regular {
    fn fill(
        &self,
        block: &mut TileBlock,
        mesh: &TiledMesh<'_>,
        tiles: TilePair<'_>,
        workspace: &mut Workspace,
    ) {
        let workspace = &mut workspace.regular;
        self.prepare([tiles.tile, tiles.other], workspace);
        let patches = &mesh.tiling.tiles[tiles.tile].patches;
        let is_clear = tiles.blockers.is_clear();
        if is_clear && self.fill_far(&mut block.values, patches.len(), workspace) {
            return;
        }
        for (lane, &i) in patches.iter().enumerate() {
            if let Some(blockers) = blockers_of_patch(mesh, i, tiles) {
                let values = self.exchange(lane, &blockers, &mesh.blockers, workspace);
                for (k, _) in mesh.on_other_walls(i, tiles.other) {
                    block.values[lane][k] = values[k];
                }
            }
        }
    }
}

/// What may stand between a patch and a tile, given what may between both tiles; `None` if they
/// cannot see each other's fronts. These are all that may stand between the tiles, the patch's own
/// wall and what hides all of it included: trying a face on all segments takes no longer than
/// finding out.
fn blockers_of_patch<'b>(
    mesh: &TiledMesh<'_>,
    i: usize,
    tiles: TilePair<'b>,
) -> Option<Cow<'b, Blockers>> {
    let ends = [&mesh.bounds[i], &mesh.tiling.tiles[tiles.other].bound];
    match tiles.blockers {
        Blockers::List(_) => mesh.may_see(ends).then_some(Cow::Borrowed(tiles.blockers)),
        Blockers::Tree => mesh.view(tiles.blockers, ends, MOST_LISTED).map(Cow::Owned),
    }
}

impl Regular {
    pub(crate) fn new(mesh: &TiledMesh<'_>, points: u32) -> Regular {
        let units = Units::of(mesh.mesh);
        let samples = |tile| TilePoints::new(mesh.mesh, &mesh.blockers, tile, points, units);
        Regular {
            samples: mesh.tiling.tiles.par_iter().map(samples).collect(),
            units,
        }
    }

    /// Turns to another pair of tiles.
    pub(crate) fn prepare(&self, [i, j]: [usize; 2], workspace: &mut RegularWorkspace) {
        let near = &self.samples[i];
        let [local_i, local_j] = &mut workspace.local;
        if workspace.tiles.is_none_or(|tiles| tiles[0] != i) {
            workspace.bearings[0].clear();
            near.localize_in(near, local_i);
        }
        workspace.bearings[1].clear();
        self.samples[j].localize_in(near, local_j);
        workspace.tiles = Some([i, j]);
    }

    /// Finds the exchange of the first so many patches of the first tile with each of the second,
    /// with nothing between them and if all are far apart, and tells whether they are.
    fn fill_far(
        &self,
        values: &mut [Lanes<f32>; LANES],
        patches: usize,
        workspace: &mut RegularWorkspace,
    ) -> bool {
        let [from, to] = &workspace.local;
        dispatch(FarPointSum {
            from: (from, patches),
            to,
            sources: &mut workspace.sources,
            values,
        })
    }

    /// The exchange of a patch of the first tile with each of the second, in units of the total
    /// area.
    pub(crate) fn exchange(
        &self,
        lane: usize,
        blockers: &Blockers,
        scene: &AllBlockers,
        workspace: &mut RegularWorkspace,
    ) -> Lanes<f32> {
        self.localize_points(workspace);
        let is_clear = blockers.is_clear();
        if !is_clear {
            self.mark(lane, blockers, scene, workspace);
        }
        let RegularWorkspace {
            local: [from, to],
            sources,
            blocked,
            ..
        } = workspace;
        dispatch(PointSum {
            from: (from, lane),
            to,
            blocked: if is_clear { &[] } else { blocked },
            sources,
        })
    }

    /// Tiles far apart do without.
    fn localize_points(&self, workspace: &mut RegularWorkspace) {
        let Some(tiles) = workspace.tiles else { return };
        let near = &self.samples[tiles[0]];
        for (tile, local) in tiles.into_iter().zip(&mut workspace.local) {
            if local.points.is_empty() {
                self.samples[tile].localize_points_in(near, local);
            }
        }
    }

    /// Marks the segments that are blocked.
    fn mark(
        &self,
        lane: usize,
        blockers: &Blockers,
        scene: &AllBlockers,
        workspace: &mut RegularWorkspace,
    ) {
        let Some(tiles) = workspace.tiles else { return };
        let [i, j] = tiles.map(|tile| &self.samples[tile]);
        let [bearings_i, bearings_j] = &mut workspace.bearings;
        workspace.blocked.clear();
        workspace.blocked.resize(i.points.len() * j.points.len(), 0);
        match blockers {
            Blockers::List(faces) => {
                // Points of almost planar quads may lie beside their own wall.
                for &face in faces.iter().filter(|&&face| face != i.faces[lane]) {
                    let over = Over {
                        blocker: scene.blocker(face),
                        unit: self.units.length,
                        tolerance: scene.occluders.plane_tolerance(),
                    };
                    let own = |lane: usize| u8::from(j.faces[lane] == face) << lane;
                    dispatch(Mark {
                        from: (bearings_i.over(face, &over, i), lane),
                        to: bearings_j.over(face, &over, j),
                        lanes: !(0..LANES).map(own).sum::<u8>(),
                        blocked: &mut workspace.blocked,
                    });
                }
            }
            Blockers::Tree => {
                let occluders = &scene.occluders;
                let marks = workspace.blocked.chunks_exact_mut(i.points.len());
                for (q, marks) in marks.enumerate() {
                    for (p, mark) in marks.iter_mut().enumerate() {
                        *mark = blocked(occluders, (i, p, lane), (j, q), self.units.length);
                    }
                }
            }
        }
    }
}

/// Which of the segments from a point of one patch to those of eight others are blocked.
fn blocked(
    occluders: &Occluders,
    (i, p, lane): (&TilePoints, usize, usize),
    (j, q): (&TilePoints, usize),
    unit: f64,
) -> u8 {
    let from = i.point(p, lane);
    let faces_it = |&to: &usize| kernel(from, i.normal(lane), j.point(q, to), j.normal(to)) > 0.0;
    let wanted = (0..LANES).filter(faces_it).map(|to| 1 << to).sum();
    let bundle = SegmentPacket {
        points: [
            from.to_array().map(|coordinate| [unit * coordinate; LANES]),
            j.points[q]
                .position
                .map(|axis| axis.map(|coordinate| unit * coordinate)),
        ],
        faces: [[i.faces[lane]; LANES], j.faces],
    };
    occluders.blocked_of(&bundle, wanted)
}
