//! What blocks the segments between the points of two patches, eight at a time.

use crate::culling::blocker::{Blocker, EDGES, Plane};
use crate::regular::tile_points::{Lanes, TilePoints};
use radiosity_geometry::FaceId;
use radiosity_simd::{Float, Kernel, LANES, Simd, dispatch};

/// Edges are moved outwards by this, in units of the scene's extent, so that no segment slips
/// through between neighbours: eight times what rounding makes of a height where one crosses.
const GROWTH: f64 = 4.0 / (1 << 23) as f64;

/// Where eight points lie, seen from a face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearing {
    /// The height over each edge, in units of the distance from the face's plane.
    slopes: [Lanes<f32>; EDGES],
    /// Which points are above that plane, and which below it: one bit per lane.
    above: u8,
    below: u8,
}

/// Where the points of a tile lie, seen from faces: each is found out once.
#[derive(Clone, Debug, Default)]
pub(crate) struct TileBearings {
    faces: Vec<FaceId>,
    /// By face of the scene: its place among `faces`, if it is there.
    places: Vec<u32>,
    /// By face and point.
    bearings: Vec<Bearing>,
}

const NOWHERE: u32 = u32::MAX;

impl TileBearings {
    pub(crate) fn clear(&mut self) {
        for face in self.faces.drain(..) {
            self.places[face.index()] = NOWHERE;
        }
        self.bearings.clear();
    }

    /// By point.
    pub(crate) fn over(
        &mut self,
        face: FaceId,
        over: &Over<'_>,
        samples: &TilePoints,
    ) -> &[Bearing] {
        if self.places.len() <= face.index() {
            self.places.resize(face.index() + 1, NOWHERE);
        }
        let place = &mut self.places[face.index()];
        if *place == NOWHERE {
            *place = self.faces.len() as u32;
            self.faces.push(face);
            let bearings = &mut self.bearings;
            dispatch(Measure {
                over,
                samples,
                bearings,
            });
        }
        let count = samples.points.len();
        let at = *place as usize;
        &self.bearings[at * count..(at + 1) * count]
    }
}

/// What bearings are taken from, and how.
pub(crate) struct Over<'a> {
    pub(crate) blocker: &'a Blocker,
    /// The scene's extent.
    pub(crate) unit: f64,
    /// Points up to this far from the face's plane are in it.
    pub(crate) tolerance: f64,
}

struct Measure<'a> {
    over: &'a Over<'a>,
    samples: &'a TilePoints,
    bearings: &'a mut Vec<Bearing>,
}

impl Kernel for Measure<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Over {
            blocker,
            unit,
            tolerance,
        } = self.over;
        let [plane, edges @ ..] = blocker.planes.map(|plane| Plane {
            offset: plane.offset / unit,
            ..plane
        });
        let one = simd.splat_f64(1.0);
        let tolerance = simd.splat_f64(tolerance / unit);
        for point in &self.samples.points {
            let [x, y, z] = &point.position;
            let point = [simd.f64(x), simd.f64(y), simd.f64(z)];
            let height = plane.heights(simd, point);
            // Of points in the plane slopes are infinite, or no numbers; those are on neither side.
            let per_distance = one / height.max(-height);
            let mut slopes = [[0.0; LANES]; EDGES];
            for (slope, edge) in slopes.iter_mut().zip(&edges) {
                let height = edge.heights(simd, point) + simd.splat_f64(GROWTH);
                *slope = simd.narrow(height * per_distance).lanes();
            }
            self.bearings.push(Bearing {
                slopes,
                above: tolerance.less(height),
                below: height.less(-tolerance),
            });
        }
    }
}

/// Marks the segments from a point of each patch of a tile to a patch that a face blocks.
pub(crate) struct Mark<'a> {
    /// Of the points of a tile, and which of its patches is meant.
    pub(crate) from: (&'a [Bearing], usize),
    pub(crate) to: &'a [Bearing],
    /// The lanes of `to` that the face may block.
    pub(crate) lanes: u8,
    /// By point of `to` and point of `from`: one bit per lane.
    pub(crate) blocked: &'a mut [u8],
}

impl Kernel for Mark<'_> {
    type Output = ();

    /// A segment is blocked if its ends are on either side of the face, and where it crosses that
    /// plane it is not below any edge. Its height over an edge there is the mean of those of its
    /// ends, each weighted by the other's distance from the plane: times a positive number, the sum
    /// of the slopes.
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let (from, lane) = self.from;
        let zero = simd.splat_f32(0.0);
        let of_point = self.blocked.chunks_exact_mut(from.len());
        for (to, blocked) in self.to.iter().zip(of_point) {
            let mut to_slopes = [zero; EDGES];
            for (lanes, slopes) in to_slopes.iter_mut().zip(&to.slopes) {
                *lanes = simd.f32(slopes);
            }
            for (from, blocked) in from.iter().zip(blocked) {
                let mut least = simd.splat_f32(f32::INFINITY);
                for (from, &to) in from.slopes.iter().zip(&to_slopes) {
                    least = least.min(simd.splat_f32(from[lane]) + to);
                }
                let is = |side: u8| 0u8.wrapping_sub(side >> lane & 1);
                let beyond = is(from.above) & to.below | is(from.below) & to.above;
                *blocked |= zero.less_or_equal(least) & beyond & self.lanes;
            }
        }
    }
}
