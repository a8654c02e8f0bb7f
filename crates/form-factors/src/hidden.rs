//! Which part of a patch is hidden, by what rays from its cells have met: of each cell, the weights of
//! all rays and of those that met backs.

use radiosity_simd::LANES;

/// Where backs are more than this share of what a point sees, it lies inside of something, or right under
/// it. Under a low table that is open at its sides less is seen of backs, and some light arrives.
const HIDDEN: f64 = 0.95;
/// Where they are more than this in a cell of the first look, it may be hidden.
const SUSPICIOUS: f64 = 0.9;
/// And a part of it, where they are more than this, and twice what they are in all cells.
const PARTLY_SUSPICIOUS: f64 = 0.6;

/// Where on the patch eight rays started, the weight of each, and which of them met backs.
pub(crate) struct Starts {
    /// Coordinates from 0 to 1.
    pub(crate) on_patch: [[f64; LANES]; 2],
    pub(crate) weights: [f64; LANES],
    pub(crate) backs: u8,
}

/// Of a square of cells, so many along each edge, the weights of all rays and of those that met backs;
/// no cells if no ray did.
pub(crate) fn by_cell(starts: &[Starts], edge: usize) -> Vec<[f64; 2]> {
    if starts.iter().all(|starts| starts.backs == 0) {
        return Vec::new();
    }
    let mut cells = vec![[0.0; 2]; edge * edge];
    for starts in starts {
        let [u, v] = &starts.on_patch;
        for (lane, weight) in starts.weights.iter().enumerate() {
            let along = |x: f64| ((x * edge as f64) as usize).min(edge - 1);
            let cell = &mut cells[along(u[lane]) * edge + along(v[lane])];
            cell[0] += weight;
            cell[1] += weight * f64::from(starts.backs >> lane & 1);
        }
    }
    cells
}

/// Whether cells of which a patch sees backs by so much on average tell of a hidden part.
pub(crate) fn is_suspicious(cells: &[[f64; 2]], mean: f64) -> bool {
    let shares = cells.iter().map(|[all, backs]| backs / all);
    let most = shares.fold(0.0, f64::max);
    most > SUSPICIOUS || most > PARTLY_SUSPICIOUS && most > 2.0 * mean
}

/// The visible share of a square of cells, by the weights of their rays. A cell beside a hidden one may
/// be hidden in part, and then sees more of backs than cells elsewhere do. All is visible if there are no
/// cells.
pub(crate) fn visible_share(cells: &[[f64; 2]]) -> f64 {
    if cells.is_empty() {
        return 1.0;
    }
    let edge = cells.len().isqrt();
    let is_hidden = |cell: usize| cells[cell][1] > HIDDEN * cells[cell][0];
    let is_beside_hidden = |cell: usize| {
        let around = |k: usize| k.saturating_sub(1)..(k + 2).min(edge);
        let (i, j) = (cell / edge, cell % edge);
        around(i).any(|i| around(j).any(|j| is_hidden(edge * i + j)))
    };
    let sum = |cells: &[[f64; 2]]| {
        let all: f64 = cells.iter().map(|[all, _]| all).sum();
        let backs: f64 = cells.iter().map(|[_, backs]| backs).sum();
        (all, backs)
    };
    let clear = (0..cells.len()).filter(|&cell| !is_beside_hidden(cell));
    let clear: Vec<[f64; 2]> = clear.map(|cell| cells[cell]).collect();
    let (clear, clear_backs) = sum(&clear);
    let usual = if clear > 0.0 {
        clear_backs / clear
    } else {
        0.0
    };
    let visible = |cell: usize| {
        let [all, backs] = cells[cell];
        if is_hidden(cell) {
            0.0
        } else if is_beside_hidden(cell) {
            ((all - backs) / (1.0 - usual)).clamp(0.0, all)
        } else {
            all
        }
    };
    let (whole, _) = sum(cells);
    (0..cells.len()).map(visible).sum::<f64>() / whole
}
