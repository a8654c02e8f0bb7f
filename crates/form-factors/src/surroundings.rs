//! What a patch sees that is no front: backs of faces, and nothing at all.
//!
//! Measured by rays, independently of the factors: together they account for everything that a
//! patch sees.

use crate::blocker::{Blocker, Plane};
use crate::hidden::{is_suspicious, visible_share};
use crate::obstacles::Obstacles;
use crate::random::Stream;
use crate::target::{Points, Target, dot, height, points};
use crate::visible::{Shifts, coordinate, ratio, shifts};
use radiosity_geometry::{DVec3, FaceId, Mesh, Patch, Ray};
use radiosity_simd::{Float, Kernel, LANES, Simd, dispatch};
use std::f64::consts::FRAC_PI_4;

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
/// So many faces are tried in turn; more are found by a tree.
const FASTER_THAN_TREE: usize = 32;

/// Shares of all that a patch sees, by form factor. Faces without patches count as backs, from
/// either side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Surroundings {
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
    /// Of each cell of the patch, the weights of all rays and of those that met backs.
    cells: Vec<[f64; 2]>,
}

/// Looks around from the patch of this index.
pub(crate) fn look_around(mesh: &Mesh, obstacles: &Obstacles, index: usize) -> Surroundings {
    let patch = &mesh.patches[index];
    let walls = in_front(obstacles, patch);
    let look = |effort: Effort| {
        dispatch(Look {
            obstacles,
            patch,
            in_front: walls.as_deref(),
            shifts: &shifts(Stream::of_pair(SEED, index, index)),
            effort,
        })
    };
    let sums = look(FIRST_LOOK);
    let total = |lanes: &[f64; LANES]| lanes.iter().sum::<f64>();
    let all = total(&sums.all);
    let visible = if is_suspicious(&sums.cells, total(&sums.backs) / all) {
        visible_share(&look(CLOSE_LOOK).cells)
    } else {
        1.0
    };
    let found = std::array::from_fn(|lane| sums.backs[lane] + sums.background[lane]);
    let (_, scatter) = ratio(&found, &sums.all);
    // What is smaller than the share of one ray may have gone unseen.
    let unseen = 1.0 / (LANES * FIRST_LOOK.rays) as f64;
    Surroundings {
        backs: total(&sums.backs) / all,
        background: total(&sums.background) / all,
        error: scatter.max(unseen),
        visible,
    }
}

/// The walls in front of a patch, unless there are too many in the scene.
fn in_front<'a>(obstacles: &'a Obstacles, patch: &Patch) -> Option<Vec<Wall<'a>>> {
    let polygons = &obstacles.walls.polygons;
    if polygons.len() > FASTER_THAN_TREE {
        return None;
    }
    let plane = Plane::through(patch.centroid, patch.normal);
    let tolerance = obstacles.occluders.plane_tolerance();
    let own = obstacles.wall(patch);
    let ids = (0..polygons.len() as u32).map(FaceId);
    let is_in_front = |id: &FaceId| {
        let corners = polygons[id.index()].corners().iter();
        *id != own && corners.map(|&c| plane.height(c)).any(|h| h > tolerance)
    };
    let wall = |id: FaceId| Wall {
        blocker: obstacles.blocker(id),
        bare: if obstacles.walls.bare[id.index()] {
            !0
        } else {
            0
        },
    };
    Some(ids.filter(is_in_front).map(wall).collect())
}

/// What may be met.
struct Wall<'a> {
    blocker: &'a Blocker,
    /// All lanes, if neither side is a front.
    bare: u8,
}

struct Look<'a> {
    obstacles: &'a Obstacles,
    patch: &'a Patch,
    in_front: Option<&'a [Wall<'a>]>,
    shifts: &'a Shifts,
    effort: Effort,
}

/// Rays, one per lane.
struct Rays<F> {
    /// Coordinates on the patch, from 0 to 1.
    on_patch: [F; 2],
    from: Points<F>,
    direction: [F; 3],
}

/// What rays have met, one bit per lane.
struct Met {
    backs: u8,
    nothing: u8,
}

impl Kernel for Look<'_> {
    type Output = Sums;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Sums {
        let zero = simd.splat_f64(0.0);
        let (mut all, mut backs, mut background) = (zero, zero, zero);
        let target = Target::new(self.patch);
        let Effort { rays: count, cells } = self.effort;
        let mut of_cells = vec![[0.0; 2]; cells * cells];
        for k in 0..count {
            let rays = rays(simd, (self.patch, &target), k, self.shifts);
            let met = match self.in_front {
                Some(walls) => meet(simd, walls, &rays),
                None => trace(self.obstacles, self.obstacles.wall(self.patch), &rays),
            };
            let weight = rays.from.area;
            all = all + weight;
            backs = backs + weight.select(met.backs, zero);
            background = background + weight.select(met.nothing, zero);
            let (u, v) = (rays.on_patch[0].lanes(), rays.on_patch[1].lanes());
            for (lane, weight) in weight.lanes().into_iter().enumerate() {
                let along = |x: f64| ((x * cells as f64) as usize).min(cells - 1);
                let cell = &mut of_cells[along(u[lane]) * cells + along(v[lane])];
                cell[0] += weight;
                cell[1] += weight * f64::from(met.backs >> lane & 1);
            }
        }
        Sums {
            all: all.lanes(),
            backs: backs.lanes(),
            background: background.lanes(),
            cells: of_cells,
        }
    }
}

/// Rays from points of a patch, with the area that each stands for, in directions of density
/// `cos / pi` (Malley's method).
#[inline(always)]
fn rays<S: Simd>(
    simd: S,
    (patch, target): (&Patch, &Target),
    k: usize,
    shifts: &Shifts,
) -> Rays<S::F64> {
    let (u, v) = (
        coordinate(simd, k, 0, shifts),
        coordinate(simd, k, 1, shifts),
    );
    let from = points(simd, target, u, v);
    let (a, b) = (
        coordinate(simd, k, 2, shifts),
        coordinate(simd, k, 3, shifts),
    );
    let [x, y] = on_disk(simd, a, b);
    let one = simd.splat_f64(1.0);
    let z = (one - x * x - y * y).max(simd.splat_f64(0.0)).sqrt();
    let (tangent, bitangent) = patch.normal.any_orthonormal_pair();
    let mut direction = [x, y, z];
    for (axis, direction) in direction.iter_mut().enumerate() {
        *direction = x * simd.splat_f64(tangent[axis])
            + y * simd.splat_f64(bitangent[axis])
            + z * simd.splat_f64(patch.normal[axis]);
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
fn on_disk<S: Simd>(simd: S, a: S::F64, b: S::F64) -> [S::F64; 2] {
    let one = simd.splat_f64(1.0);
    let (a, b) = (a + a - one, b + b - one);
    let steep = (a * a).less(b * b);
    let (long, short) = (b.select(steep, a), a.select(steep, b));
    let [sin, cos] = sin_cos(simd, simd.splat_f64(FRAC_PI_4) * (short / long));
    let (along, across) = (long * cos, long * sin);
    [across.select(steep, along), along.select(steep, across)]
}

/// Sine and cosine of angles up to an eighth of a turn, to 3e-8: by Taylor's series.
#[inline(always)]
fn sin_cos<S: Simd>(simd: S, x: S::F64) -> [S::F64; 2] {
    let (one, square) = (simd.splat_f64(1.0), x * x);
    let (mut sin, mut cos) = (one, one);
    for k in [8.0, 6.0, 4.0, 2.0] {
        sin = one - square * sin * simd.splat_f64(1.0 / (k * (k + 1.0)));
        cos = one - square * cos * simd.splat_f64(1.0 / (k * (k - 1.0)));
    }
    [x * sin, cos]
}

/// What rays meet first of some walls.
///
/// A ray meets a wall if it comes nearer to its plane, and if where it crosses that its height over
/// each edge, times a positive number, is not negative.
#[inline(always)]
fn meet<S: Simd>(simd: S, walls: &[Wall<'_>], rays: &Rays<S::F64>) -> Met {
    let zero = simd.splat_f64(0.0);
    let [x, y, z] = rays.direction;
    let mut nearest = simd.splat_f64(f64::INFINITY);
    let mut met = Met {
        backs: 0,
        nothing: !0,
    };
    for wall in walls {
        let [plane, edges @ ..] = &wall.blocker.planes;
        let (from, along) = (
            height(simd, plane, &rays.from),
            dot(simd, plane.normal, x, y, z),
        );
        let (distance, speed) = (from.max(-from), along.max(-along));
        let mut hits = (from * along).less(zero);
        for edge in edges {
            let at =
                height(simd, edge, &rays.from) * speed + dot(simd, edge.normal, x, y, z) * distance;
            hits &= zero.less_or_equal(at);
        }
        let at = distance / speed;
        hits &= at.less(nearest);
        nearest = at.select(hits, nearest);
        met.backs = met.backs & !hits | (from.less(zero) | wall.bare) & hits;
        met.nothing &= !hits;
    }
    met
}

/// What rays meet first of all faces but one.
#[inline(always)]
fn trace<F: Float<f64>>(obstacles: &Obstacles, except: FaceId, rays: &Rays<F>) -> Met {
    let from = rays.from.lanes();
    let [x, y, z] = &rays.direction;
    let along = [x.lanes(), y.lanes(), z.lanes()];
    let mut met = Met {
        backs: 0,
        nothing: 0,
    };
    for lane in 0..LANES {
        let at = |lanes: &[[f64; LANES]; 3]| DVec3::from_array(lanes.map(|axis| axis[lane]));
        let ray = Ray::new(at(&from), at(&along));
        let hit = obstacles
            .occluders
            .closest_hit(&ray, 0.0, f64::INFINITY, Some(except));
        met.nothing |= u8::from(hit.is_none()) << lane;
        let is_bare = |wall: FaceId| obstacles.walls.bare[wall.index()];
        let is_back = hit.is_some_and(|hit| !hit.front || is_bare(hit.face));
        met.backs |= u8::from(is_back) << lane;
    }
    met
}
