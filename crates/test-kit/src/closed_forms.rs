//! Pairs of patches whose form factors are known.
//!
//! Formulas: Ehlert & Smith, "View factors for perpendicular and parallel rectangular plates"
//! (1993), of which C-11, C-13 and C-14 of Howell, "A Catalog of Radiation Heat Transfer
//! Configuration Factors", are cases. For hinged squares (C-16) the catalog has an integral; its
//! values are constants here.

use crate::shapes::{Facing, hinged, parallelogram, square};
use radiosity_geometry::Shape;
use std::f64::consts::TAU;

/// A pair, and its form factor.
#[derive(Clone, Debug)]
pub struct ClosedForm {
    /// What the pair is.
    pub name: &'static str,
    /// Nothing stands between them.
    pub pair: [Shape; 2],
    /// From the first to the second, to twelve digits.
    pub factor: f64,
    /// How near they come; where they touch, the kernel has no bound.
    pub gap: f64,
    /// The longest edge of both.
    pub longest_edge: f64,
}

type Range = [f64; 2];

/// The table.
pub fn closed_forms() -> Vec<ClosedForm> {
    let mut all = vec![
        facing_squares("equal squares that face each other", 1.0, 1.0),
        facing_squares("a square and one of four times its area", 2.0, 1.0),
        facing_squares("equal squares near each other", 1.0, 0.1),
        facing_squares("equal squares far apart", 1.0, 10.0),
        shifted_rectangles(),
        perpendicular_rectangles_apart(),
    ];
    all.extend(HINGED.map(hinged_squares));
    all
}

/// The rows of the table in which patches do not touch.
pub fn closed_forms_apart() -> impl Iterator<Item = ClosedForm> {
    closed_forms().into_iter().filter(|row| row.gap > 0.0)
}

/// The rows of the table in which patches touch.
pub fn closed_forms_touching() -> impl Iterator<Item = ClosedForm> {
    closed_forms().into_iter().filter(|row| row.gap == 0.0)
}

/// A unit square and a square above its middle.
fn facing_squares(name: &'static str, edge: f64, distance: f64) -> ClosedForm {
    let (below, above) = ([-0.5, 0.5], [-0.5 * edge, 0.5 * edge]);
    ClosedForm {
        name,
        pair: [
            square([0.0; 2], 1.0, 0.0, Facing::Up),
            square([0.0; 2], edge, distance, Facing::Down),
        ],
        factor: parallel_rectangles([below; 2], [above; 2], distance),
        gap: distance,
        longest_edge: edge.max(1.0),
    }
}

fn shifted_rectangles() -> ClosedForm {
    ClosedForm {
        name: "parallel rectangles beside each other",
        pair: [
            parallelogram([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
            parallelogram([1.5, 0.5, 0.7], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]),
        ],
        factor: parallel_rectangles([[0.0, 1.0]; 2], [[1.5, 3.5], [0.5, 1.5]], 0.7),
        gap: 0.5_f64.hypot(0.7),
        longest_edge: 2.0,
    }
}

fn perpendicular_rectangles_apart() -> ClosedForm {
    ClosedForm {
        name: "rectangles at a right angle, apart",
        pair: [
            parallelogram([0.5, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
            parallelogram([0.0, 0.5, 0.25], [0.0, 1.5, 0.0], [0.0, 0.0, 2.0]),
        ],
        factor: perpendicular_rectangles([0.5, 1.5], [0.25, 2.25], [[0.0, 1.0], [0.5, 2.0]]),
        gap: 0.5_f64.hypot(0.25),
        longest_edge: 2.0,
    }
}

/// Degrees between unit squares that share an edge, and the factor: at 90 degrees by the formula
/// below, at others by double-exponential quadrature of Lambert's formula, which gives all digits
/// of that one.
const HINGED: [(&str, f64, f64); 4] = [
    ("squares hinged at 30 degrees", 30.0, 0.619_028_323_091),
    ("squares hinged at 60 degrees", 60.0, 0.370_905_321_150),
    ("squares hinged at a right angle", 90.0, 0.200_043_776_075),
    ("squares hinged at 135 degrees", 135.0, 0.048_309_447_802),
];

fn hinged_squares((name, degrees, factor): (&'static str, f64, f64)) -> ClosedForm {
    ClosedForm {
        name,
        pair: hinged(degrees),
        factor,
        gap: 0.0,
        longest_edge: 1.0,
    }
}

/// From a rectangle to a parallel one in front of it: where both reach along x and y, and their
/// distance.
pub fn parallel_rectangles(from: [Range; 2], to: [Range; 2], distance: f64) -> f64 {
    let squared = distance * distance;
    let corner = |x: f64, y: f64| {
        let arc = |along: f64, beside: f64| {
            let length = beside.hypot(distance);
            along * length * along.atan2(length)
        };
        let all = x * x + y * y + squared;
        (arc(y, x) + arc(x, y) - 0.5 * squared * all.ln()) / TAU
    };
    let of_corners = signed_sum(from[0], to[0], |x, u| {
        signed_sum(from[1], to[1], |y, v| corner(x - u, y - v))
    });
    of_corners / area(from)
}

/// From a rectangle to one in a plane at a right angle to its own: how far both reach from the line
/// in which these planes cross, and where both reach along it.
pub fn perpendicular_rectangles(from: Range, to: Range, along: [Range; 2]) -> f64 {
    let corner = |x: f64, z: f64, y: f64| {
        let (length, all) = (x.hypot(z), x * x + z * z + y * y);
        let logarithm = if all > 0.0 { all.ln() } else { 0.0 };
        let squares = x * x + z * z - y * y;
        (y * length * y.atan2(length) - 0.25 * squares * logarithm) / TAU
    };
    let of_corners = signed_sum(from, to, |x, z| {
        signed_sum(along[0], along[1], |y, v| corner(x, z, y - v))
    });
    of_corners / area([from, along[0]])
}

/// Over the four pairs of ends, negative where one is a lower and one an upper end.
fn signed_sum(from: Range, to: Range, term: impl Fn(f64, f64) -> f64) -> f64 {
    let [a, b] = from;
    let [c, d] = to;
    term(a, c) - term(a, d) - term(b, c) + term(b, d)
}

fn area([x, y]: [Range; 2]) -> f64 {
    (x[1] - x[0]) * (y[1] - y[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// To the digits that are published.
    #[test]
    fn formulas_give_published_values() {
        let unit = [[0.0, 1.0]; 2];
        let around = [[-0.5, 1.5]; 2];
        let published = [
            (parallel_rectangles(unit, unit, 1.0), 0.199_824_896),
            (parallel_rectangles(unit, around, 1.0), 0.517_653_080),
            (parallel_rectangles(unit, unit, 0.1), 0.826_994_522),
            (parallel_rectangles(unit, unit, 10.0), 0.003_162_057),
            (
                perpendicular_rectangles(unit[0], unit[0], unit),
                HINGED[2].2,
            ),
        ];
        for (found, expected) in published {
            assert!((found - expected).abs() < 6e-10, "{found}, not {expected}");
        }
    }

    /// From the floor of a closed room all light arrives at its lid and its walls.
    #[test]
    fn rows_sum_to_one() {
        let (width, height, length) = (2.0, 1.5, 3.0);
        let floor = [[0.0, width], [0.0, length]];
        let lid = parallel_rectangles(floor, floor, height);
        let side = perpendicular_rectangles([0.0, width], [0.0, height], [[0.0, length]; 2]);
        let end = perpendicular_rectangles([0.0, length], [0.0, height], [[0.0, width]; 2]);
        assert!((lid + 2.0 * side + 2.0 * end - 1.0).abs() < 1e-12);
    }
}
