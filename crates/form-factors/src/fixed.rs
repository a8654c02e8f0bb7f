//! Sums that do not depend on the order in which threads add to them.

use std::sync::atomic::{AtomicU64, Ordering};

/// Sums of positive numbers, up to 2^24, in units of 2^-40: rounding the numbers up to whole units
/// makes their addition exact, and so commutative.
pub(crate) struct FixedSums(Vec<AtomicU64>);

const UNITS: f64 = (1u64 << 40) as f64;

impl FixedSums {
    pub(crate) fn new(count: usize) -> FixedSums {
        FixedSums((0..count).map(|_| AtomicU64::new(0)).collect())
    }

    pub(crate) fn add(&self, index: usize, number: f64) {
        if number > 0.0 {
            self.0[index].fetch_add((number * UNITS).ceil() as u64, Ordering::Relaxed);
        }
    }

    pub(crate) fn into_sums(self) -> Vec<f64> {
        let sums = self.0.into_iter();
        sums.map(|sum| sum.into_inner() as f64 / UNITS).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_does_not_matter() {
        let numbers = [0.3, 1e-9, 0.7, 0.1 / 3.0, 1.0 / 7.0];
        let sum = |order: [usize; 5]| {
            let sums = FixedSums::new(2);
            order.into_iter().for_each(|k| sums.add(1, numbers[k]));
            sums.into_sums()
        };
        let forth = sum([0, 1, 2, 3, 4]);
        assert_eq!(forth, sum([3, 1, 4, 0, 2]));
        assert_eq!(forth[0], 0.0);
        assert!((forth[1] - numbers.iter().sum::<f64>()).abs() < 5.0 / UNITS);
    }
}
