//! What is counted while rows are filled: the same whatever the order.

use crate::fixed::{Fixed, FixedSums};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::sync::atomic::{AtomicU64, Ordering};

/// How much two patches see of each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sight {
    /// Nothing stands between.
    Clear,
    /// Something may, and what is visible has been measured.
    Partial,
}

/// Pairs of patches that are alike, and what they add to the errors of rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ClassFacts {
    /// How many pairs they are.
    pub pairs: u64,
    /// The estimated sum of the absolute errors of their factors, per row: the mean over rows
    /// weighted by area.
    pub error: f64,
}

/// Pairs of patches by how much they see of each other; all other pairs see nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Classes {
    /// Nothing stands between them, if they face each other at all.
    pub clear: ClassFacts,
    /// Something may stand between them, and what is visible was measured.
    pub partial: ClassFacts,
}

/// The errors of rows and of classes of pairs, as far as they are estimated.
pub struct Tally {
    /// Of all rows, and then of both classes.
    errors: FixedSums,
    pairs: [AtomicU64; 2],
}

impl Clone for Tally {
    fn clone(&self) -> Tally {
        Tally {
            errors: FixedSums::from_units(self.errors.units()),
            pairs: self.pairs().map(AtomicU64::new),
        }
    }
}

impl Classes {
    pub(crate) fn add(&mut self, sight: Sight, error: f64) {
        let class = match sight {
            Sight::Clear => &mut self.clear,
            Sight::Partial => &mut self.partial,
        };
        class.pairs += 1;
        class.error += error;
    }
}

impl Tally {
    /// Nothing is estimated yet of so many rows.
    pub fn new(rows: usize) -> Tally {
        Tally {
            errors: FixedSums::new(rows + 2),
            pairs: Default::default(),
        }
    }

    fn pairs(&self) -> [u64; 2] {
        self.pairs.each_ref().map(|n| n.load(Ordering::Relaxed))
    }

    pub(crate) fn add_error(&self, row: usize, error: Fixed) {
        self.errors.add(row, error);
    }

    pub(crate) fn add_classes(&self, classes: &Classes) {
        let rows = self.errors.count() - 2;
        for (k, class) in [classes.clear, classes.partial].into_iter().enumerate() {
            self.errors.add(rows + k, Fixed::of(class.error));
            self.pairs[k].fetch_add(class.pairs, Ordering::Relaxed);
        }
    }

    /// The error of each row, and the classes of pairs.
    pub(crate) fn sums(&self) -> (Vec<f64>, Classes) {
        let mut errors = self.errors.sums();
        let of_classes = errors.split_off(errors.len() - 2);
        let class = |k: usize| ClassFacts {
            pairs: self.pairs[k].load(Ordering::Relaxed),
            error: of_classes[k],
        };
        let (clear, partial) = (class(0), class(1));
        (errors, Classes { clear, partial })
    }
}

impl Serialize for Tally {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (self.errors.units(), self.pairs()).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Tally {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Tally, D::Error> {
        let (units, pairs) = <(Vec<u64>, [u64; 2])>::deserialize(deserializer)?;
        Ok(Tally {
            errors: FixedSums::from_units(units),
            pairs: pairs.map(AtomicU64::new),
        })
    }
}
