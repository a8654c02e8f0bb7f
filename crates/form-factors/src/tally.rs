//! What is counted while rows are filled: the same whatever the order.

use crate::accurate::PairEstimate;
use crate::fixed_point_sum::{FixedPoint, FixedPointSums};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::ops::AddAssign;
use std::sync::atomic::{AtomicU64, Ordering};

/// How much two patches see of each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Visibility {
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
    /// Of all rows, then what all rows have missed, and then of both classes.
    errors: FixedPointSums,
    pairs: [AtomicU64; 2],
}

/// What pairs add to the error of a row, and to what it has missed.
#[derive(Clone, Copy, Default)]
pub(crate) struct RowError {
    error: FixedPoint,
    missed: FixedPoint,
}

impl RowError {
    /// Of a pair in the row of a patch of this area.
    pub(crate) fn of(exchange: &PairEstimate, area: f64) -> RowError {
        RowError {
            error: FixedPoint::of(exchange.error / area),
            missed: FixedPoint::of(exchange.missed / area),
        }
    }
}

impl AddAssign for RowError {
    fn add_assign(&mut self, other: RowError) {
        self.error += other.error;
        self.missed += other.missed;
    }
}

/// What is known of the errors of all rows.
pub(crate) struct RowErrors {
    /// By row.
    pub(crate) estimated: Vec<f64>,
    /// By row.
    pub(crate) missed: Vec<f64>,
    pub(crate) classes: Classes,
}

impl Clone for Tally {
    fn clone(&self) -> Tally {
        Tally {
            errors: FixedPointSums::from_units(self.errors.units()),
            pairs: self.pairs().map(AtomicU64::new),
        }
    }
}

/// What some pairs add to their classes.
#[derive(Default)]
pub(crate) struct ClassSums {
    /// Times [`FINER`].
    errors: [FixedPoint; 2],
    pairs: [u64; 2],
}

/// What a pair adds to the mean over rows is so many times smaller, at least, than what it adds to
/// one.
const FINER: f64 = 65536.0;

impl ClassSums {
    pub(crate) fn add(&mut self, visibility: Visibility, error: f64) {
        let class = match visibility {
            Visibility::Clear => 0,
            Visibility::Partial => 1,
        };
        self.pairs[class] += 1;
        self.errors[class] += FixedPoint::of(FINER * error);
    }
}

impl Tally {
    /// Nothing is estimated yet of so many rows.
    pub fn new(rows: usize) -> Tally {
        Tally {
            errors: FixedPointSums::new(2 * rows + 2),
            pairs: Default::default(),
        }
    }

    fn pairs(&self) -> [u64; 2] {
        self.pairs.each_ref().map(|n| n.load(Ordering::Relaxed))
    }

    fn rows(&self) -> usize {
        (self.errors.count() - 2) / 2
    }

    pub(crate) fn add_error(&self, row: usize, of_row: RowError) {
        self.errors.add(row, of_row.error);
        self.errors.add(self.rows() + row, of_row.missed);
    }

    pub(crate) fn add_classes(&self, classes: &ClassSums) {
        for (k, (&error, &pairs)) in classes.errors.iter().zip(&classes.pairs).enumerate() {
            self.errors.add(2 * self.rows() + k, error);
            self.pairs[k].fetch_add(pairs, Ordering::Relaxed);
        }
    }

    pub(crate) fn sums(&self) -> RowErrors {
        let mut estimated = self.errors.sums();
        let mut missed = estimated.split_off(self.rows());
        let of_classes = missed.split_off(self.rows());
        let class = |k: usize| ClassFacts {
            pairs: self.pairs[k].load(Ordering::Relaxed),
            error: of_classes[k] / FINER,
        };
        let (clear, partial) = (class(0), class(1));
        RowErrors {
            estimated,
            missed,
            classes: Classes { clear, partial },
        }
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
            errors: FixedPointSums::from_units(units),
            pairs: pairs.map(AtomicU64::new),
        })
    }
}
