//! Means with standard errors.

use crate::Rgb;

/// Running sums of independent samples (Welford, "Note on a Method for Calculating Corrected
/// Sums of Squares and Products", 1962).
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Samples {
    count: f64,
    mean: Rgb,
    squares: Rgb,
}

impl Samples {
    pub(crate) fn add(&mut self, sample: Rgb) {
        self.count += 1.0;
        let share = 1.0 / self.count;
        for (c, value) in sample.into_iter().enumerate() {
            let before = value - self.mean[c];
            self.mean[c] += before * share;
            self.squares[c] += before * (value - self.mean[c]);
        }
    }

    pub(crate) fn mean(&self) -> Rgb {
        self.mean
    }

    /// The standard error of the mean; infinite for fewer than two samples.
    pub(crate) fn standard_error(&self) -> Rgb {
        if self.count < 2.0 {
            return [f64::INFINITY; 3];
        }
        let pairs = self.count * (self.count - 1.0);
        self.squares.map(|squares| (squares / pairs).sqrt())
    }
}
