//! A plane through values at places of a plane, by weighted least squares.

use crate::Rgb;

/// Determinants of less than this, where 1 is as good as it gets, tell no plane.
const FLAT: f64 = 1e-2;

/// Sums of a weighted least squares fit of `a + b u + c v`.
#[derive(Default)]
pub(super) struct PlaneFit {
    /// Of 1, u, v, u u, u v, v v.
    moments: [f64; 6],
    /// Of the values, times 1, u and v.
    values: [[f64; 3]; 3],
}

impl PlaneFit {
    /// Adds a place by its weight; `values` are its values times that weight.
    pub(super) fn add(&mut self, [u, v]: [f64; 2], weight: f64, values: [f64; 3]) {
        let terms = [1.0, u, v, u * u, u * v, v * v];
        for (moment, term) in self.moments.iter_mut().zip(terms) {
            *moment += weight * term;
        }
        for (sums, value) in self.values.iter_mut().zip(values) {
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum += value * term;
            }
        }
    }

    /// The plane's value where `u = v = 0`, but never less than nothing; the mean, if the places do
    /// not tell a plane.
    pub(super) fn at_center(&self) -> Rgb {
        let [one, u, v, uu, uv, vv] = self.moments;
        // Cofactors of the first column of the moments' matrix.
        let cofactors = [uu * vv - uv * uv, v * uv - u * vv, u * uv - v * uu];
        let determinant = one * cofactors[0] + u * cofactors[1] + v * cofactors[2];
        let is_told = determinant > FLAT * one * uu * vv;
        self.values.map(|values| {
            let at_center = if is_told {
                let products = values.iter().zip(cofactors).map(|(value, k)| value * k);
                products.sum::<f64>() / determinant
            } else {
                values[0] / one
            };
            at_center.max(0.0) as f32
        })
    }
}
