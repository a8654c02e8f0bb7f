//! What a patch sees that is no front: backs of faces, and nothing at all.
//!
//! Measured by rays, independently of the factors: together they account for everything that a
//! patch sees.
//!
//! Long because: what rays are drawn, traced and counted for is one loop.

pub(crate) mod front_walls;
mod hidden_part;

use crate::accurate::patch_quadrature::free_pieces;
use crate::culling::blockers::AllBlockers;
use crate::hemisphere::front_walls::{FirstHits, FrontWalls};
use crate::hemisphere::hidden_part::{PatchCell, Starts, by_cell, is_suspicious, visible_share};
use crate::sampling::lattice::{Block, Lattice, ratio};
use crate::sampling::patch_sampler::{PatchSampler, SamplePoints, points};
use crate::sampling::random::Stream;
use radiosity_geometry::{DVec3, FaceId, Mesh, Patch, Ray};
use radiosity_simd::{Float, Kernel, LANES, Simd, dispatch};
use std::f32::consts::FRAC_PI_4;

/// How closely one looks.
#[derive(Clone, Copy)]
struct Effort {
    /// Rays from the patch, under each of eight shifts. A power of two.
    rays: usize,
    /// Cells along each edge of the patch of which one tells whether they are hidden.
    cells: usize,
}

const FIRST_LOOK: Effort = Effort { rays: 32, cells: 4 };
/// For patches of which a part may be hidden.
const CLOSE_LOOK: Effort = Effort {
    rays: 256,
    cells: 8,
};
/// Tells these shifts from those of pairs of patches.
const SEED: u64 = 1;

/// Shares of all that a patch sees, by form factor. Faces without patches count as backs, from
/// either side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hemisphere {
    pub(crate) backs: f64,
    pub(crate) background: f64,
    /// Standard error of their sum.
    pub(crate) error: f64,
    /// See [`RowFacts::visible`](crate::RowFacts::visible).
    pub(crate) visible: f64,
}

/// By shift: the weights of all rays, of those that met backs, and of those that met nothing.
struct Sums {
    all: [f64; LANES],
    backs: [f64; LANES],
    background: [f64; LANES],
    cells: Vec<PatchCell>,
}

impl Hemisphere {
    /// Of a patch that other faces cover: it sees nothing but their backs.
    const COVERED: Hemisphere = Hemisphere {
        backs: 1.0,
        background: 0.0,
        error: 0.0,
        visible: 0.0,
    };
}

/// Looks around from what no other face lies on of the patch of this index.
pub(crate) fn around_free_part(mesh: &Mesh, obstacles: &AllBlockers, index: usize) -> Hemisphere {
    let pieces = free_pieces(mesh, &mesh.patches[index]);
    if pieces.is_empty() {
        return Hemisphere::COVERED;
    }
    let area: f64 = pieces.iter().map(|piece| piece.area).sum();
    let mut sum = Hemisphere {
        backs: 0.0,
        ..Hemisphere::COVERED
    };
    for (k, piece) in pieces.iter().enumerate() {
        let (found, weight) = (look_around(obstacles, piece, [index, k]), piece.area / area);
        sum.backs += weight * found.backs;
        sum.background += weight * found.background;
        sum.error = sum.error.hypot(weight * found.error);
        sum.visible += weight * found.visible;
    }
    sum
}

/// Looks around from a patch, or a piece of it, of these indices.
pub(crate) fn look_around(
    obstacles: &AllBlockers,
    patch: &Patch,
    [index, piece]: [usize; 2],
) -> Hemisphere {
    let ahead = FrontWalls::of(patch, obstacles);
    let look = |effort: Effort| {
        let mut stream = Stream::of_pair(SEED + piece as u64, index, index);
        dispatch(Look {
            obstacles,
            patch,
            ahead: ahead.as_ref(),
            lattice: &Lattice::new(Block::WHOLE, &mut stream),
            effort,
        })
    };
    let sums = look(FIRST_LOOK);
    let total = |lanes: &[f64; LANES]| lanes.iter().sum::<f64>();
    let all = total(&sums.all);
    let visible = if is_suspicious(&sums.cells) {
        visible_share(&look(CLOSE_LOOK).cells)
    } else {
        1.0
    };
    let found = std::array::from_fn(|lane| sums.backs[lane] + sums.background[lane]);
    let (_, scatter) = ratio(&found, &sums.all);
    let share = total(&found) / all;
    Hemisphere {
        backs: total(&sums.backs) / all,
        background: total(&sums.background) / all,
        error: scatter.max(error_of_rays(share)),
        visible,
    }
}

/// The standard error of a share that the rays from a patch tell, if they were independent and one
/// more ray told it: eight shifts may agree by chance, and what is smaller than the share of one
/// ray may have gone unseen.
pub fn error_of_rays(share: f64) -> f64 {
    let one = 1.0 / (LANES * FIRST_LOOK.rays) as f64;
    let share = share.clamp(0.0, 1.0);
    ((share + one) * (1.0 - share + one) * one).sqrt()
}

struct Look<'a> {
    obstacles: &'a AllBlockers,
    patch: &'a Patch,
    /// Unless there are too many walls.
    ahead: Option<&'a FrontWalls>,
    lattice: &'a Lattice,
    effort: Effort,
}

/// Rays, one per lane.
struct Rays<S: Simd> {
    /// Coordinates on the patch, from 0 to 1.
    on_patch: [S::F64; 2],
    from: SamplePoints<S::F64>,
    direction: [S::F32; 3],
}

impl Kernel for Look<'_> {
    type Output = Sums;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Sums {
        let zero = simd.splat_f64(0.0);
        let (mut all, mut backs, mut background) = (zero, zero, zero);
        let target = PatchSampler::new(&self.patch.polygon, self.patch.normal);
        let Effort { rays: count, cells } = self.effort;
        let mut starts = Vec::with_capacity(count);
        for k in 0..count {
            let rays = rays(simd, (self.patch, &target), k, self.lattice);
            let met = match self.ahead {
                Some(ahead) => ahead.meet(simd, &rays.from, rays.direction),
                None => trace(self.obstacles, self.patch, &rays),
            };
            let weight = rays.from.area;
            all = all + weight;
            backs = backs + weight.select(met.backs, zero);
            background = background + weight.select(met.nothing, zero);
            let [u, v] = rays.on_patch;
            starts.push(Starts {
                on_patch: [u.lanes(), v.lanes()],
                weights: weight.lanes(),
                met,
            });
        }
        Sums {
            all: all.lanes(),
            backs: backs.lanes(),
            background: background.lanes(),
            cells: by_cell(&starts, cells),
        }
    }
}

/// Rays from points of a patch, with the area that each stands for, in directions of density
/// `cos / pi` (Malley's method).
#[inline(always)]
fn rays<S: Simd>(
    simd: S,
    (patch, target): (&Patch, &PatchSampler),
    k: usize,
    lattice: &Lattice,
) -> Rays<S> {
    let (u, v) = (
        lattice.coordinate(simd, k, 0),
        lattice.coordinate(simd, k, 1),
    );
    let from = points(simd, target, u, v);
    let (a, b) = (
        lattice.coordinate(simd, k, 2),
        lattice.coordinate(simd, k, 3),
    );
    let [x, y] = on_disk(simd, a, b);
    let one = simd.splat_f32(1.0);
    let z = (one - x * x - y * y).max(simd.splat_f32(0.0)).sqrt();
    let (tangent, bitangent) = patch.normal.any_orthonormal_pair();
    let mut direction = [x, y, z];
    for (axis, direction) in direction.iter_mut().enumerate() {
        *direction = x * simd.splat_f32(tangent[axis] as f32)
            + y * simd.splat_f32(bitangent[axis] as f32)
            + z * simd.splat_f32(patch.normal[axis] as f32);
    }
    Rays {
        on_patch: [u, v],
        from,
        direction,
    }
}

/// The unit square onto the unit disk, by Shirley and Chiu's map ("A Low Distortion Map Between
/// Disk and Square", 1997).
#[inline(always)]
fn on_disk<S: Simd>(simd: S, a: S::F64, b: S::F64) -> [S::F32; 2] {
    let one = simd.splat_f64(1.0);
    let (a, b) = (simd.narrow(a + a - one), simd.narrow(b + b - one));
    let (of_a, of_b) = (a * a, b * b);
    let (long, short) = (of_a.if_less(of_b, b, a), of_a.if_less(of_b, a, b));
    let [sin, cos] = sin_cos(simd, simd.splat_f32(FRAC_PI_4) * (short / long));
    let (along, across) = (long * cos, long * sin);
    [
        of_a.if_less(of_b, across, along),
        of_a.if_less(of_b, along, across),
    ]
}

/// Sine and cosine of angles up to an eighth of a turn, to single precision: by Taylor's series.
#[inline(always)]
fn sin_cos<S: Simd>(simd: S, x: S::F32) -> [S::F32; 2] {
    let (one, square) = (simd.splat_f32(1.0), x * x);
    let (mut sin, mut cos) = (one, one);
    for k in [8.0, 6.0, 4.0, 2.0] {
        sin = one - square * sin * simd.splat_f32(1.0 / (k * (k + 1.0)));
        cos = one - square * cos * simd.splat_f32(1.0 / (k * (k - 1.0)));
    }
    [x * sin, cos]
}

/// What rays from a patch meet first.
#[inline(always)]
fn trace<S: Simd>(obstacles: &AllBlockers, patch: &Patch, rays: &Rays<S>) -> FirstHits {
    let occluders = &obstacles.occluders;
    let own = obstacles.wall(patch);
    let from = rays.from.lanes();
    let [x, y, z] = &rays.direction;
    let along = [x.lanes(), y.lanes(), z.lanes()];
    let mut met = FirstHits::default();
    for lane in 0..LANES {
        let origin = DVec3::from_array(from.map(|axis| axis[lane]));
        let direction = DVec3::from_array(along.map(|axis| f64::from(axis[lane])));
        let ray = Ray::new(origin, direction);
        let hit = occluders.closest_hit_from(own, &ray);
        met.nothing |= u8::from(hit.is_none()) << lane;
        met.backs |= u8::from(hit.is_some_and(|hit| !hit.front)) << lane;
        let is_two_sided = |wall: FaceId| obstacles.two_sided[wall.index()];
        let is_backed = hit.is_some_and(|hit| hit.backed && !is_two_sided(hit.face));
        met.backed |= u8::from(is_backed) << lane;
    }
    met
}
