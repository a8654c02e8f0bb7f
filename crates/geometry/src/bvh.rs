//! Bounding volume hierarchy over boxes: binned surface area heuristic
//! (Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007).
//!
//! A node holds the boxes of both of its children in single precision, relative to the centre
//! of the scene and rounded outwards: one cache line, and both boxes tested at once.

use crate::bounds::Aabb;
use crate::ray::Ray;
use crate::slabs::{BoxPair, SlabRay};
use glam::DVec3;
use std::ops::Range;

/// A binary tree over the items `0 .. n` given by their boxes.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    nodes: Vec<Node>,
    items: Vec<u32>,
    bounds: Aabb,
    center: DVec3,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    boxes: BoxPair,
    children: [Child; 2],
}

#[derive(Clone, Copy, Debug)]
struct Child {
    /// Leaf: first position in `items`. Inner: index of the node.
    first: u32,
    /// Leaf: number of items. Inner: [`INNER`].
    count: u32,
}

/// What a visitor wants next.
pub(crate) enum Visit {
    Continue,
    Stop,
}

/// The count of an inner node's child entry.
const INNER: u32 = u32::MAX;
const LEAF_ITEMS: usize = 2;
const BINS: usize = 16;
/// Below this depth nodes split at the median, which bounds the depth of the whole tree.
const SAH_DEPTH: usize = 48;
const MAX_DEPTH: usize = SAH_DEPTH + 32;

impl Bvh {
    pub(crate) fn new(boxes: &[Aabb]) -> Bvh {
        let bounds = boxes.iter().fold(Aabb::EMPTY, |sum, &b| sum.union(b));
        let mut bvh = Bvh {
            nodes: Vec::with_capacity(boxes.len()),
            items: (0..boxes.len() as u32).collect(),
            bounds,
            center: bounds.center(),
        };
        if !boxes.is_empty() {
            // The root is a node even where one leaf would do: it then has an empty child.
            bvh.nodes.push(Node::UNSET);
            bvh.fill_node(boxes, 0, 0..boxes.len(), 0);
        }
        bvh
    }

    fn fill_node(&mut self, boxes: &[Aabb], index: usize, range: Range<usize>, depth: usize) {
        let middle = range.start + self.partition(boxes, range.clone(), depth);
        let halves = [range.start..middle, middle..range.end];
        let bounds = halves.clone().map(|half| {
            let items = self.items[half].iter();
            items.fold(Aabb::EMPTY, |sum, &item| sum.union(boxes[item as usize]))
        });
        self.nodes[index].boxes = BoxPair::new(bounds, self.center, self.bounds.extent());
        for (side, half) in halves.into_iter().enumerate() {
            self.nodes[index].children[side] = if half.len() <= LEAF_ITEMS {
                Child {
                    first: half.start as u32,
                    count: half.len() as u32,
                }
            } else {
                let child = self.nodes.len();
                self.nodes.push(Node::UNSET);
                self.fill_node(boxes, child, half, depth + 1);
                Child {
                    first: child as u32,
                    count: INNER,
                }
            };
        }
    }

    /// Reorders the items of a range so that the first `n` of them go left, and returns `n`.
    fn partition(&mut self, boxes: &[Aabb], range: Range<usize>, depth: usize) -> usize {
        let items = &mut self.items[range];
        let center = |item: u32| boxes[item as usize].center();
        let centers = Aabb::around(items.iter().map(|&item| center(item)));
        let extent = centers.extent().to_array();
        let axis = (0..3).fold(0, |a, b| if extent[b] > extent[a] { b } else { a });
        if depth < SAH_DEPTH
            && extent[axis] > 0.0
            && let Some(bin) = best_bin(boxes, items, &centers, axis)
        {
            return stable_partition(items, |item| {
                bin_of(center(item)[axis], &centers, axis) <= bin
            });
        }
        items.sort_by(|&a, &b| center(a)[axis].total_cmp(&center(b)[axis]));
        items.len().div_ceil(2)
    }

    /// Calls `visit(item, limit)` for every item whose box the ray may touch at parameters in
    /// `from..=limit`, near boxes first; the visitor lowers the limit as it finds hits.
    pub(crate) fn along(
        &self,
        ray: &Ray,
        from: f64,
        mut limit: f64,
        mut visit: impl FnMut(u32, &mut f64) -> Visit,
    ) {
        let Some(slabs) = SlabRay::new(ray, &self.bounds, self.center, from, limit) else {
            return;
        };
        let mut far_limit = slabs.parameter(limit);
        let mut stack = [(Child::ROOT, 0f32); MAX_DEPTH];
        let mut height = 0;
        let mut next = Some((Child::ROOT, 0f32));
        while let Some((child, entry)) = next.take() {
            if entry <= far_limit && child.count != INNER {
                for &item in self.leaf(child) {
                    if let Visit::Stop = visit(item, &mut limit) {
                        return;
                    }
                }
                far_limit = slabs.parameter(limit);
            } else if entry <= far_limit {
                let node = &self.nodes[child.first as usize];
                let [a, b] = node.boxes.enter(&slabs, far_limit);
                let [left, right] = node.children;
                next = match (a, b) {
                    (Some(a), Some(b)) => {
                        let (near, far) = if a <= b {
                            ((left, a), (right, b))
                        } else {
                            ((right, b), (left, a))
                        };
                        stack[height] = far;
                        height += 1;
                        Some(near)
                    }
                    (Some(a), None) => Some((left, a)),
                    (None, Some(b)) => Some((right, b)),
                    (None, None) => None,
                };
            }
            if next.is_none() && height > 0 {
                height -= 1;
                next = Some(stack[height]);
            }
        }
    }

    /// Calls `visit(item)` for every item whose node's box overlaps `region`.
    pub(crate) fn within(&self, region: &Aabb, mut visit: impl FnMut(u32) -> Visit) {
        if self.nodes.is_empty() {
            return;
        }
        let region = BoxPair::new([*region; 2], self.center, self.bounds.extent());
        let mut stack = [Child::ROOT; MAX_DEPTH];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let child = stack[height];
            for &item in self.leaf(child) {
                if let Visit::Stop = visit(item) {
                    return;
                }
            }
            if child.count != INNER {
                continue;
            }
            let node = &self.nodes[child.first as usize];
            let overlaps = node.boxes.overlap(&region);
            for side in [1, 0] {
                if overlaps[side] {
                    stack[height] = node.children[side];
                    height += 1;
                }
            }
        }
    }

    /// The items of a leaf; none of an inner node.
    fn leaf(&self, child: Child) -> &[u32] {
        if child.count == INNER {
            return &[];
        }
        let first = child.first as usize;
        &self.items[first..first + child.count as usize]
    }
}

impl Child {
    const ROOT: Child = Child {
        first: 0,
        count: INNER,
    };
}

impl Node {
    const UNSET: Node = Node {
        boxes: BoxPair::EMPTY,
        children: [Child::ROOT; 2],
    };
}

fn bin_of(center: f64, centers: &Aabb, axis: usize) -> usize {
    let position = (center - centers.min[axis]) / (centers.max[axis] - centers.min[axis]);
    ((position * BINS as f64) as usize).min(BINS - 1)
}

/// The last bin that goes left in the cheapest split, if any split leaves both sides filled.
fn best_bin(boxes: &[Aabb], items: &[u32], centers: &Aabb, axis: usize) -> Option<usize> {
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
    let cost = |(bounds, count): (Aabb, usize)| bounds.half_area() * count as f64;
    (0..BINS - 1)
        .filter(|&bin| left[bin].1 > 0 && right[bin + 1].1 > 0)
        .map(|bin| (cost(left[bin]) + cost(right[bin + 1]), bin))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, bin)| bin)
}

fn stable_partition(items: &mut [u32], goes_left: impl Fn(u32) -> bool) -> usize {
    let (left, right): (Vec<u32>, Vec<u32>) = items.iter().partition(|&&item| goes_left(item));
    items[..left.len()].copy_from_slice(&left);
    items[left.len()..].copy_from_slice(&right);
    left.len()
}
