//! The walk from a tile and a group of tiles down to single pairs, and what each estimator makes of
//! them.

use crate::accurate::{Accurate, PairEstimate};
use crate::estimate::{Estimation, Method, Room};
use crate::lines::MOST_BLOCKERS;
use crate::obstacles::Between;
use crate::part::Part;
use crate::tiles::{Group, Tile};
use std::borrow::Cow;
use std::ops::Range;

/// So many faces are listed between two parts; among more, segments find their way by the tree.
pub(crate) const FEW: usize = MOST_BLOCKERS;
/// So many for the regular rule, which tries a face on all segments of a pair at once, where tiles
/// have too many between them.
const MANY: usize = 256;

/// What is found out about a patch and some others, often a single one.
pub(crate) struct TileBlock<'a> {
    pub(crate) others: &'a [usize],
    /// `A_i F_ij` with each of them, in units of the total area.
    pub(crate) values: &'a [f32],
    /// The same of a pair with its error, if that is known.
    pub(crate) estimate: Option<PairEstimate>,
}

impl<'a> TileBlock<'a> {
    fn plain(others: &'a [usize], values: &'a [f32]) -> TileBlock<'a> {
        TileBlock {
            others,
            values,
            estimate: None,
        }
    }
}

impl Estimation<'_> {
    /// Estimates the exchange of some patches of a tile, by their lanes, with those of some tiles
    /// of a group; tells of those that may not be zero: the lane, and what is found out.
    pub(crate) fn against(
        &self,
        (tile, lanes): (usize, Range<usize>),
        (group, others): (&Group, Range<usize>),
        room: &mut Room,
        tell: &mut impl FnMut(usize, TileBlock<'_>),
    ) {
        let tiles = &self.tiling.tiles;
        let part = &tiles[tile].part;
        let Some(between) = self.view(&Between::Many, [part, &group.part], FEW) else {
            return;
        };
        for other in others {
            // The only tile of a group is all of it.
            let narrowed = match group.tiles.len() {
                1 => Some(between.clone()),
                _ => self.view(&between, [part, &tiles[other].part], FEW),
            };
            if let Some(between) = narrowed {
                self.against_tile((tile, lanes.clone()), other, &between, room, tell);
            }
        }
    }

    /// The same with those of a tile, given what may stand between both tiles.
    fn against_tile(
        &self,
        (tile, lanes): (usize, Range<usize>),
        other: usize,
        between: &Between,
        room: &mut Room,
        tell: &mut impl FnMut(usize, TileBlock<'_>),
    ) {
        let [Tile { patches, .. }, others] = [tile, other].map(|tile| &self.tiling.tiles[tile]);
        if let Method::Regular(regular) = &self.method {
            regular.prepare([tile, other], &mut room.regular);
            if between.is_clear()
                && let Some(values) = regular.exchange_far(&lanes, &mut room.regular)
            {
                for lane in lanes {
                    tell(lane, TileBlock::plain(&others.patches, &values[lane]));
                }
                return;
            }
        }
        for lane in lanes {
            let i = patches[lane];
            if let Some(between) = self.view_of_patch(between, [&self.parts[i], &others.part]) {
                self.exchange((i, lane), other, &between, room, tell);
            }
        }
    }

    /// What may stand between a patch and a tile, given what may between both tiles; `None` if they
    /// cannot see each other's fronts. For the regular rule these are all that may stand between
    /// the tiles, the patch's own wall and what hides all of it included: trying a face on all
    /// segments takes no longer than finding out.
    fn view_of_patch<'b>(
        &self,
        between: &'b Between,
        ends: [&Part; 2],
    ) -> Option<Cow<'b, Between>> {
        let most = match (&self.method, between) {
            (Method::Regular(_), Between::Few(_)) => {
                return self.may_see(ends).then_some(Cow::Borrowed(between));
            }
            (Method::Regular(_), _) => MANY,
            (Method::MonteCarlo(_) | Method::Accurate(_), _) => FEW,
        };
        self.view(between, ends, most).map(Cow::Owned)
    }

    /// What may stand between two parts, given what may between larger ones around them; `None` if
    /// they cannot see each other's fronts.
    pub(crate) fn view(&self, between: &Between, ends: [&Part; 2], most: usize) -> Option<Between> {
        if !self.may_see(ends) {
            return None;
        }
        self.obstacles.narrow(between, ends, most)
    }

    /// Whether a point of each may lie in front of the other.
    fn may_see(&self, [from, to]: [&Part; 2]) -> bool {
        let same_face = matches!((from.face, to.face), (Some((i, _)), Some((j, _))) if i == j);
        !same_face && from.may_face(to, self.obstacles.occluders.plane_tolerance())
    }

    /// Estimates the exchange of a patch with those of a tile.
    fn exchange(
        &self,
        (i, lane): (usize, usize),
        tile: usize,
        between: &Between,
        room: &mut Room,
        tell: &mut impl FnMut(usize, TileBlock<'_>),
    ) {
        let patches = &self.mesh.patches;
        let wall = |patch: usize| self.obstacles.wall(&patches[patch]);
        let tiles = &self.tiling.tiles;
        // A tile on one wall would not be in view if the patch were on it, too.
        let on_one_wall = tiles[tile].part.face.is_some();
        let others = tiles[tile].patches.iter().copied().enumerate();
        let others = others.filter(|&(_, j)| on_one_wall || wall(j) != wall(i));
        match &self.method {
            Method::Regular(regular) => {
                let values = regular.exchange(lane, between, &self.obstacles, &mut room.regular);
                match on_one_wall {
                    true => tell(lane, TileBlock::plain(&tiles[tile].patches, &values)),
                    false => {
                        others.for_each(|(k, j)| tell(lane, TileBlock::plain(&[j], &[values[k]])));
                    }
                }
            }
            Method::MonteCarlo(monte_carlo) => {
                for (_, j) in others {
                    let ends = [(i, &patches[i]), (j, &patches[j])];
                    let value = monte_carlo.estimate(ends, &mut room.strata, |p, q| {
                        !between.cuts(&self.obstacles.occluders, (wall(i), p), (wall(j), q))
                    });
                    tell(lane, TileBlock::plain(&[j], &[(value * self.scale) as f32]));
                }
            }
            Method::Accurate(accurate) => {
                let far = accurate.far(i, tile, &self.obstacles);
                for (k, j) in others {
                    let exchange = self.accurate(accurate, [i, j], far[k], between);
                    if let Some(exchange) = exchange.filter(|e| e.value > 0.0 || e.error > 0.0) {
                        let told = TileBlock {
                            others: &[j],
                            values: &[(exchange.value * self.scale) as f32],
                            estimate: Some(exchange),
                        };
                        tell(lane, told);
                    }
                }
            }
        }
    }

    /// The exchange of a pair that sees each other's fronts. `far` is that with nothing between
    /// them, if they are far apart.
    fn accurate(
        &self,
        accurate: &Accurate<'_>,
        pair: [usize; 2],
        far: Option<PairEstimate>,
        between: &Between,
    ) -> Option<PairEstimate> {
        if far.is_some() && between.is_clear() {
            return far;
        }
        let between = self.view(between, pair.map(|patch| &self.parts[patch]), FEW)?;
        let unoccluded = far.unwrap_or_else(|| accurate.near(pair, &self.obstacles));
        Some(accurate.past(pair, unoccluded, &between, &self.obstacles))
    }
}
