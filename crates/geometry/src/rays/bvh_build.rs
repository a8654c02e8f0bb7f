//! Builds a [`Bvh`]: binned surface area heuristic (Wald, "On fast Construction of SAH-based
//! Bounding Volume Hierarchies", 2007), the largest parts split until a node has eight children.

use crate::bounds::Aabb;
use crate::rays::bvh::{Bvh, Child, FEW_LEAVES, Leaf, Node};
use crate::rays::slabs::{Boxes, Frame};
use arrayvec::ArrayVec;
use glam::DVec3;
use radiosity_simd::LANES;
use std::ops::Range;

const BINS: usize = 16;
/// After this many splits above them parts are split at the median, which bounds the depth.
const SAH_DEPTH: usize = 48;
/// No node is deeper than this.
pub(crate) const MAX_DEPTH: usize = SAH_DEPTH + 32;

struct Builder<'a> {
    boxes: &'a [Aabb],
    /// The items, of which every part is a range.
    items: Vec<u32>,
    tree: Bvh,
}

/// Items that will share a node or a leaf.
struct Part {
    range: Range<usize>,
    bounds: Aabb,
    /// Number of splits above it.
    depth: usize,
}

/// The tree over some boxes.
pub(crate) fn build(boxes: &[Aabb]) -> Bvh {
    let whole = boxes.iter().fold(Aabb::EMPTY, |sum, &b| sum.union(b));
    let nowhere = Aabb::around([DVec3::ZERO]);
    let mut builder = Builder {
        boxes,
        items: (0..boxes.len() as u32).collect(),
        tree: Bvh {
            nodes: Vec::new(),
            leaves: Vec::new(),
            frame: Frame::new(if boxes.is_empty() { nowhere } else { whole }),
        },
    };
    if boxes.is_empty() {
        builder.tree.nodes.push(Node::EMPTY);
    } else {
        builder.add_node(builder.part(0..boxes.len(), 0));
    }
    builder.tree
}

impl Builder<'_> {
    fn part(&self, range: Range<usize>, depth: usize) -> Part {
        let items = self.items[range.clone()].iter();
        let bounds = items.fold(Aabb::EMPTY, |sum, &item| {
            sum.union(self.boxes[item as usize])
        });
        Part {
            range,
            bounds,
            depth,
        }
    }

    fn add_node(&mut self, whole: Part) -> Child {
        let index = self.tree.nodes.len();
        self.tree.nodes.push(Node::EMPTY);
        let parts = if self.items.len() <= FEW_LEAVES * LANES {
            self.full_leaves()
        } else {
            self.divide(whole)
        };
        for (lane, part) in parts.into_iter().enumerate() {
            let bounds = part.bounds;
            let child = if part.range.len() <= LANES {
                self.add_leaf(part.range)
            } else {
                self.add_node(part)
            };
            let node = &mut self.tree.nodes[index];
            node.boxes.set(lane, bounds, &self.tree.frame);
            node.children[lane] = child;
        }
        Child::to_node(index)
    }

    fn add_leaf(&mut self, range: Range<usize>) -> Child {
        let mut leaf = Leaf {
            boxes: Boxes::EMPTY,
            items: [u32::MAX; LANES],
        };
        for (lane, &item) in self.items[range].iter().enumerate() {
            let bounds = self.boxes[item as usize];
            leaf.boxes.set(lane, bounds, &self.tree.frame);
            leaf.items[lane] = item;
        }
        self.tree.leaves.push(leaf);
        Child::to_leaf(self.tree.leaves.len() - 1)
    }

    /// All items, eight to a part.
    fn full_leaves(&self) -> ArrayVec<Part, LANES> {
        let count = self.items.len();
        let firsts = (0..count).step_by(LANES);
        firsts
            .map(|first| self.part(first..count.min(first + LANES), 1))
            .collect()
    }

    /// Splits the part of largest surface that is no leaf yet, until there are eight.
    fn divide(&mut self, whole: Part) -> ArrayVec<Part, LANES> {
        let mut parts = ArrayVec::from_iter([whole]);
        while parts.len() < LANES {
            let divisible = (0..parts.len()).filter(|&k| parts[k].range.len() > LANES);
            let area = |&k: &usize| parts[k].bounds.half_area();
            let Some(largest) = divisible.max_by(|a, b| area(a).total_cmp(&area(b))) else {
                break;
            };
            let Part { range, depth, .. } = parts.swap_remove(largest);
            let middle = range.start + self.partition(range.clone(), depth);
            parts.push(self.part(range.start..middle, depth + 1));
            parts.push(self.part(middle..range.end, depth + 1));
        }
        parts
    }

    /// Reorders the items of a range so that the first `n` of them go left, and returns `n`.
    fn partition(&mut self, range: Range<usize>, depth: usize) -> usize {
        let boxes = self.boxes;
        let items = &mut self.items[range];
        let center = |item: u32| boxes[item as usize].center();
        let centers = Aabb::around(items.iter().map(|&item| center(item)));
        if depth < SAH_DEPTH
            && let Some((axis, bin)) = best_bin(boxes, items, &centers)
        {
            return stable_partition(items, |item| {
                bin_of(center(item)[axis], &centers, axis) <= bin
            });
        }
        let extent = centers.extent().to_array();
        let axis = (0..3).fold(0, |a, b| if extent[b] > extent[a] { b } else { a });
        items.sort_by(|&a, &b| center(a)[axis].total_cmp(&center(b)[axis]));
        items.len().div_ceil(2)
    }
}

fn bin_of(center: f64, centers: &Aabb, axis: usize) -> usize {
    let position = (center - centers.min[axis]) / (centers.max[axis] - centers.min[axis]);
    ((position * BINS as f64) as usize).min(BINS - 1)
}

/// The axis and the last bin that goes left in the cheapest split, if any split leaves both sides
/// filled.
fn best_bin(boxes: &[Aabb], items: &[u32], centers: &Aabb) -> Option<(usize, usize)> {
    let extent = centers.extent();
    let axes = (0..3).filter(|&axis| extent[axis] > 0.0);
    let splits = axes.flat_map(|axis| splits(boxes, items, centers, axis));
    let best = splits.min_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, axis, bin)| (axis, bin))
}

/// The cost, axis and bin of all splits along an axis.
fn splits(boxes: &[Aabb], items: &[u32], centers: &Aabb, axis: usize) -> Vec<(f64, usize, usize)> {
    let mut bins = [(Aabb::EMPTY, 0usize); BINS];
    for &item in items {
        let bounds = boxes[item as usize];
        let bin = &mut bins[bin_of(bounds.center()[axis], centers, axis)];
        *bin = (bin.0.union(bounds), bin.1 + 1);
    }
    let add = |sum: &mut (Aabb, usize), bin: &(Aabb, usize)| {
        *sum = (sum.0.union(bin.0), sum.1 + bin.1);
        Some(*sum)
    };
    let left: Vec<_> = bins.iter().scan((Aabb::EMPTY, 0), add).collect();
    let mut right: Vec<_> = bins.iter().rev().scan((Aabb::EMPTY, 0), add).collect();
    right.reverse();
    let cost = |(bounds, count): (Aabb, usize)| bounds.half_area() * count.div_ceil(LANES) as f64;
    (0..BINS - 1)
        .filter(|&bin| left[bin].1 > 0 && right[bin + 1].1 > 0)
        .map(|bin| (cost(left[bin]) + cost(right[bin + 1]), axis, bin))
        .collect()
}

fn stable_partition(items: &mut [u32], goes_left: impl Fn(u32) -> bool) -> usize {
    let (left, right): (Vec<u32>, Vec<u32>) = items.iter().partition(|&&item| goes_left(item));
    items[..left.len()].copy_from_slice(&left);
    items[left.len()..].copy_from_slice(&right);
    left.len()
}
