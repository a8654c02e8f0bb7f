//! Triangles between two lines that are cut into pieces: rungs join a vertex of the more finely cut
//! line to the vertex of the other that is nearest along the base.

use std::cmp::Ordering;

/// The part of a row that is between its base and an edge of the face. All counts are from the
/// apex, where the two meet. Without base there is none.
#[derive(Clone, Copy)]
pub(super) struct Needle {
    /// Pieces of the base.
    pub(super) base: u32,
    /// Pieces of the edge.
    pub(super) side: u32,
    /// How far the edge goes along the base, in pieces of the base.
    pub(super) extent: f64,
}

impl Needle {
    /// Each between two rungs, the first one between the apex and a rung.
    pub(super) fn cells(self) -> u32 {
        match self.base {
            0 => 0,
            base => base.max(self.side),
        }
    }

    /// How many pieces of the base and of the edge are between the apex and a rung. Each rung is
    /// one piece further than the one before on the line of more pieces, and at most one on the
    /// other.
    pub(super) fn rung(self, k: u32) -> [u32; 2] {
        let Needle { base, side, extent } = self;
        let nearest = |pieces: f64| pieces.round() as u32;
        let on_coarser = |nearest: u32, fine: u32, coarse: u32| {
            let least = k.min(1).max((coarse + k).saturating_sub(fine));
            nearest.max(least).min(k).min(coarse)
        };
        match base.cmp(&side) {
            Ordering::Equal => [k, k],
            Ordering::Greater => {
                let reached = nearest(f64::from(k) / extent * f64::from(side));
                [k, on_coarser(reached, base, side)]
            }
            Ordering::Less => {
                let reached = nearest(f64::from(k) / f64::from(side) * extent);
                [on_coarser(reached, side, base), k]
            }
        }
    }

    /// The cell at a place, given from the edge along the base, in pieces of the base, and in
    /// heights above the base.
    pub(super) fn cell_at(self, from_edge: f64, height: f64) -> u32 {
        let is_beyond = |k: u32| {
            let [base, side] = self.rung(k).map(f64::from);
            from_edge / base + height * f64::from(self.side) / side > 1.0
        };
        let (mut low, mut high) = (0, self.cells() - 1);
        while low < high {
            let middle = low.midpoint(high);
            if is_beyond(middle + 1) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        low
    }

    /// The length of the longest rung, for pieces of the base as long as this and rows of this
    /// height.
    pub(super) fn longest_rung(self, piece: f64, height: f64) -> f64 {
        let length = |k: u32| {
            let [base, side] = self.rung(k).map(f64::from);
            let risen = side / f64::from(self.side);
            f64::hypot((base - risen * self.extent) * piece, risen * height)
        };
        (1..=self.cells()).map(length).fold(0.0, f64::max)
    }
}
