//! The regular rule: all pairs of the fixed points of two patches, eight patches at a time.

use crate::exchange::kernel;
use crate::obstacles::{Between, Obstacles};
use crate::samples::{Lanes, Local, Samples, Units};
use crate::shade::{Mark, Over, Shade};
use crate::tiles::Tiling;
use crate::transfer::{FarTransfer, Source, Transfer};
use radiosity_geometry::{Bundle, Mesh, Occluders};
use radiosity_simd::{Kernel, LANES, Simd, dispatch};
use rayon::prelude::*;
use std::ops::Range;

/// The regular points of all patches.
pub(crate) struct Regular {
    /// By tile.
    samples: Vec<Samples>,
    units: Units,
}

/// What is computed once for a pair of tiles, and room for the rest.
#[derive(Default)]
pub(crate) struct Scratch {
    tiles: Option<[usize; 2]>,
    local: [Local; 2],
    shades: [Shade; 2],
    sources: Vec<Source>,
    blocked: Vec<u8>,
}

impl Regular {
    pub(crate) fn new(mesh: &Mesh, obstacles: &Obstacles, tiling: &Tiling, points: u32) -> Regular {
        let units = Units::of(mesh);
        let samples = |tile| Samples::new(mesh, obstacles, tile, points, units);
        Regular {
            samples: tiling.tiles.par_iter().map(samples).collect(),
            units,
        }
    }

    /// Turns to another pair of tiles.
    pub(crate) fn prepare(&self, [i, j]: [usize; 2], scratch: &mut Scratch) {
        let near = &self.samples[i];
        let [local_i, local_j] = &mut scratch.local;
        if scratch.tiles.is_none_or(|tiles| tiles[0] != i) {
            scratch.shades[0].clear();
            dispatch(Localize(near, near, local_i));
        }
        scratch.shades[1].clear();
        dispatch(Localize(&self.samples[j], near, local_j));
        scratch.tiles = Some([i, j]);
    }

    /// The exchange of patches of the first tile with each of the second, with nothing between them
    /// and if all are far apart.
    pub(crate) fn exchange_far(
        &self,
        lanes: &Range<usize>,
        scratch: &mut Scratch,
    ) -> Option<[Lanes<f32>; LANES]> {
        let [from, to] = &scratch.local;
        dispatch(FarTransfer {
            from: (from, lanes),
            to,
            sources: &mut scratch.sources,
        })
    }

    /// The exchange of a patch of the first tile with each of the second, in units of the total
    /// area.
    pub(crate) fn exchange(
        &self,
        lane: usize,
        between: &Between,
        obstacles: &Obstacles,
        scratch: &mut Scratch,
    ) -> Lanes<f32> {
        self.localize_points(scratch);
        let is_clear = between.is_clear();
        if !is_clear {
            self.mark(lane, between, obstacles, scratch);
        }
        let Scratch {
            local: [from, to],
            sources,
            blocked,
            ..
        } = scratch;
        dispatch(Transfer {
            from: (from, lane),
            to,
            blocked: if is_clear { &[] } else { blocked },
            sources,
        })
    }

    /// Tiles far apart do without.
    fn localize_points(&self, scratch: &mut Scratch) {
        let Some(tiles) = scratch.tiles else { return };
        let near = &self.samples[tiles[0]];
        for (tile, local) in tiles.into_iter().zip(&mut scratch.local) {
            if local.points.is_empty() {
                dispatch(LocalizePoints(&self.samples[tile], near, local));
            }
        }
    }

    /// Marks the segments that are blocked.
    fn mark(&self, lane: usize, between: &Between, obstacles: &Obstacles, scratch: &mut Scratch) {
        let Some(tiles) = scratch.tiles else { return };
        let [i, j] = tiles.map(|tile| &self.samples[tile]);
        let [shade_i, shade_j] = &mut scratch.shades;
        scratch.blocked.clear();
        scratch.blocked.resize(i.points.len() * j.points.len(), 0);
        match between {
            Between::Few(faces) => {
                // Points of almost planar quads may lie beside their own wall.
                for &face in faces.iter().filter(|&&face| face != i.faces[lane]) {
                    let over = Over {
                        blocker: obstacles.blocker(face),
                        unit: self.units.length,
                        tolerance: obstacles.occluders.plane_tolerance(),
                    };
                    let own = |lane: usize| u8::from(j.faces[lane] == face) << lane;
                    dispatch(Mark {
                        from: (shade_i.bearings(face, &over, i), lane),
                        to: shade_j.bearings(face, &over, j),
                        lanes: !(0..LANES).map(own).sum::<u8>(),
                        blocked: &mut scratch.blocked,
                    });
                }
            }
            Between::Many => {
                let occluders = &obstacles.occluders;
                let marks = scratch.blocked.chunks_exact_mut(i.points.len());
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
    (i, p, lane): (&Samples, usize, usize),
    (j, q): (&Samples, usize),
    unit: f64,
) -> u8 {
    let from = i.point(p, lane);
    let faces_it = |&to: &usize| kernel(from, i.normal(lane), j.point(q, to), j.normal(to)) > 0.0;
    let wanted = (0..LANES).filter(faces_it).map(|to| 1 << to).sum();
    let bundle = Bundle {
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

/// All of samples but their points, relative to others.
struct Localize<'a>(&'a Samples, &'a Samples, &'a mut Local);

impl Kernel for Localize<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Localize(samples, near, local) = self;
        samples.localize(simd, near, local);
    }
}

/// The points of samples, relative to others.
struct LocalizePoints<'a>(&'a Samples, &'a Samples, &'a mut Local);

impl Kernel for LocalizePoints<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let LocalizePoints(samples, near, local) = self;
        samples.localize_points(simd, near, local);
    }
}
