//! The space between two boxes (Haines & Wallace, "Shaft Culling for Efficient Ray-Cast
//! Radiosity", 1991): what a segment from one to the other may meet.

use crate::bounds::Aabb;
use crate::rays::slabs::{Boxes, Frame};
use arrayvec::ArrayVec;
use glam::DVec3;
use radiosity_simd::{Float, Simd};

/// The convex hull of two boxes, or a little more of it.
#[derive(Clone, Debug)]
pub(crate) struct Shaft {
    /// The box around both, in the first lane.
    around: Boxes,
    /// At most one for each edge of that box.
    planes: ArrayVec<Bevel, 12>,
}

/// A plane parallel to one axis that cuts off an edge of the box around both: inside is where
/// `normal . p >= offset`.
#[derive(Clone, Copy, Debug)]
struct Bevel {
    /// The sides of a box, by index, whose edge lies farthest inside.
    sides: [usize; 2],
    normal: [f32; 2],
    offset: f32,
}

/// What rounding to `f32` moves of a scalar product with a unit vector, relative to the scene's
/// extent: 2^-24 for each of the five operations on numbers up to half of it; doubled, to be safe.
const ROUNDING: f64 = 5.0 / (1 << 24) as f64;

impl Shaft {
    pub(crate) fn new(a: Aabb, b: Aabb, frame: &Frame) -> Shaft {
        let mut around = Boxes::EMPTY;
        around.set(0, a.union(b), frame);
        let corners = [[a.min, a.max], [b.min, b.max]];
        let corners = corners.map(|sides| sides.map(|corner| corner - frame.center));
        let mut planes = ArrayVec::new();
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            for (high_i, high_j) in [(false, false), (false, true), (true, false), (true, true)] {
                let axes = [(i, high_i), (j, high_j)];
                planes.extend(bevel(&corners, axes, frame.extent));
            }
        }
        Shaft { around, planes }
    }

    /// Which of eight boxes reach into the shaft, one bit each.
    #[inline(always)]
    pub(crate) fn meets<S: Simd>(&self, simd: S, boxes: &Boxes) -> u8 {
        let mut mask = boxes.overlap(simd, &self.around);
        for bevel in &self.planes {
            if mask == 0 {
                break;
            }
            let [i, j] = bevel.sides.map(|side| boxes.side(side));
            let height = simd.f32(i) * simd.splat_f32(bevel.normal[0])
                + simd.f32(j) * simd.splat_f32(bevel.normal[1]);
            mask &= simd.splat_f32(bevel.offset).less_or_equal(height);
        }
        mask
    }
}

/// The plane through the edges of both boxes that are next to an edge of the box around them,
/// unless one of the boxes has that edge itself.
fn bevel(corners: &[[DVec3; 2]; 2], axes: [(usize, bool); 2], extent: f64) -> Option<Bevel> {
    let [(i, high_i), (j, high_j)] = axes;
    // Mirrored, so that outside is below.
    let sign = |high: bool| if high { -1.0 } else { 1.0 };
    let at = |which: usize| {
        let side = |axis: usize, high: bool| sign(high) * corners[which][usize::from(high)][axis];
        (side(i, high_i), side(j, high_j))
    };
    let (a, b) = (at(0), at(1));
    // One is lower along one axis, the other along the other.
    if (a.0 - b.0) * (a.1 - b.1) >= 0.0 {
        return None;
    }
    let normal = ((a.1 - b.1).abs(), (b.0 - a.0).abs());
    let scale = 1.0 / (normal.0 * normal.0 + normal.1 * normal.1).sqrt();
    let normal = (scale * normal.0, scale * normal.1);
    let offset = normal.0 * a.0 + normal.1 * a.1 - ROUNDING * extent;
    // A box's edge farthest inside is on the other side of it than the edge cut off.
    let farthest = |axis: usize, high: bool| if high { axis } else { axis + 3 };
    Some(Bevel {
        sides: [farthest(i, high_i), farthest(j, high_j)],
        normal: [
            (sign(high_i) * normal.0) as f32,
            (sign(high_j) * normal.1) as f32,
        ],
        offset: offset as f32,
    })
}
