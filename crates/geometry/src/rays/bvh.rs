//! Bounding volume hierarchy over boxes, eight children to a node, so that one ray is tested
//! against eight boxes at once (Wald, Benthin & Boulos, "Getting Rid of Packets", 2008).
//!
//! The boxes are in single precision, relative to the centre of the scene and rounded outwards.
//! A leaf holds up to eight items; what they are is the visitor's business.

use crate::rays::bvh_build::MAX_DEPTH;
use crate::rays::ray::Ray;
use crate::rays::shaft::Shaft;
use crate::rays::slabs::{Boxes, Frame};
use arrayvec::ArrayVec;
use radiosity_simd::{LANES, Simd};
use std::ops::ControlFlow;

/// A tree over items given by their boxes.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    /// The root first.
    pub(crate) nodes: Vec<Node>,
    pub(crate) leaves: Vec<Leaf>,
    pub(crate) frame: Frame,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) boxes: Boxes,
    pub(crate) children: [Child; LANES],
}

/// Up to eight items with their boxes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leaf {
    pub(crate) boxes: Boxes,
    /// Their indices; those of unused lanes mean nothing.
    pub(crate) items: [u32; LANES],
}

/// The index of a node or of a leaf.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Child(u32);

/// What looks at the leaves along a ray.
pub(crate) trait Visitor {
    /// Looks at a leaf that the ray may meet at parameters up to `limit`, and lowers that as it
    /// finds hits. `Break` ends the search.
    fn visit<S: Simd>(&mut self, simd: S, leaf: usize, limit: &mut f64) -> ControlFlow<()>;
}

/// What looks at the items within a shaft.
pub(crate) trait ShaftVisitor {
    /// Looks at an item. `Break` ends the search.
    fn visit<S: Simd>(&mut self, simd: S, item: u32) -> ControlFlow<()>;
}

/// So few leaves are looked at faster than the boxes around them.
pub(crate) const FEW_LEAVES: usize = 3;
/// Each level leaves up to seven of its eight children waiting.
pub(crate) const STACK: usize = (LANES - 1) * MAX_DEPTH + LANES;

impl Bvh {
    /// Shows a visitor all leaves that the ray may touch at parameters in `from..=limit`, near
    /// ones first.
    #[inline(always)]
    pub(crate) fn along<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        from: f64,
        mut limit: f64,
        visitor: &mut impl Visitor,
    ) {
        if self.leaves.len() <= FEW_LEAVES {
            for leaf in 0..self.leaves.len() {
                if visitor.visit(simd, leaf, &mut limit).is_break() {
                    break;
                }
            }
            return;
        }
        let Some(slabs) = self.frame.ray(ray, from, limit) else {
            return;
        };
        let mut far_limit = slabs.parameter(limit);
        let mut stack = ArrayVec::<Waiting, STACK>::new();
        stack.push(Waiting::new(0.0, Child::ROOT));
        while let Some(waiting) = stack.pop() {
            if waiting.entry() > far_limit {
                continue;
            }
            let child = waiting.child();
            if let Some(leaf) = child.leaf() {
                if visitor.visit(simd, leaf, &mut limit).is_break() {
                    return;
                }
                far_limit = slabs.parameter(limit);
                continue;
            }
            let node = &self.nodes[child.index()];
            let (mask, entries) = node.boxes.enter(simd, &slabs, far_limit);
            let first = stack.len();
            for lane in bits(mask) {
                stack.push(Waiting::new(entries[lane], node.children[lane]));
                sink_last(&mut stack[first..]);
            }
        }
    }

    /// Shows a visitor every item whose box reaches into a shaft.
    #[inline(always)]
    pub(crate) fn within<S: Simd>(&self, simd: S, shaft: &Shaft, visitor: &mut impl ShaftVisitor) {
        let mut stack = ArrayVec::<Child, STACK>::new();
        stack.push(Child::ROOT);
        while let Some(child) = stack.pop() {
            if let Some(leaf) = child.leaf() {
                let Leaf { boxes, items } = &self.leaves[leaf];
                for lane in bits(shaft.meets(simd, boxes)) {
                    if visitor.visit(simd, items[lane]).is_break() {
                        return;
                    }
                }
                continue;
            }
            let node = &self.nodes[child.index()];
            for lane in bits(shaft.meets(simd, &node.boxes)) {
                stack.push(node.children[lane]);
            }
        }
    }
}

impl Leaf {
    /// The indices of its items.
    pub(crate) fn items(&self) -> impl Iterator<Item = usize> {
        bits(self.boxes.used()).map(|lane| self.items[lane] as usize)
    }
}

impl Node {
    pub(crate) const EMPTY: Node = Node {
        boxes: Boxes::EMPTY,
        children: [Child::ROOT; LANES],
    };
}

impl Child {
    pub(crate) const ROOT: Child = Child(0);
    const LEAF: u32 = 1 << 31;

    pub(crate) fn to_node(index: usize) -> Child {
        Child(index as u32)
    }

    pub(crate) fn to_leaf(index: usize) -> Child {
        Child(index as u32 | Child::LEAF)
    }

    pub(crate) fn leaf(self) -> Option<usize> {
        (self.0 & Child::LEAF != 0).then_some((self.0 & !Child::LEAF) as usize)
    }

    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A child to be looked at and where the ray enters it. Ordered by entry: as no entry is
/// negative, its bits order as it does.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Waiting(u64);

impl Waiting {
    #[inline(always)]
    fn new(entry: f32, child: Child) -> Waiting {
        Waiting(u64::from(entry.to_bits()) << 32 | u64::from(child.0))
    }

    #[inline(always)]
    fn entry(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    #[inline(always)]
    fn child(self) -> Child {
        Child(self.0 as u32)
    }
}

/// Moves the last element down to its place among others that are sorted, the least last.
#[inline(always)]
fn sink_last(sorted: &mut [Waiting]) {
    let mut k = sorted.len() - 1;
    while k > 0 && sorted[k - 1] < sorted[k] {
        sorted.swap(k - 1, k);
        k -= 1;
    }
}

/// The positions of the set bits, in order.
#[inline(always)]
pub(crate) fn bits(mask: u8) -> impl Iterator<Item = usize> {
    let mut rest = mask;
    std::iter::from_fn(move || {
        let position = rest.trailing_zeros() as usize;
        rest &= rest.wrapping_sub(1);
        (position < LANES).then_some(position)
    })
}
