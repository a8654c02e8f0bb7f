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

    pub(crate) fn count(&self) -> usize {
        self.0.len()
    }

    pub(crate) fn add(&self, index: usize, number: f64) {
        if number > 0.0 {
            self.0[index].fetch_add((number * UNITS).ceil() as u64, Ordering::Relaxed);
        }
    }

    pub(crate) fn sums(&self) -> Vec<f64> {
        let units = self.units().into_iter();
        units.map(|units| units as f64 / UNITS).collect()
    }

    /// All that is known, for [`FixedSums::from_units`].
    pub(crate) fn units(&self) -> Vec<u64> {
        let load = |sum: &AtomicU64| sum.load(Ordering::Relaxed);
        self.0.iter().map(load).collect()
    }

    pub(crate) fn from_units(units: Vec<u64>) -> FixedSums {
        FixedSums(units.into_iter().map(AtomicU64::new).collect())
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
            sums.sums()
        };
        let forth = sum([0, 1, 2, 3, 4]);
        assert_eq!(forth, sum([3, 1, 4, 0, 2]));
        assert_eq!(forth[0], 0.0);
        assert!((forth[1] - numbers.iter().sum::<f64>()).abs() < 5.0 / UNITS);
    }

    #[test]
    fn a_copy_goes_on_where_the_first_was() {
        let sums = FixedSums::new(1);
        sums.add(0, 0.1);
        let copy = FixedSums::from_units(sums.units());
        sums.add(0, 0.7);
        copy.add(0, 0.7);
        assert_eq!(sums.sums(), copy.sums());
    }
}
