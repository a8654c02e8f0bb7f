//! Bounding volume hierarchy over boxes: binned surface area heuristic
//! (Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007).

use crate::bounds::Aabb;
use crate::ray::Ray;

/// A binary tree over the items `0 .. n` given by their boxes.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    nodes: Vec<Node>,
    items: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Aabb,
    /// Leaf: first position in `items`. Inner: the left child; the right one follows it.
    first: u32,
    /// Leaf: number of items. Inner: zero.
    count: u32,
}

/// What a visitor wants next.
pub(crate) enum Visit {
    Continue,
    Stop,
}

const LEAF_ITEMS: usize = 2;
const BINS: usize = 16;
/// Below this depth nodes split at the median, which bounds the depth of the whole tree.
const SAH_DEPTH: usize = 48;
const MAX_DEPTH: usize = SAH_DEPTH + 32;

impl Bvh {
    pub(crate) fn new(boxes: &[Aabb]) -> Bvh {
        let mut bvh = Bvh {
            nodes: Vec::with_capacity(boxes.len()),
            items: (0..boxes.len() as u32).collect(),
        };
        let root = bvh.node(boxes, 0, boxes.len());
        bvh.nodes.push(root);
        if !boxes.is_empty() {
            bvh.split(boxes, 0, 0);
        }
        bvh
    }

    fn node(&self, boxes: &[Aabb], first: usize, count: usize) -> Node {
        let items = &self.items[first..first + count];
        Node {
            bounds: items
                .iter()
                .fold(Aabb::EMPTY, |sum, &item| sum.union(boxes[item as usize])),
            first: first as u32,
            count: count as u32,
        }
    }

    fn split(&mut self, boxes: &[Aabb], index: usize, depth: usize) {
        let Node { first, count, .. } = self.nodes[index];
        let (first, count) = (first as usize, count as usize);
        if count <= LEAF_ITEMS {
            return;
        }
        let left_count = self.partition(boxes, first, count, depth);
        let left = self.nodes.len();
        let children = [
            (first, left_count),
            (first + left_count, count - left_count),
        ];
        for (first, count) in children {
            let child = self.node(boxes, first, count);
            self.nodes.push(child);
        }
        self.nodes[index].first = left as u32;
        self.nodes[index].count = 0;
        self.split(boxes, left, depth + 1);
        self.split(boxes, left + 1, depth + 1);
    }

    /// Reorders the items of a node so that the first `n` of them go left, and returns `n`.
    fn partition(&mut self, boxes: &[Aabb], first: usize, count: usize, depth: usize) -> usize {
        let items = &mut self.items[first..first + count];
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
        count / 2
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
        let mut stack = [(0u32, 0f64); MAX_DEPTH];
        let mut height = 0;
        let Some(entry) = ray.enters(&self.nodes[0].bounds, from, limit) else {
            return;
        };
        let mut next = Some((0u32, entry));
        while let Some((index, entry)) = next {
            if entry <= limit {
                let node = &self.nodes[index as usize];
                if node.count > 0 {
                    for &item in self.leaf(node) {
                        if let Visit::Stop = visit(item, &mut limit) {
                            return;
                        }
                    }
                } else {
                    let enter = |child: u32| {
                        let bounds = &self.nodes[child as usize].bounds;
                        ray.enters(bounds, from, limit).map(|t| (child, t))
                    };
                    match (enter(node.first), enter(node.first + 1)) {
                        (Some(a), Some(b)) => {
                            let (near, far) = if a.1 <= b.1 { (a, b) } else { (b, a) };
                            stack[height] = far;
                            height += 1;
                            next = Some(near);
                            continue;
                        }
                        (Some(one), None) | (None, Some(one)) => {
                            next = Some(one);
                            continue;
                        }
                        (None, None) => {}
                    }
                }
            }
            next = height.checked_sub(1).map(|top| {
                height = top;
                stack[top]
            });
        }
    }

    /// Calls `visit(item)` for every item whose node's box overlaps `region`.
    pub(crate) fn within(&self, region: &Aabb, mut visit: impl FnMut(u32) -> Visit) {
        let mut stack = [0u32; MAX_DEPTH];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let node = &self.nodes[stack[height] as usize];
            if !node.bounds.overlaps(region) {
                continue;
            }
            if node.count == 0 {
                stack[height] = node.first + 1;
                stack[height + 1] = node.first;
                height += 2;
                continue;
            }
            for &item in self.leaf(node) {
                if let Visit::Stop = visit(item) {
                    return;
                }
            }
        }
    }

    fn leaf(&self, node: &Node) -> &[u32] {
        let first = node.first as usize;
        &self.items[first..first + node.count as usize]
    }
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
