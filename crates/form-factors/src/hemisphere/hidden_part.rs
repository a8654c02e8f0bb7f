//! Which part of a patch is hidden, by what rays from its cells have met.

use crate::hemisphere::front_walls::FirstHits;
use radiosity_simd::LANES;

/// Where backs are more than this share of what a point sees, it lies inside of something, or right
/// under it. Under a low table that is open at its sides less is seen of backs, and some light
/// arrives.
const HIDDEN: f64 = 0.95;
/// Where they are more than this in a cell of the first look, it may be hidden.
const SUSPICIOUS: f64 = 0.9;
/// And a part of it, where they are more than this, and twice what they are in all cells.
const PARTLY_SUSPICIOUS: f64 = 0.6;
/// Cells of which fewer rays than this share tell something do not count. In a corner under a tall
/// box a quarter of them does, in a niche less.
const ENOUGH: f64 = 1.0 / 16.0;

/// Where on the patch eight rays started, the weight of each, and which of them met backs.
pub(crate) struct Starts {
    /// Coordinates from 0 to 1.
    pub(crate) on_patch: [[f64; LANES]; 2],
    pub(crate) weights: [f64; LANES],
    pub(crate) met: FirstHits,
}

/// What rays from a part of a patch have met, by their weights.
///
/// Fronts that have backs in the same place tell nothing, unless these are their own reverse: there
/// may be a box against a wall, over a floor that is hidden, or another room behind it.
#[derive(Clone, Copy, Default)]
pub(crate) struct PatchCell {
    all: f64,
    telling: f64,
    backs: f64,
}

impl PatchCell {
    fn tells(&self) -> bool {
        self.telling > ENOUGH * self.all
    }

    /// The share of backs.
    fn backs(&self) -> f64 {
        if self.tells() {
            self.backs / self.telling
        } else {
            0.0
        }
    }

    fn add(&mut self, other: &PatchCell) {
        self.all += other.all;
        self.telling += other.telling;
        self.backs += other.backs;
    }

    fn sum<'a>(cells: impl IntoIterator<Item = &'a PatchCell>) -> PatchCell {
        let mut sum = PatchCell::default();
        cells.into_iter().for_each(|cell| sum.add(cell));
        sum
    }
}

/// A square of cells, so many along each edge; none if no ray met a back.
pub(crate) fn by_cell(starts: &[Starts], edge: usize) -> Vec<PatchCell> {
    if starts.iter().all(|starts| starts.met.backs == 0) {
        return Vec::new();
    }
    let mut cells = vec![PatchCell::default(); edge * edge];
    for starts in starts {
        let [u, v] = &starts.on_patch;
        for (lane, &weight) in starts.weights.iter().enumerate() {
            let along = |x: f64| ((x * edge as f64) as usize).min(edge - 1);
            let weight_in = |mask: u8| weight * f64::from(mask >> lane & 1);
            cells[along(u[lane]) * edge + along(v[lane])].add(&PatchCell {
                all: weight,
                telling: weight_in(!starts.met.backed),
                backs: weight_in(starts.met.backs),
            });
        }
    }
    cells
}

/// Whether a part of the patch may be hidden.
pub(crate) fn is_suspicious(cells: &[PatchCell]) -> bool {
    let most = cells.iter().map(PatchCell::backs).fold(0.0, f64::max);
    most > SUSPICIOUS || most > PARTLY_SUSPICIOUS && most > 2.0 * PatchCell::sum(cells).backs()
}

/// The visible share of a square of cells, of which some tell. A cell beside a hidden one may be
/// hidden in part, and then sees more of backs than cells elsewhere do. All is visible if no cell
/// tells.
pub(crate) fn visible_share(cells: &[PatchCell]) -> f64 {
    let edge = cells.len().isqrt();
    let is_hidden = |cell: usize| cells[cell].backs() > HIDDEN;
    let is_beside_hidden = |cell: usize| {
        let around = |k: usize| k.saturating_sub(1)..(k + 2).min(edge);
        let (i, j) = (cell / edge, cell % edge);
        around(i).any(|i| around(j).any(|j| is_hidden(edge * i + j)))
    };
    let clear = (0..cells.len()).filter(|&cell| !is_beside_hidden(cell));
    let usual = PatchCell::sum(clear.map(|cell| &cells[cell])).backs();
    let visible = |cell: usize| {
        if is_hidden(cell) {
            0.0
        } else if is_beside_hidden(cell) {
            ((1.0 - cells[cell].backs()) / (1.0 - usual)).clamp(0.0, 1.0)
        } else {
            1.0
        }
    };
    let (mut whole, mut seen) = (0.0, 0.0);
    for (index, cell) in cells.iter().enumerate().filter(|(_, cell)| cell.tells()) {
        whole += cell.all;
        seen += cell.all * visible(index);
    }
    if whole > 0.0 { seen / whole } else { 1.0 }
}
