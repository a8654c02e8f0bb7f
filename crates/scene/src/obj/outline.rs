//! The corners that a polygon turns at, and those on its edges.

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
        let turns = turns(corners, positions);
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

/// The places in the list of those corners that neither repeat their neighbours nor lie on a line
/// with them, once all others are gone.
fn turns(corners: &[u32], positions: &[DVec3]) -> Vec<usize> {
    let is_flat = |places: [usize; 3]| {
        let triangle = places.map(|place| positions[corners[place] as usize]);
        !has_area(triangle)
    };
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
        t > 0.0 && t < 1.0 && !has_area([at(from), at(corner), at(to)])
    };
    let mut inside: Vec<u32> = between.filter(is_inside).collect();
    inside.sort_by(|&a, &b| along(a).total_cmp(&along(b)));
    inside.dedup_by_key(|corner| along(*corner));
    inside
}
