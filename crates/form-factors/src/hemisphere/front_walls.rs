//! The few walls in front of a patch, and which of them rays from it meet first.

use crate::culling::blocker::{Blocker, EDGES, Plane};
use crate::culling::blockers::AllBlockers;
use crate::sampling::patch_sampler::SamplePoints;
use radiosity_geometry::{DVec3, FaceId, Patch, Polygon};
use radiosity_simd::{Float, Simd};

/// So many walls are tried in turn; more are found by a tree.
const FASTER_THAN_TREE: usize = 32;
/// What single precision rounds off products of distances and speeds, in units of the largest
/// distance between a patch and a wall. Were edges not moved outwards by it, a ray in millions
/// would slip through between two walls.
const MARGIN: f32 = 8.0 * f32::EPSILON;

/// The walls in front of a patch.
pub(crate) struct FrontWalls {
    centroid: DVec3,
    walls: Vec<Wall>,
}

struct Wall {
    plane: LocalPlane,
    edges: [LocalPlane; EDGES],
    /// Of parallelograms, how far the third edge is from the first, and the fourth from the second.
    widths: Option<[f32; 2]>,
    /// Neither side is a front.
    bare: bool,
    /// It is made of two faces, each the reverse of the other.
    two_sided: bool,
    /// How far outwards edges are moved.
    margin: f32,
}

/// A plane relative to the patch's centroid: what is near keeps its digits.
struct LocalPlane {
    normal: [f32; 3],
    /// Of the centroid.
    height: f32,
}

/// What rays have met, one bit per lane.
#[derive(Clone, Copy, Default)]
pub(crate) struct FirstHits {
    pub(crate) backs: u8,
    pub(crate) nothing: u8,
    /// Fronts that have backs in the same place, which are not their own reverse.
    pub(crate) backed: u8,
}

/// The planes of walls, unless there are too many. Of walls in one plane they are the same to the
/// bit, but for the side that the walls face: rays then meet these at the same distance.
pub(crate) fn planes_of_few(walls: &[Blocker], tolerance: f64) -> Option<Vec<Plane>> {
    if walls.len() > FASTER_THAN_TREE {
        return None;
    }
    let mut planes: Vec<Plane> = Vec::with_capacity(walls.len());
    for wall in walls {
        let [own, ..] = wall.planes;
        let is_in = |plane: &&Plane| {
            let mut corners = wall.corners.iter();
            corners.all(|&corner| plane.height(corner).abs() <= tolerance)
        };
        planes.push(match planes.iter().find(is_in) {
            Some(plane) if plane.normal.dot(own.normal) < 0.0 => plane.reversed(),
            Some(plane) => *plane,
            None => own,
        });
    }
    Some(planes)
}

impl FrontWalls {
    /// Nothing if there are too many walls in the scene.
    pub(crate) fn of(patch: &Patch, obstacles: &AllBlockers) -> Option<FrontWalls> {
        let polygons = &obstacles.walls.polygons;
        let planes_of_walls = obstacles.planes.as_ref()?;
        let plane = Plane::through(patch.centroid, patch.normal);
        let tolerance = obstacles.occluders.plane_tolerance();
        let own = obstacles.wall(patch);
        let radius = reach(patch, &patch.polygon);
        let mut ahead = FrontWalls {
            centroid: patch.centroid,
            walls: Vec::with_capacity(polygons.len()),
        };
        for (k, polygon) in polygons.iter().enumerate() {
            let id = FaceId(k as u32);
            let mut corners = polygon.corners().iter();
            if id == own || corners.all(|&corner| plane.height(corner) <= tolerance) {
                continue;
            }
            let [_, edges @ ..] = obstacles.blocker(id).planes;
            let edges = edges.map(|plane| LocalPlane::new(plane, patch.centroid));
            let width = |k: usize| edges[k].height + edges[k + 2].height;
            let widths = polygon.is_parallelogram().then(|| [width(0), width(1)]);
            let farthest = reach(patch, polygon) + radius;
            ahead.walls.push(Wall {
                plane: LocalPlane::new(planes_of_walls[k], patch.centroid),
                edges,
                widths,
                bare: obstacles.walls.bare[k],
                two_sided: obstacles.two_sided[k],
                margin: MARGIN * farthest as f32,
            });
        }
        Some(ahead)
    }

    /// What rays from points of the patch, in directions of unit length, meet first.
    ///
    /// A ray meets a wall if it comes nearer to its plane, and if where it crosses that it is
    /// inside of all edges. Where a front and a back lie in one plane, it meets the front, as
    /// [`Occluders::closest_hit`](radiosity_geometry::Occluders::closest_hit) has it.
    #[inline(always)]
    pub(crate) fn meet<S: Simd>(
        &self,
        simd: S,
        from: &SamplePoints<S::F64>,
        direction: [S::F32; 3],
    ) -> FirstHits {
        let from = [
            simd.narrow(from.x - simd.splat_f64(self.centroid.x)),
            simd.narrow(from.y - simd.splat_f64(self.centroid.y)),
            simd.narrow(from.z - simd.splat_f64(self.centroid.z)),
        ];
        let zero = simd.splat_f32(0.0);
        let nowhere = simd.splat_f32(f32::INFINITY);
        let (mut front, mut one_sided, mut back) = (nowhere, nowhere, nowhere);
        for wall in &self.walls {
            let height = wall.plane.height(simd, from);
            let rise = wall.plane.rise(simd, direction);
            let (distance, speed) = (height.max(-height), rise.max(-rise));
            let inside = wall.inside(simd, (from, distance), (direction, speed));
            let outside = simd.splat_f32(-wall.margin);
            let at = inside.if_less(outside, nowhere, distance / speed);
            let at = (height * rise).if_less(zero, at, nowhere);
            let (at_front, at_back) = match wall.bare {
                true => (nowhere, at),
                false => (
                    height.if_less(zero, nowhere, at),
                    height.if_less(zero, at, nowhere),
                ),
            };
            front = front.min(at_front);
            back = back.min(at_back);
            if !wall.two_sided {
                one_sided = one_sided.min(at_front);
            }
        }
        let (fronts, backs) = (front.less(nowhere), back.less(front));
        let both = fronts & !backs & back.less_or_equal(front);
        FirstHits {
            backs,
            nothing: !(fronts | backs),
            backed: both & one_sided.less_or_equal(front),
        }
    }
}

/// How far a polygon reaches from a patch's centroid.
fn reach(patch: &Patch, polygon: &Polygon) -> f64 {
    let distance = |corner: &DVec3| corner.distance(patch.centroid);
    polygon.corners().iter().map(distance).fold(0.0, f64::max)
}

impl Wall {
    /// The least height over an edge of where rays cross the wall's plane, times their speed toward
    /// it. Negative outside.
    #[inline(always)]
    fn inside<S: Simd>(
        &self,
        simd: S,
        (from, distance): ([S::F32; 3], S::F32),
        (direction, speed): ([S::F32; 3], S::F32),
    ) -> S::F32 {
        let mut least = simd.splat_f32(f32::INFINITY);
        let tested = match self.widths {
            Some(_) => &self.edges[..2],
            None => &self.edges[..],
        };
        for (k, edge) in tested.iter().enumerate() {
            let at = edge.height(simd, from) * speed + edge.rise(simd, direction) * distance;
            least = least.min(at);
            if let Some(widths) = self.widths {
                least = least.min(simd.splat_f32(widths[k]) * speed - at);
            }
        }
        least
    }
}

impl LocalPlane {
    fn new(plane: Plane, centroid: DVec3) -> LocalPlane {
        LocalPlane {
            normal: plane.normal.as_vec3().to_array(),
            height: plane.height(centroid) as f32,
        }
    }

    /// How fast rays in these directions rise over it.
    #[inline(always)]
    fn rise<S: Simd>(&self, simd: S, [x, y, z]: [S::F32; 3]) -> S::F32 {
        let [nx, ny, nz] = self.normal;
        simd.splat_f32(nx) * x + simd.splat_f32(ny) * y + simd.splat_f32(nz) * z
    }

    /// Of points relative to the centroid.
    #[inline(always)]
    fn height<S: Simd>(&self, simd: S, point: [S::F32; 3]) -> S::F32 {
        self.rise(simd, point) + simd.splat_f32(self.height)
    }
}

#[cfg(test)]
mod tests;
