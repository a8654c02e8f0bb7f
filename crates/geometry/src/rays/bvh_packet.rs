//! Eight segments on one way through the tree.
//!
//! A node costs as many tests as it has boxes, of all segments, or as there are segments, of all
//! boxes, whichever is less: neighbours share the upper nodes, and below segments go their own
//! ways.

use crate::rays::bvh::{Bvh, Child, Leaf, STACK, bits};
use crate::rays::slabs::{Boxes, Frame, LARGEST, RELATIVE_ERROR};
use arrayvec::ArrayVec;
use radiosity_simd::{Float, LANES, Simd};

/// What looks at the items that some of eight segments may meet.
pub(crate) trait SegmentsVisitor {
    /// Says that an item will be visited soon.
    fn expect<S: Simd>(&self, simd: S, item: u32);
    /// Looks at an item, for these segments. Returns those that need not go on.
    fn visit<S: Simd>(&mut self, simd: S, item: u32, segments: u8) -> u8;
}

/// Eight segments for boxes, from points in the scene; parameters count from 0 to 1.
pub(crate) struct SlabSegments {
    origin: [[f32; LANES]; 3],
    inverse_direction: [[f32; LANES]; 3],
}

/// So many leaves are met at a time, at most.
const MOST_LEAVES: usize = 2 * LANES;

impl Bvh {
    /// Shows a visitor every item whose box some segments enter, as long as they go on; returns
    /// those that went on to the end.
    ///
    /// Leaves, and then items, are met several at a time, so that memory is asked for the next
    /// while one is looked at.
    #[inline(always)]
    pub(crate) fn together<S: Simd>(
        &self,
        simd: S,
        segments: &SlabSegments,
        mut open: u8,
        visitor: &mut impl SegmentsVisitor,
    ) -> u8 {
        let mut stack = ArrayVec::<(Child, u8), STACK>::new();
        let mut leaves = ArrayVec::<(usize, u8), MOST_LEAVES>::new();
        stack.push((Child::ROOT, open));
        loop {
            let next = stack.pop();
            if let Some((child, some)) = next
                && some & open != 0
            {
                let node = &self.nodes[child.index()];
                let entered = node.boxes.entered(simd, segments, some & open);
                for (lane, some) in bytes(entered) {
                    let child = node.children[lane];
                    if let Some(leaf) = child.leaf() {
                        let Leaf { boxes, items } = &self.leaves[leaf];
                        simd.prefetch(boxes.side(0));
                        simd.prefetch(boxes.side(2));
                        simd.prefetch(boxes.side(4));
                        simd.prefetch(items);
                        leaves.push((leaf, some));
                    } else {
                        simd.prefetch(&self.nodes[child.index()..]);
                        stack.push((child, some));
                    }
                }
            }
            if next.is_none() || leaves.len() + LANES > MOST_LEAVES {
                open = self.look_at(simd, segments, open, &leaves, visitor);
                leaves.clear();
            }
            if next.is_none() || open == 0 {
                return open;
            }
        }
    }

    /// Shows a visitor the items of some leaves that segments enter, and returns those that go on.
    #[inline(always)]
    fn look_at<S: Simd>(
        &self,
        simd: S,
        segments: &SlabSegments,
        mut open: u8,
        leaves: &[(usize, u8)],
        visitor: &mut impl SegmentsVisitor,
    ) -> u8 {
        let mut expected = ArrayVec::<(u32, u8), { LANES * MOST_LEAVES }>::new();
        for &(leaf, some) in leaves {
            let Leaf { boxes, items } = &self.leaves[leaf];
            for (lane, some) in bytes(boxes.entered(simd, segments, some)) {
                visitor.expect(simd, items[lane]);
                expected.push((items[lane], some));
            }
        }
        for (item, some) in expected {
            if some & open != 0 {
                open &= !visitor.visit(simd, item, some & open);
            }
        }
        open
    }
}

impl Frame {
    /// Prepares segments from points in the scene.
    #[inline(always)]
    pub(crate) fn segments<S: Simd>(
        &self,
        simd: S,
        from: &[[f64; LANES]; 3],
        to: &[[f64; LANES]; 3],
    ) -> SlabSegments {
        let mut segments = SlabSegments {
            origin: [[0.0; LANES]; 3],
            inverse_direction: [[0.0; LANES]; 3],
        };
        let (largest, least) = (simd.splat_f32(LARGEST), simd.splat_f32(-LARGEST));
        for axis in 0..3 {
            let (p, q) = (simd.f64(&from[axis]), simd.f64(&to[axis]));
            let origin = simd.narrow(p - simd.splat_f64(self.center[axis]));
            let inverse = simd.splat_f32(1.0) / simd.narrow(q - p);
            segments.origin[axis] = origin.lanes();
            segments.inverse_direction[axis] = inverse.min(largest).max(least).lanes();
        }
        segments
    }

    /// Which points lie in the scene.
    #[inline(always)]
    pub(crate) fn holds<S: Simd>(&self, simd: S, points: &[[f64; LANES]; 3]) -> u8 {
        let mut inside = !0;
        for (axis, points) in points.iter().enumerate() {
            let point = simd.f64(points);
            inside &= simd.splat_f64(self.scene.min[axis]).less_or_equal(point);
            inside &= point.less_or_equal(simd.splat_f64(self.scene.max[axis]));
        }
        inside
    }
}

impl Boxes {
    /// Of each box, which of some segments enter it, one bit each: the first box in the lowest
    /// byte.
    #[inline(always)]
    pub(crate) fn entered<S: Simd>(&self, simd: S, segments: &SlabSegments, some: u8) -> u64 {
        let mut entered = 0;
        // As many tests as there are segments, or as there are boxes.
        if some.count_ones() < self.used().count_ones() {
            for segment in bits(some) {
                let [origin, inverse] = segments.splat(simd, segment);
                let [a, b, c, d, e, f] = self.sides();
                let sides = [
                    simd.f32(a),
                    simd.f32(b),
                    simd.f32(c),
                    simd.f32(d),
                    simd.f32(e),
                    simd.f32(f),
                ];
                entered |= spread(meet(simd, sides, origin, inverse) & self.used()) << segment;
            }
            return entered;
        }
        let [origin, inverse] = segments.load(simd);
        for lane in bits(self.used()) {
            let [a, b, c, d, e, f] = self.sides();
            let sides = [
                simd.splat_f32(a[lane]),
                simd.splat_f32(b[lane]),
                simd.splat_f32(c[lane]),
                simd.splat_f32(d[lane]),
                simd.splat_f32(e[lane]),
                simd.splat_f32(f[lane]),
            ];
            entered |= u64::from(meet(simd, sides, origin, inverse) & some) << (8 * lane);
        }
        entered
    }
}

impl SlabSegments {
    /// Origins and inverse directions of all.
    #[inline(always)]
    fn load<S: Simd>(&self, simd: S) -> [[S::F32; 3]; 2] {
        let [x, y, z] = &self.origin;
        let [dx, dy, dz] = &self.inverse_direction;
        [
            [simd.f32(x), simd.f32(y), simd.f32(z)],
            [simd.f32(dx), simd.f32(dy), simd.f32(dz)],
        ]
    }

    /// Origin and inverse direction of one, in all lanes.
    #[inline(always)]
    fn splat<S: Simd>(&self, simd: S, segment: usize) -> [[S::F32; 3]; 2] {
        let [x, y, z] = &self.origin;
        let [dx, dy, dz] = &self.inverse_direction;
        [
            [
                simd.splat_f32(x[segment]),
                simd.splat_f32(y[segment]),
                simd.splat_f32(z[segment]),
            ],
            [
                simd.splat_f32(dx[segment]),
                simd.splat_f32(dy[segment]),
                simd.splat_f32(dz[segment]),
            ],
        ]
    }
}

/// Bits as the lowest of bytes, the lowest first.
#[inline(always)]
fn spread(bits: u8) -> u64 {
    const ONES: u64 = 0x0101_0101_0101_0101;
    // Each byte keeps the bit of its position, and is then 1 if that was set.
    let own = (u64::from(bits) * ONES) & 0x8040_2010_0804_0201;
    ((own + 0x7f * ONES) >> 7) & ONES
}

/// Where segments meet boxes, lane by lane.
#[inline(always)]
fn meet<S: Simd>(simd: S, sides: [S::F32; 6], origin: [S::F32; 3], inverse: [S::F32; 3]) -> u8 {
    let grown = simd.splat_f32(1.0 + RELATIVE_ERROR);
    let (mut entry, mut exit) = (simd.splat_f32(0.0), grown);
    for axis in 0..3 {
        let low = (sides[axis] - origin[axis]) * inverse[axis];
        let high = (sides[axis + 3] - origin[axis]) * inverse[axis];
        entry = low.min(high).max(entry);
        exit = low.max(high).min(exit);
    }
    entry.less_or_equal(exit * grown)
}

/// The positions of the bytes that are not zero, the lowest first, and these bytes.
#[inline(always)]
fn bytes(all: u64) -> impl Iterator<Item = (usize, u8)> {
    let mut rest = all;
    std::iter::from_fn(move || {
        if rest == 0 {
            return None;
        }
        let position = rest.trailing_zeros() as usize / 8;
        let byte = (rest >> (8 * position)) as u8;
        rest ^= u64::from(byte) << (8 * position);
        Some((position, byte))
    })
}
