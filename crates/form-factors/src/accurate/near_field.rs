//! The exchange of two patches with nothing between them, however near, and whatever their sizes.
//!
//! The contour integral has closed forms for patches that touch, but loses the digits of what is
//! small beside large. Where it would lose too many, polygons are halved, the larger one first:
//! pieces with edges far from the smaller one are integrated by Lambert's formula, and the others
//! become as small as that one is.

use crate::accurate::PairEstimate;
use crate::accurate::contour::{self, Integral};
use crate::accurate::lambert;
use crate::accurate::patch_quadrature::{Corners, PatchQuadrature};
use radiosity_geometry::{DVec3, area_around};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// What halving edges leaves, relative to the exchange.
const CONTOUR_ERROR: f64 = 1e-8;
/// Rounding may cost this, as a form factor of the smaller patch.
const ROUNDING: f64 = 1e-9;
/// Polygons are halved until their longest edges are within this factor. What rounding costs then,
/// as of needles, halving does not mend.
const SIMILAR: f64 = 8.0;
/// So many pieces are integrated at most; what is left of rounding is told.
const MOST_PIECES: usize = 4096;

/// A convex polygon and the normal of its front.
#[derive(Clone)]
struct Side {
    corners: Corners,
    normal: DVec3,
}

/// Two polygons, and their contour integral. The largest has lost most by rounding.
struct Piece {
    sides: [Side; 2],
    integral: Integral,
}

/// `A_i F_ij` of two patches, if nothing stood between them, over what either has in front of the
/// other. `tolerance` is the height up to which a corner counts as in a plane.
pub(crate) fn exchange(i: &PatchQuadrature, j: &PatchQuadrature, tolerance: f64) -> PairEstimate {
    let parts = (
        j.clip(i.corners(), tolerance),
        i.clip(j.corners(), tolerance),
    );
    let (Some(part_i), Some(part_j)) = parts else {
        return PairEstimate::clear(0.0, 0.0);
    };
    let sides = [(part_i, i.normal), (part_j, j.normal)];
    let whole = Piece::new(
        sides.map(|(corners, normal)| Side { corners, normal }),
        tolerance,
    );
    let Integral { value, rounding } = in_pieces(whole, tolerance);
    // Parts that barely see each other may come out below zero, by rounding. What is no number
    // stays so.
    let value = if value < 0.0 { 0.0 } else { value };
    PairEstimate::clear(value, CONTOUR_ERROR * value + rounding)
}

/// The exchange of two polygons, halved as long as rounding costs too much.
fn in_pieces(whole: Piece, tolerance: f64) -> Integral {
    let areas = whole.sides.each_ref().map(Side::area);
    let most = ROUNDING * areas[0].min(areas[1]);
    let mut done = Integral::default();
    let mut lost = whole.integral.rounding;
    let mut pieces = BinaryHeap::from([whole]);
    let mut count = 1;
    while lost > most
        && count < MOST_PIECES
        && let Some(worst) = pieces.pop()
    {
        lost -= worst.integral.rounding;
        if are_similar(&worst.sides) {
            done.add(worst.integral);
            continue;
        }
        for sides in halved(worst.sides) {
            count += 1;
            if let Some(found) = by_lambert(&sides) {
                done.add(found);
                continue;
            }
            let piece = Piece::new(sides, tolerance);
            lost += piece.integral.rounding;
            pieces.push(piece);
        }
    }
    let rest = pieces.into_vec();
    rest.iter().for_each(|piece| done.add(piece.integral));
    done
}

fn are_similar(sides: &[Side; 2]) -> bool {
    let [a, b] = sides.each_ref().map(Side::longest_edge);
    a.max(b) <= SIMILAR * a.min(b)
}

/// Pairs of what is left when the larger of two polygons is halved.
fn halved([i, j]: [Side; 2]) -> [[Side; 2]; 2] {
    if i.longest_edge() < j.longest_edge() {
        j.halves().map(|half| [i.clone(), half])
    } else {
        i.halves().map(|half| [half, j.clone()])
    }
}

/// The exchange where the edges of the larger polygon are far from the smaller one.
fn by_lambert([i, j]: &[Side; 2]) -> Option<Integral> {
    let (small, large) = if i.longest_edge() < j.longest_edge() {
        (i, j)
    } else {
        (j, i)
    };
    lambert::exchange(&small.corners, small.normal, &large.corners)
}

impl Piece {
    fn new(sides: [Side; 2], tolerance: f64) -> Piece {
        let [i, j] = &sides;
        let integral = contour::exchange(&i.corners, &j.corners, tolerance);
        Piece { sides, integral }
    }
}

impl Ord for Piece {
    fn cmp(&self, other: &Piece) -> Ordering {
        self.integral.rounding.total_cmp(&other.integral.rounding)
    }
}

impl PartialOrd for Piece {
    fn partial_cmp(&self, other: &Piece) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Piece {
    fn eq(&self, other: &Piece) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Piece {}

impl Side {
    fn area(&self) -> f64 {
        area_around(&self.corners, self.normal)
    }

    fn edges(&self) -> impl Iterator<Item = [DVec3; 2]> {
        let n = self.corners.len();
        (0..n).map(move |k| [self.corners[k], self.corners[(k + 1) % n]])
    }

    fn longest_edge(&self) -> f64 {
        let lengths = self.edges().map(|[from, to]| from.distance(to));
        lengths.fold(0.0, f64::max)
    }

    /// Of three corners, two triangles from the middle of the longest edge; of more, a triangle and
    /// the rest.
    fn halves(&self) -> [Side; 2] {
        let side = |corners: Corners| Side {
            corners,
            normal: self.normal,
        };
        let n = self.corners.len();
        if n > 3 {
            let rest = self.corners[2..].iter().chain([&self.corners[0]]);
            let triangle = self.corners[..3].iter().copied().collect();
            return [side(triangle), side(rest.copied().collect())];
        }
        let length = |[from, to]: [DVec3; 2]| from.distance_squared(to);
        let lengths = self.edges().map(length).enumerate();
        let longest = lengths.max_by(|(_, a), (_, b)| a.total_cmp(b));
        let first = longest.map_or(0, |(k, _)| k);
        let [a, b, c] = [0, 1, 2].map(|k| self.corners[(first + k) % n]);
        let middle = 0.5 * (a + b);
        [[a, middle, c], [middle, b, c]].map(|corners| side(corners.into_iter().collect()))
    }
}

#[cfg(test)]
mod tests;
