//! Numbers that threads hand to each other.

use super::band::OfRows;
use std::sync::atomic::{AtomicU32, Ordering};

/// A number of each row of a block, for some triples of vectors, once or several times. Whoever
/// reads knows by other means that what it reads was written.
pub(super) struct Shared(Vec<OfRows<AtomicU32>>);

impl Shared {
    pub(super) fn new(count: usize) -> Shared {
        Shared(
            std::iter::repeat_with(Default::default)
                .take(count)
                .collect(),
        )
    }

    /// Sets some of them, from a triple on.
    pub(super) fn set(&self, first: usize, numbers: &[OfRows<f32>]) {
        let numbers = numbers.as_flattened().as_flattened();
        for (shared, number) in self.from(first).zip(numbers) {
            shared.store(number.to_bits(), Ordering::Relaxed);
        }
    }

    /// Gives some of them, from a triple on.
    pub(super) fn get(&self, first: usize, numbers: &mut [OfRows<f32>]) {
        let numbers = numbers.as_flattened_mut().as_flattened_mut();
        for (shared, number) in self.from(first).zip(numbers) {
            *number = f32::from_bits(shared.load(Ordering::Relaxed));
        }
    }

    /// Adds some of them, from a triple on.
    pub(super) fn add_to(&self, sums: &mut [OfRows<f64>], first: usize) {
        let sums = sums.as_flattened_mut().as_flattened_mut();
        for (shared, sum) in self.from(first).zip(sums) {
            *sum += f64::from(f32::from_bits(shared.load(Ordering::Relaxed)));
        }
    }

    fn from(&self, first: usize) -> impl Iterator<Item = &AtomicU32> {
        self.0[first..].as_flattened().as_flattened().iter()
    }
}
