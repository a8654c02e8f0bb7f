//! Sums that do not depend on the order in which threads add to them.

use std::ops::AddAssign;
use std::sync::atomic::{AtomicU64, Ordering};

/// Sums of positive numbers, up to 2^24, to which any thread may add.
pub(crate) struct FixedPointSums(Vec<AtomicU64>);

/// A positive number, up to 2^24, in units of 2^-40: rounding numbers up to whole units makes their
/// addition exact, and so commutative.
#[derive(Clone, Copy, Default)]
pub(crate) struct FixedPoint(u64);

const UNITS: f64 = (1u64 << 40) as f64;

impl FixedPoint {
    /// Zero, if it is not positive.
    pub(crate) fn of(number: f64) -> FixedPoint {
        let units = number * UNITS;
        let whole = units as u64;
        FixedPoint(whole.saturating_add(u64::from((whole as f64) < units)))
    }
}

impl AddAssign for FixedPoint {
    fn add_assign(&mut self, other: FixedPoint) {
        self.0 = self.0.saturating_add(other.0);
    }
}

impl FixedPointSums {
    pub(crate) fn new(count: usize) -> FixedPointSums {
        FixedPointSums((0..count).map(|_| AtomicU64::new(0)).collect())
    }

    pub(crate) fn count(&self) -> usize {
        self.0.len()
    }

    pub(crate) fn add(&self, index: usize, number: FixedPoint) {
        self.0[index].fetch_add(number.0, Ordering::Relaxed);
    }

    pub(crate) fn sums(&self) -> Vec<f64> {
        let units = self.units().into_iter();
        units.map(|units| units as f64 / UNITS).collect()
    }

    /// All that is known, for [`FixedPointSums::from_units`].
    pub(crate) fn units(&self) -> Vec<u64> {
        let load = |sum: &AtomicU64| sum.load(Ordering::Relaxed);
        self.0.iter().map(load).collect()
    }

    pub(crate) fn from_units(units: Vec<u64>) -> FixedPointSums {
        FixedPointSums(units.into_iter().map(AtomicU64::new).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_does_not_matter() {
        let numbers = [0.3, 1e-9, 0.7, 0.1 / 3.0, 1.0 / 7.0];
        let sum = |order: [usize; 5]| {
            let sums = FixedPointSums::new(2);
            for k in order {
                sums.add(1, FixedPoint::of(numbers[k]));
            }
            sums.sums()
        };
        let forth = sum([0, 1, 2, 3, 4]);
        assert_eq!(forth, sum([3, 1, 4, 0, 2]));
        assert_eq!(forth[0], 0.0);
        assert!((forth[1] - numbers.iter().sum::<f64>()).abs() < 5.0 / UNITS);
    }

    #[test]
    fn numbers_are_rounded_up_to_whole_units() {
        let units =
            [-1.0, 0.0, 1e-300, 1.0, 1.0 + 1e-9, 7.5].map(|units| FixedPoint::of(units / UNITS).0);
        assert_eq!(units, [0, 0, 1, 1, 2, 8]);
        assert_eq!(FixedPoint::of(f64::NAN).0, 0);
        assert_eq!(FixedPoint::of(f64::INFINITY).0, u64::MAX);
    }

    #[test]
    fn a_copy_goes_on_where_the_first_was() {
        let sums = FixedPointSums::new(1);
        sums.add(0, FixedPoint::of(0.1));
        let copy = FixedPointSums::from_units(sums.units());
        sums.add(0, FixedPoint::of(0.7));
        copy.add(0, FixedPoint::of(0.7));
        assert_eq!(sums.sums(), copy.sums());
    }
}
