//! What blocks the segments between the points of two patches, eight at a time.

use crate::blocker::{Blocker, EDGES, PLANES, Plane};
use crate::samples::{Lanes, Samples};
use radiosity_geometry::FaceId;
use radiosity_simd::{Float, Kernel, LANES, Simd, dispatch};

/// Edges are moved outwards by this, in units of the scene's extent, so that no segment slips
/// through between neighbours: eight times what rounding makes of a height.
const GROWTH: f64 = 4.0 / (1 << 23) as f64;

/// The heights of eight points over the planes of a face.
pub(crate) type Heights = [Lanes<f32>; PLANES];

/// The heights of the points of a tile over the planes of faces: each is computed once.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shade {
    faces: Vec<FaceId>,
    /// By face of the scene: its place among `faces`, if it is there.
    places: Vec<u32>,
    /// By face and point.
    heights: Vec<Heights>,
}

const NOWHERE: u32 = u32::MAX;

impl Shade {
    pub(crate) fn clear(&mut self) {
        for face in self.faces.drain(..) {
            self.places[face.index()] = NOWHERE;
        }
        self.heights.clear();
    }

    /// By point, in units of the scene's extent.
    pub(crate) fn heights(
        &mut self,
        face: FaceId,
        over: &Over<'_>,
        samples: &Samples,
    ) -> &[Heights] {
        if self.places.len() <= face.index() {
            self.places.resize(face.index() + 1, NOWHERE);
        }
        let place = &mut self.places[face.index()];
        if *place == NOWHERE {
            *place = self.faces.len() as u32;
            self.faces.push(face);
            let heights = &mut self.heights;
            dispatch(Measure {
                over,
                samples,
                heights,
            });
        }
        let count = samples.points.len();
        let at = *place as usize;
        &self.heights[at * count..(at + 1) * count]
    }
}

/// What heights are measured over, and how.
pub(crate) struct Over<'a> {
    pub(crate) blocker: &'a Blocker,
    /// The scene's extent.
    pub(crate) unit: f64,
    /// Up to this, heights over the face itself are zero.
    pub(crate) tolerance: f64,
}

struct Measure<'a> {
    over: &'a Over<'a>,
    samples: &'a Samples,
    heights: &'a mut Vec<Heights>,
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
        let zero = simd.splat_f64(0.0);
        let tolerance = simd.splat_f64(tolerance / unit);
        for point in &self.samples.points {
            let [x, y, z] = &point.position;
            let point = [simd.f64(x), simd.f64(y), simd.f64(z)];
            let height = plane.heights(simd, point);
            let tiny = height.max(-height).less_or_equal(tolerance);
            let mut heights = [[0.0; LANES]; PLANES];
            heights[0] = simd.narrow(zero.select(tiny, height)).lanes();
            for (e, edge) in edges.iter().enumerate() {
                let height = edge.heights(simd, point) + simd.splat_f64(GROWTH);
                heights[1 + e] = simd.narrow(height).lanes();
            }
            self.heights.push(heights);
        }
    }
}

/// Marks the segments from a point of each patch of a tile to a patch that a face blocks.
pub(crate) struct Mark<'a> {
    /// Of the points of a tile, and which of its patches is meant.
    pub(crate) from: (&'a [Heights], usize),
    pub(crate) to: &'a [Heights],
    /// The lanes of `to` that the face may block.
    pub(crate) lanes: u8,
    /// By point of `to` and point of `from`: one bit per lane.
    pub(crate) blocked: &'a mut [u8],
}

impl Kernel for Mark<'_> {
    type Output = ();

    /// A segment is blocked if its ends are on either side of the face, and if where it crosses
    /// that plane its height over each edge, times a positive number, is not negative.
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let (from, lane) = self.from;
        let zero = simd.splat_f32(0.0);
        for (to, blocked) in self
            .to
            .iter()
            .zip(self.blocked.chunks_exact_mut(from.len()))
        {
            let [to_plane, to_edges @ ..] = to;
            let to_plane = simd.f32(to_plane);
            for (from, blocked) in from.iter().zip(blocked) {
                if *blocked == !0 {
                    continue;
                }
                let from_plane = simd.splat_f32(from[0][lane]);
                // Positive where the ends are on either side, times the height of the first.
                let across = -(to_plane * from_plane);
                let squared = from_plane * from_plane;
                let mut least = across;
                for e in 0..EDGES {
                    let at = simd.splat_f32(from[1 + e][lane]) * across
                        + simd.f32(&to_edges[e]) * squared;
                    least = least.min(at);
                }
                let opposite = zero.less(across);
                *blocked |= opposite & zero.less_or_equal(least) & self.lanes;
            }
        }
    }
}
