//! The exchange of two patches with nothing between them, however near.

use crate::accurate::Exchange;
use crate::contour;
use crate::element::Element;

/// What halving edges leaves, relative to the exchange.
const CONTOUR_ERROR: f64 = 1e-8;

/// `S_ij` of two patches, if nothing stood between them, by the contour integral over what either
/// has in front of the other. `tolerance` is the height up to which a corner counts as in a plane.
pub(crate) fn exchange(i: &Element, j: &Element, tolerance: f64) -> Exchange {
    let parts = (
        j.clip(i.corners(), tolerance),
        i.clip(j.corners(), tolerance),
    );
    let (Some(part_i), Some(part_j)) = parts else {
        return Exchange::clear(0.0, 0.0);
    };
    let value = contour::exchange(&part_i, &part_j, tolerance);
    debug_assert!(value.is_finite());
    // Parts that barely see each other may come out below zero, by rounding.
    let value = value.max(0.0);
    Exchange::clear(value, CONTOUR_ERROR * value)
}
