//! Smooth interpolation on grids of cells: bicubic Catmull-Rom
//! (Catmull & Rom, "A Class of Local Interpolating Splines", 1974; Keys 1981).
//!
//! Interpolates the cells' values at their centres and is continuous with its first derivatives.
//! Cells beyond the border repeat the border cell.

use crate::{Rgb, add_scaled};

/// The value at `(u, v)` of the unit square for cells `value(i, j)`, `i < a`, `j < b`.
pub(crate) fn bicubic(
    (u, v): (f64, f64),
    (a, b): (u32, u32),
    value: impl Fn(u32, u32) -> Rgb,
) -> Rgb {
    let (i0, weights_a) = stencil(u, a);
    let (j0, weights_b) = stencil(v, b);
    let mut sum = [0.0; 3];
    for (i, weight_a) in (i0..).zip(weights_a) {
        for (j, weight_b) in (j0..).zip(weights_b) {
            add_scaled(
                &mut sum,
                weight_a * weight_b,
                value(clamp(i, a), clamp(j, b)),
            );
        }
    }
    sum
}

/// The first of the four cells around position `t` in [0, 1], and their weights.
fn stencil(t: f64, cells: u32) -> (i64, [f32; 4]) {
    let position = t * f64::from(cells) - 0.5;
    let cell = position.floor();
    (cell as i64 - 1, catmull_rom((position - cell) as f32))
}

fn catmull_rom(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        0.5 * (-t + 2.0 * t2 - t3),
        0.5 * (2.0 - 5.0 * t2 + 3.0 * t3),
        0.5 * (t + 4.0 * t2 - 3.0 * t3),
        0.5 * (t3 - t2),
    ]
}

fn clamp(index: i64, cells: u32) -> u32 {
    index.clamp(0, i64::from(cells) - 1) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const CELLS: (u32, u32) = (5, 7);

    fn at(u: f64, v: f64, value: impl Fn(u32, u32) -> f32) -> f32 {
        bicubic((u, v), CELLS, |i, j| [value(i, j); 3])[0]
    }

    fn center(i: u32, cells: u32) -> f64 {
        (f64::from(i) + 0.5) / f64::from(cells)
    }

    #[test]
    fn cell_values_are_met_at_cell_centres() {
        let value = |i: u32, j: u32| (3 * i + j * j) as f32;
        for i in 0..CELLS.0 {
            for j in 0..CELLS.1 {
                let found = at(center(i, CELLS.0), center(j, CELLS.1), value);
                assert!((found - value(i, j)).abs() < 1e-4);
            }
        }
    }

    proptest! {
        #[test]
        fn constants_are_reproduced_everywhere(u in 0.0f64..=1.0, v in 0.0f64..=1.0) {
            prop_assert!((at(u, v, |_, _| 3.0) - 3.0).abs() < 1e-5);
        }

        /// Catmull-Rom reproduces quadratics where its stencil stays inside.
        #[test]
        fn quadratics_are_reproduced_inside(u in 0.31f64..0.69, v in 0.22f64..0.78) {
            let f = |x: f64, y: f64| 1.0 + 2.0 * x - y + 0.5 * x * y + x * x - 0.25 * y * y;
            let found = at(u, v, |i, j| f(f64::from(i), f64::from(j)) as f32);
            let expected = f(u * 5.0 - 0.5, v * 7.0 - 0.5);
            prop_assert!((f64::from(found) - expected).abs() < 1e-4);
        }

        /// No jump anywhere, cell borders included.
        #[test]
        fn the_interpolant_is_continuous(u in 0.0f64..0.999, v in 0.0f64..1.0) {
            let value = |i: u32, j: u32| ((7 * i + 3 * j) % 5) as f32;
            let step = 1e-6;
            // The slope is at most 5 values times 7 cells times 2.
            prop_assert!((at(u + step, v, value) - at(u, v, value)).abs() < 1e-4);
        }
    }
}
