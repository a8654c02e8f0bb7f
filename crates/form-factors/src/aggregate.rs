//! Form factors between sets of patches.

use crate::{FormFactors, RowFacts, quotient};

/// Form factors between *parts*: sets of patches, each patch in one of them.
///
/// `F_AB`, the share of the power leaving part `A`, which radiates evenly, that arrives at part
/// `B`, is the mean of its patches' shares, weighted by area:
/// `sum_{i in A, j in B} A_i F_ij / A_A`.
#[derive(Clone, Debug, PartialEq)]
pub struct AggregateFactors {
    /// The area of each part, in square scene units.
    pub areas: Vec<f64>,
    /// The facts of each part, as of one large patch. `fronts` includes what a part sees of itself.
    pub rows: Vec<RowFacts>,
    factors: Vec<f64>,
}

impl AggregateFactors {
    /// `F_AB`.
    pub fn factor(&self, a: usize, b: usize) -> f64 {
        self.factors[a * self.areas.len() + b]
    }

    /// A bound of the estimated error of `F_AB`, if the estimator tells its errors: those of
    /// whole rows, from either side, so it is the better the more of the light goes this way.
    pub fn error(&self, a: usize, b: usize) -> Option<f64> {
        let power = |part: usize| Some(self.areas[part] * self.rows[part].error?);
        Some(quotient(power(a)?.min(power(b)?), self.areas[a]))
    }
}

impl FormFactors {
    /// The form factors between parts; `part_of[i]`, below `parts`, is that of patch `i`, and no
    /// part is empty.
    pub fn aggregate(&self, part_of: &[usize], parts: usize) -> AggregateFactors {
        let mut areas = vec![0.0; parts];
        for (&part, area) in part_of.iter().zip(&self.areas) {
            areas[part] += area;
        }
        let mut factors = self.exchange.exchange_areas_between(part_of, parts);
        for (row, area) in factors.chunks_mut(parts.max(1)).zip(&areas) {
            row.iter_mut()
                .for_each(|factor| *factor = quotient(*factor, *area));
        }
        AggregateFactors {
            rows: self.aggregate_rows(part_of, &areas),
            areas,
            factors,
        }
    }

    fn aggregate_rows(&self, part_of: &[usize], areas: &[f64]) -> Vec<RowFacts> {
        let blank = RowFacts {
            error: Some(0.0),
            ..RowFacts::default()
        };
        let mut aggregate = vec![blank; areas.len()];
        for ((&part, row), area) in part_of.iter().zip(&self.rows).zip(&self.areas) {
            let sum = &mut aggregate[part];
            let weight = quotient(*area, areas[part]);
            sum.fronts += weight * row.fronts;
            sum.backs += weight * row.backs;
            sum.background += weight * row.background;
            sum.visible += weight * row.visible;
            sum.missed += weight * row.missed;
            // Rays of different patches are independent.
            sum.rays_error = sum.rays_error.hypot(weight * row.rays_error);
            sum.error = (sum.error.zip(row.error)).map(|(sum, error)| sum + weight * error);
        }
        aggregate
    }
}
