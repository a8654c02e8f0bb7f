//! Smooth interpolation on grids of cells of which the means are known: bicubic, with continuous
//! first derivatives.
//!
//! At the edge between two cells, value and slope are those of the polynomial that has the means of
//! the four cells around it, of the nearest three at the border (Colella & Woodward, "The Piecewise
//! Parabolic Method (PPM) for Gas-Dynamical Simulations", 1984, eq. 1.6-1.9). Between edges it is
//! the cubic with these values and slopes, so a cubic is reproduced inside. Two axes, one after the
//! other.

use crate::{Rgb, add_scaled};

/// The coefficients of `s^i t^j` at `4 i + j`, for `s` and `t` from 0 to 1 over a cell.
pub(crate) type Piece = [Rgb; 16];

/// Weights of cells in a row.
struct Stencil {
    first: usize,
    weights: Vec<f32>,
}

/// A piece for each of the cells `value(i, j)`, `i < a`, `j < b`, in row order.
pub(crate) fn pieces((a, b): (u32, u32), value: impl Fn(u32, u32) -> Rgb) -> Vec<Piece> {
    let (along, across) = (stencils(a as usize), stencils(b as usize));
    let (a, b) = (a as usize, b as usize);
    // For each row of cells, value and slope at the edges across it.
    let in_row = |i: usize| -> Vec<Rgb> {
        let sum = |stencil: &Stencil| {
            let mut sum = [0.0; 3];
            for (j, weight) in (stencil.first..).zip(&stencil.weights) {
                add_scaled(&mut sum, *weight, value(i as u32, j as u32));
            }
            sum
        };
        across.iter().flatten().map(sum).collect()
    };
    let rows: Vec<Vec<Rgb>> = (0..a).map(in_row).collect();
    let at_edge = |stencils: &[Stencil; 2]| -> [Vec<Rgb>; 2] {
        [0, 1].map(|k| {
            let stencil = &stencils[k];
            let sum = |column: usize| {
                let mut sum = [0.0; 3];
                for (i, weight) in (stencil.first..).zip(&stencil.weights) {
                    add_scaled(&mut sum, *weight, rows[i][column]);
                }
                sum
            };
            (0..2 * (b + 1)).map(sum).collect()
        })
    };
    let mut edges: Vec<[Vec<Rgb>; 2]> = along.iter().map(at_edge).collect();
    for (i, [at_corners, _]) in edges.iter_mut().enumerate() {
        for (j, corner) in at_corners.iter_mut().step_by(2).enumerate() {
            let rows = i.saturating_sub(1)..a.min(i + 1);
            let columns = j.saturating_sub(1)..b.min(j + 1);
            let around = rows.flat_map(|i| columns.clone().map(move |j| (i as u32, j as u32)));
            *corner = limited(*corner, around.map(|(i, j)| value(i, j)));
        }
    }
    let mut pieces = Vec::with_capacity(a * b);
    for ends in edges.windows(2) {
        for j in 0..b {
            pieces.push(piece(|k, l| ends[k / 2][k % 2][2 * j + l]));
        }
    }
    pieces
}

/// A corner's value, but no less than half of the least and no more than twice the greatest of the
/// cells around it: beside shadows that are smaller than cells, polynomials go astray.
fn limited(corner: Rgb, around: impl Iterator<Item = Rgb>) -> Rgb {
    let (mut low, mut high) = ([f32::INFINITY; 3], [0.0f32; 3]);
    for value in around {
        for c in 0..3 {
            (low[c], high[c]) = (low[c].min(value[c]), high[c].max(value[c]));
        }
    }
    std::array::from_fn(|c| corner[c].max(0.5 * low[c]).min(2.0 * high[c]))
}

/// For each edge of so many cells in a row, borders included, the stencils of value and slope.
fn stencils(cells: usize) -> Vec<[Stencil; 2]> {
    let of_edge = |edge: usize| {
        let is_inside = edge >= 2 && edge + 2 <= cells;
        let count = cells.min(if is_inside { 4 } else { 3 });
        let first = edge.saturating_sub(2).min(cells - count);
        fit(edge - first, count).map(|weights| Stencil { first, weights })
    };
    (0..=cells).map(of_edge).collect()
}

/// Of the polynomial that has the means of so many cells, value and slope at an edge: the first and
/// second derivative of the one that interpolates their sums, by Lagrange's formula.
fn fit(edge: usize, cells: usize) -> [Vec<f32>; 2] {
    let mut derivatives = [vec![0.0; cells + 1], vec![0.0; cells + 1]];
    let [values, slopes] = &mut derivatives;
    for (k, (value, slope)) in values.iter_mut().zip(slopes).enumerate() {
        let others: Vec<f64> = (0..=cells).filter(|&m| m != k).map(|m| m as f64).collect();
        let scale: f64 = others.iter().map(|m| k as f64 - m).product();
        // The product of (edge - m) over all others but one, and but two.
        let without = |skipped: &[usize]| -> f64 {
            let kept = others
                .iter()
                .enumerate()
                .filter(|(m, _)| !skipped.contains(m));
            kept.map(|(_, m)| edge as f64 - m).product()
        };
        for m in 0..cells {
            *value += without(&[m]) / scale;
            for n in (0..cells).filter(|&n| n != m) {
                *slope += without(&[m, n]) / scale;
            }
        }
    }
    // A cell is part of all sums that end beyond it.
    derivatives.map(|weights| {
        let of_cell = |cell: usize| weights[cell + 1..].iter().sum::<f64>() as f32;
        (0..cells).map(of_cell).collect()
    })
}

/// The cubics of value and slope at 0 and at 1, by coefficients.
const HERMITE: [[f32; 4]; 4] = [
    [1.0, 0.0, -3.0, 2.0],
    [0.0, 1.0, -2.0, 1.0],
    [0.0, 0.0, 3.0, -2.0],
    [0.0, 0.0, -1.0, 1.0],
];

/// The piece with values and slopes `corner(k, l)`, in either direction in the order of
/// [`HERMITE`].
fn piece(corner: impl Fn(usize, usize) -> Rgb) -> Piece {
    let mut piece = [[0.0; 3]; 16];
    for (k, along) in HERMITE.iter().enumerate() {
        for (l, across) in HERMITE.iter().enumerate() {
            let value = corner(k, l);
            for (index, coefficient) in piece.iter_mut().enumerate() {
                add_scaled(coefficient, along[index / 4] * across[index % 4], value);
            }
        }
    }
    piece
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const CELLS: (u32, u32) = (5, 7);

    fn at(u: f64, v: f64, value: impl Fn(u32, u32) -> f32) -> f32 {
        let pieces = pieces(CELLS, |i, j| [value(i, j); 3]);
        let cell = |t: f64, cells: u32| {
            let position = t * f64::from(cells);
            let cell = (position as u32).min(cells - 1);
            (cell, (position - f64::from(cell)) as f32)
        };
        let ((i, s), (j, t)) = (cell(u, CELLS.0), cell(v, CELLS.1));
        let piece = pieces[(i * CELLS.1 + j) as usize];
        let term = |(k, c): (usize, &Rgb)| s.powi((k / 4) as i32) * t.powi((k % 4) as i32) * c[0];
        piece.iter().enumerate().map(term).sum()
    }

    #[test]
    fn one_cell_is_constant_and_two_are_a_line() {
        let one = pieces((1, 1), |_, _| [3.0; 3])[0];
        assert_eq!(one[0], [3.0; 3]);
        assert!(one[1..].as_flattened().iter().all(|c| c.abs() < 1e-6));
        let two = pieces((1, 2), |_, j| [10.0 + j as f32; 3]);
        for (piece, start) in two.iter().zip([9.5, 10.5]) {
            assert!((piece[0][0] - start).abs() < 1e-5 && (piece[1][0] - 1.0).abs() < 1e-5);
        }
    }

    /// Where a shadow ends at the border, there is no less than half of the least.
    #[test]
    fn nothing_is_darker_than_dark() {
        let shadow = |i: u32, _| if i == 0 { 1.0 } else { 9.0 };
        for k in 0..=20 {
            let found = at(0.2 * f64::from(k) / 20.0, 0.5, shadow);
            assert!(found > 0.4, "{k} {found}");
        }
    }

    proptest! {
        #[test]
        fn constants_are_reproduced_everywhere(u in 0.0f64..=1.0, v in 0.0f64..=1.0) {
            prop_assert!((at(u, v, |_, _| 3.0) - 3.0).abs() < 1e-5);
        }

        /// From means over cells, whose integrals are those of x^2 and y^2.
        #[test]
        fn quadratics_are_reproduced_up_to_the_border(u in 0.0f64..=1.0, v in 0.0f64..=1.0) {
            let f = |x: f64, y: f64| 40.0 + 2.0 * x - y + 0.5 * x * y + x * x - 0.25 * y * y;
            let mean = |i: u32, j: u32| {
                let center = f(f64::from(i) + 0.5, f64::from(j) + 0.5);
                (center + (1.0 - 0.25) / 12.0) as f32
            };
            let expected = f(u * 5.0, v * 7.0);
            prop_assert!((f64::from(at(u, v, mean)) - expected).abs() < 1e-4);
        }

        /// Inside, cubics are too: the mean of x^3 over a cell around c is c^3 + c / 4.
        #[test]
        fn cubics_are_reproduced_inside(u in 0.4f64..=0.6, v in 0.3f64..=0.7) {
            let mean = |i: u32, j: u32| {
                let (x, y) = (f64::from(i) + 0.5, f64::from(j) + 0.5);
                (400.0 + x.powi(3) + x / 4.0 - y.powi(3) - y / 4.0) as f32
            };
            let expected = 400.0 + (u * 5.0).powi(3) - (v * 7.0).powi(3);
            prop_assert!((f64::from(at(u, v, mean)) - expected).abs() < 1e-3);
        }

        /// No jump anywhere, cell borders included.
        #[test]
        fn the_interpolant_is_continuous(u in 0.0f64..0.999, v in 0.0f64..1.0) {
            let value = |i: u32, j: u32| ((7 * i + 3 * j) % 5) as f32;
            let step = 1e-6;
            // The slope is at most 5 values times 7 cells times 4.
            prop_assert!((at(u + step, v, value) - at(u, v, value)).abs() < 2e-4);
        }
    }
}
