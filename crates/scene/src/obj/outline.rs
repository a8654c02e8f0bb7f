//! The corners that a polygon turns at, and those on its edges.

use super::ROUNDING;
use radiosity_geometry::{DVec3, has_area};

/// A polygon without the corners that change nothing of its area.
pub(super) struct Outline {
    /// Those it turns at; fewer than three if it has no area.
    pub(super) corners: Vec<u32>,
    /// Those on the edge that begins at each corner, in order; empty if no corner was left out.
    pub(super) on_edges: Vec<Vec<u32>>,
}

impl Outline {
    pub(super) fn of(corners: &[u32], positions: &[DVec3]) -> Outline {
        let mut turns = turns_of(corners, positions, is_straight);
        if turns.len() < 3 {
            // It may be narrow.
            turns = turns_of(corners, positions, |triangle| !has_area(triangle));
        }
        let mut outline = Outline {
            corners: turns.iter().map(|&k| corners[k]).collect(),
            on_edges: Vec::new(),
        };
        if turns.len() < corners.len() && turns.len() >= 3 {
            let count = corners.len();
            let next_turns = turns.iter().cycle().skip(1);
            let edges = turns.iter().zip(next_turns);
            outline.on_edges = edges
                .map(|(&from, &to)| {
                    let length = (to + count - from) % count;
                    let between = (1..length).map(|k| corners[(from + k) % count]);
                    on_edge(corners[from], corners[to], between, positions)
                })
                .collect();
        }
        outline
    }

    pub(super) fn has_area(&self) -> bool {
        self.corners.len() >= 3
    }

    /// Keeps those corners on edges that are wanted.
    pub(super) fn retain_on_edges(&mut self, is_wanted: impl Fn(u32) -> bool) {
        for on_edge in &mut self.on_edges {
            on_edge.retain(|&corner| is_wanted(corner));
        }
    }
}

/// Whether a way over three points goes on in its direction but for rounding, or comes back on
/// itself.
fn is_straight([a, b, c]: [DVec3; 3]) -> bool {
    let (to, on) = (b - a, c - b);
    let turn = to.cross(on).length();
    let goes_on = to.dot(on) > 0.0 && turn <= ROUNDING * to.length() * on.length();
    goes_on || !has_area([a, b, c])
}

/// The places in the list of those corners that neither repeat their neighbours nor lie on a line
/// with them, once all others are gone.
fn turns_of(
    corners: &[u32],
    positions: &[DVec3],
    is_line: impl Fn([DVec3; 3]) -> bool,
) -> Vec<usize> {
    let is_flat =
        |places: [usize; 3]| is_line(places.map(|place| positions[corners[place] as usize]));
    let mut kept: Vec<usize> = Vec::with_capacity(corners.len());
    for next in 0..corners.len() {
        while let [.., a, b] = kept[..]
            && is_flat([a, b, next])
        {
            kept.pop();
        }
        kept.push(next);
    }
    // The same where the end meets the beginning.
    let mut first = 0;
    while let [a, b, .., y, z] = kept[first..] {
        if is_flat([y, z, a]) {
            kept.pop();
        } else if is_flat([z, a, b]) {
            first += 1;
        } else {
            break;
        }
    }
    kept.split_off(first)
}

/// Those of some corners that lie between two others, in the order along the edge.
fn on_edge(
    from: u32,
    to: u32,
    between: impl Iterator<Item = u32>,
    positions: &[DVec3],
) -> Vec<u32> {
    let at = |corner: u32| positions[corner as usize];
    let edge = at(to) - at(from);
    let along = |corner: u32| edge.dot(at(corner) - at(from)) / edge.length_squared();
    let is_inside = |&corner: &u32| {
        let t = along(corner);
        let off = edge.cross(at(corner) - at(from)).length();
        t > 0.0 && t < 1.0 && off <= ROUNDING * edge.length_squared()
    };
    let mut inside: Vec<u32> = between.filter(is_inside).collect();
    inside.sort_by(|&a, &b| along(a).total_cmp(&along(b)));
    inside.dedup_by_key(|corner| along(*corner));
    inside
}
