//! Eight segments at a time: what blocks each of them.

use crate::mesh::FaceId;
use crate::rays::bvh::bits;
use crate::rays::bvh_packet::SegmentsVisitor;
use crate::rays::face_block::around_origin;
use crate::rays::occluders::{Occluder, Occluders, ordered};
use crate::rays::ray_query::Blocked;
use glam::DVec3;
use radiosity_simd::{Float, Kernel, LANES, Simd, dispatch};

/// Points of eight segments, by axis.
pub type Points = [[f64; LANES]; 3];

/// Eight segments between points of faces.
#[derive(Clone, Copy, Debug)]
pub struct SegmentPacket {
    /// Where they begin, and where they end.
    pub points: [Points; 2],
    /// The faces on which they begin and end, which do not block them.
    pub faces: [[FaceId; LANES]; 2],
}

impl Occluders {
    /// [`Occluders::blocked`] for those segments of a bundle whose bits are set: the same answers,
    /// one bit each.
    pub fn blocked_of(&self, bundle: &SegmentPacket, wanted: u8) -> u8 {
        dispatch(BlockedOf {
            occluders: self,
            bundle,
            wanted,
        })
    }
}

pub(crate) struct BlockedOf<'a> {
    pub(crate) occluders: &'a Occluders,
    pub(crate) bundle: &'a SegmentPacket,
    pub(crate) wanted: u8,
}

impl Kernel for BlockedOf<'_> {
    type Output = u8;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> u8 {
        if self.wanted == 0 {
            return 0;
        }
        let [from, to] = self.bundle.points;
        let tree = &self.occluders.tree;
        let segments = Segments::new(simd, &from, &to);
        let inside = tree.frame.holds(simd, &segments.first) & self.wanted;
        let slabs = tree.frame.segments(simd, &segments.first, &segments.last);
        let mut search = Search {
            occluders: self.occluders,
            bundle: self.bundle,
            segments,
        };
        let open = tree.together(simd, &slabs, inside, &mut search);
        let open = open | self.alone(simd, self.wanted & !inside);
        self.wanted & !open
    }
}

impl BlockedOf<'_> {
    /// Which of these segments nothing blocks, each traced by itself.
    #[inline(always)]
    fn alone<S: Simd>(&self, simd: S, lanes: u8) -> u8 {
        let SegmentPacket { points, faces } = self.bundle;
        let mut open = lanes;
        for lane in bits(lanes) {
            let [p, q] = points.map(|ends| DVec3::from_array(ends.map(|axis| axis[lane])));
            let except = faces.map(|faces| faces[lane]);
            if Blocked::new(self.occluders, except, ordered(p, q)).run(simd) {
                open &= !(1 << lane);
            }
        }
        open
    }
}

/// [`Ray`](crate::rays::ray::Ray)s from one end to the other, each from its first end in order.
struct Segments {
    first: Points,
    last: Points,
    /// The segments whose largest component is along each axis.
    along: [u8; 3],
    shear: [[f64; LANES]; 2],
}

impl Segments {
    #[inline(always)]
    fn new<S: Simd>(simd: S, from: &Points, to: &Points) -> Segments {
        let swapped = !in_order(simd, from, to);
        let (mut first, mut last) = (*from, *to);
        let mut direction = [simd.splat_f64(0.0); 3];
        for axis in 0..3 {
            let (p, q) = (simd.f64(&from[axis]), simd.f64(&to[axis]));
            let (p, q) = (q.select(swapped, p), p.select(swapped, q));
            direction[axis] = q - p;
            first[axis] = p.lanes();
            last[axis] = q.lanes();
        }
        let [x, y, z] = direction;
        let [size_x, size_y, size_z] = [x.max(-x), y.max(-y), z.max(-z)];
        let along_x = size_y.less_or_equal(size_x) & size_z.less_or_equal(size_x);
        let along_y = size_z.less_or_equal(size_y) & !along_x;
        let along_z = !(along_x | along_y);
        let largest = x.select(along_x, y.select(along_y, z));
        let second = y.select(along_x, z.select(along_y, x));
        let third = z.select(along_x, x.select(along_y, y));
        Segments {
            first,
            last,
            along: [along_x, along_y, along_z],
            shear: [(second / largest).lanes(), (third / largest).lanes()],
        }
    }
}

/// [`ordered`] for all lanes: where the first point comes first.
#[inline(always)]
fn in_order<S: Simd>(simd: S, from: &Points, to: &Points) -> u8 {
    let (mut before, mut equal) = (0, !0);
    for axis in 0..3 {
        let (p, q) = (simd.f64(&from[axis]), simd.f64(&to[axis]));
        before |= equal & p.less(q);
        equal &= p.less_or_equal(q) & q.less_or_equal(p);
    }
    before | equal
}

struct Search<'a> {
    occluders: &'a Occluders,
    bundle: &'a SegmentPacket,
    segments: Segments,
}

impl SegmentsVisitor for Search<'_> {
    #[inline(always)]
    fn expect<S: Simd>(&self, simd: S, item: u32) {
        let face = &self.occluders.faces[item as usize];
        simd.prefetch(&face.corners);
        simd.prefetch(std::slice::from_ref(&face.normal));
    }

    #[inline(always)]
    fn visit<S: Simd>(&mut self, simd: S, item: u32, segments: u8) -> u8 {
        let id = FaceId(item);
        let [from, to] = &self.bundle.faces;
        let ends_on = |lane: usize| u8::from(from[lane] == id || to[lane] == id) << lane;
        let own: u8 = (0..LANES).map(ends_on).sum();
        match segments & !own {
            0 => 0,
            some => self.cut(simd, &self.occluders.faces[id.index()], some),
        }
    }
}

impl Search<'_> {
    /// [`Occluder::cuts`] for some segments, with the same operations in the same order.
    #[inline(always)]
    fn cut<S: Simd>(&self, simd: S, face: &Occluder, some: u8) -> u8 {
        let tolerance = self.occluders.plane_tolerance;
        let at_first = heights(simd, face, &self.segments.first);
        let at_last = heights(simd, face, &self.segments.last);
        let above = simd.splat_f64(tolerance).less(at_first.max(at_last));
        let below = at_first.min(at_last).less(simd.splat_f64(-tolerance));
        let candidates = some & above & below;
        let mut cut = 0;
        for (axis, along) in self.segments.along.into_iter().enumerate() {
            if along & candidates != 0 {
                cut |= along & self.pierced(simd, face, axis);
            }
        }
        cut & candidates
    }

    /// [`Ray::pierces`](crate::rays::ray::Ray) for the segments along an axis.
    #[inline(always)]
    fn pierced<S: Simd>(&self, simd: S, face: &Occluder, axis: usize) -> u8 {
        let [a, b, c, d] = &face.corners;
        let axes = [(axis + 1) % 3, (axis + 2) % 3, axis];
        let (a, b, c) = (
            self.project(simd, a, axes),
            self.project(simd, b, axes),
            self.project(simd, c, axes),
        );
        if face.corners[2] == face.corners[3] {
            return around_origin(simd, [a, b, c], None);
        }
        around_origin(simd, [a, b, c], Some(self.project(simd, d, axes)))
    }

    #[inline(always)]
    fn project<S: Simd>(&self, simd: S, corner: &DVec3, [i, j, k]: [usize; 3]) -> [S::F64; 2] {
        let Segments { first, shear, .. } = &self.segments;
        let x = simd.splat_f64(corner[i]) - simd.f64(&first[i]);
        let y = simd.splat_f64(corner[j]) - simd.f64(&first[j]);
        let z = simd.splat_f64(corner[k]) - simd.f64(&first[k]);
        [x - simd.f64(&shear[0]) * z, y - simd.f64(&shear[1]) * z]
    }
}

#[inline(always)]
fn heights<S: Simd>(simd: S, face: &Occluder, [x, y, z]: &Points) -> S::F64 {
    let n = face.normal;
    simd.splat_f64(n.x) * simd.f64(x)
        + simd.splat_f64(n.y) * simd.f64(y)
        + simd.splat_f64(n.z) * simd.f64(z)
        - simd.splat_f64(face.offset)
}
