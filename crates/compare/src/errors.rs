//! Errors as percentages of the mean of the reference.

use serde::Serialize;

/// How far some values are from their reference, in percent of the mean of the reference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Errors {
    /// Root mean square difference.
    pub rmse_percent: f64,
    /// Mean difference; positive where the values are larger than the reference.
    pub bias_percent: f64,
    /// Root mean square standard error of the reference, if it tells: so much of the root mean
    /// square difference is the reference's own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub noise_percent: Option<f64>,
    /// Absolute differences.
    pub percentiles: Percentiles,
    /// Over how many values, channels counted apart.
    pub values: usize,
}

/// Absolute differences, in percent of the mean of the reference, that so many percent of the
/// values do not exceed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Percentiles {
    /// The median.
    pub p50: f64,
    /// Nine in ten.
    pub p90: f64,
    /// All but one in a hundred.
    pub p99: f64,
    /// The largest.
    pub max: f64,
}

/// Collects weighted differences.
#[derive(Clone, Debug, Default)]
pub(crate) struct Differences {
    /// The sum of the weights.
    weight: f64,
    /// Weighted sums, of the reference and of the first two powers of differences.
    reference: f64,
    sum: f64,
    squares: f64,
    /// Weighted squares of the reference's standard errors.
    noise: Option<f64>,
    /// Size and weight of each difference. There are as many as values, and single precision is
    /// enough to put them in order.
    sizes: Vec<(f32, f32)>,
}

impl Errors {
    /// The root mean square difference without the noise of the reference: zero, where that
    /// explains it all.
    pub fn rmse_percent_without_noise(&self) -> f64 {
        let noise = self.noise_percent.unwrap_or(0.0);
        (self.rmse_percent.powi(2) - noise.powi(2)).max(0.0).sqrt()
    }
}

impl Differences {
    pub(crate) fn with_capacity(values: usize) -> Differences {
        Differences {
            sizes: Vec::with_capacity(values),
            ..Differences::default()
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.sizes.len()
    }

    pub(crate) fn add(&mut self, weight: f64, reference: f64, found: f64) {
        let difference = found - reference;
        self.weight += weight;
        self.reference += weight * reference;
        self.sum += weight * difference;
        self.squares += weight * difference * difference;
        let size = (difference.abs() as f32).min(f32::MAX);
        self.sizes.push((size, weight as f32));
    }

    /// Tells the standard error of a reference that was added.
    pub(crate) fn add_noise(&mut self, weight: f64, standard_error: f64) {
        *self.noise.get_or_insert_default() += weight * standard_error.powi(2);
    }

    pub(crate) fn append(&mut self, mut other: Differences) {
        self.weight += other.weight;
        self.reference += other.reference;
        self.sum += other.sum;
        self.squares += other.squares;
        if let Some(noise) = other.noise {
            *self.noise.get_or_insert_default() += noise;
        }
        if self.sizes.capacity() == 0 {
            // A copy would take as much memory again.
            self.sizes = other.sizes;
        } else {
            self.sizes.append(&mut other.sizes);
        }
    }

    /// `None` where there is no value, or where the reference is dark: nothing is a percentage
    /// of zero.
    pub(crate) fn errors(&mut self) -> Option<Errors> {
        let weight = self.weight;
        let mean = self.reference / weight;
        if self.sizes.is_empty() || mean.is_nan() || mean <= 0.0 {
            return None;
        }
        let percent = 100.0 / mean;
        Some(Errors {
            rmse_percent: percent * (self.squares / weight).sqrt(),
            bias_percent: percent * self.sum / weight,
            noise_percent: self.noise.map(|sum| percent * (sum / weight).sqrt()),
            percentiles: self.percentiles(percent),
            values: self.sizes.len(),
        })
    }

    /// Sorts in place, for the same reason.
    fn percentiles(&mut self, scale: f64) -> Percentiles {
        self.sizes.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let weights = self.sizes.iter().map(|&(_, weight)| f64::from(weight));
        let total: f64 = weights.sum();
        let mut sizes = self.sizes.iter();
        let mut below = 0.0;
        let mut last = 0.0;
        let mut at = |share: f64| {
            while below < share * total
                && let Some(&(size, weight)) = sizes.next()
            {
                below += f64::from(weight);
                last = f64::from(size) * scale;
            }
            last
        };
        Percentiles {
            p50: at(0.5),
            p90: at(0.9),
            p99: at(0.99),
            max: at(f64::INFINITY),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// References 1 and 3 with weights 3 and 1: the mean is 1.5. Differences +0.3 and -0.6: mean
    /// (0.9 - 0.6) / 4 = 0.075, mean square (0.27 + 0.36) / 4 = 0.1575.
    #[test]
    fn errors_are_weighted_and_relative_to_the_mean() {
        let mut differences = Differences::default();
        differences.add(3.0, 1.0, 1.3);
        differences.add(1.0, 3.0, 2.4);
        assert_eq!(differences.errors().unwrap().noise_percent, None);
        differences.add_noise(3.0, 0.1);
        differences.add_noise(1.0, 0.3);
        let errors = differences.errors().unwrap();
        let close = |found: f64, expected: f64| (found - expected).abs() < 1e-12 * expected;
        assert!(close(errors.rmse_percent, 100.0 * 0.1575_f64.sqrt() / 1.5));
        assert!(close(errors.bias_percent, 5.0));
        let noise_squared = (3.0 * 0.01 + 0.09) / 4.0 / 1.5_f64.powi(2);
        assert!(close(
            errors.noise_percent.unwrap(),
            100.0 * noise_squared.sqrt()
        ));
        let without = (0.1575 / 1.5_f64.powi(2) - noise_squared).sqrt();
        assert!(close(errors.rmse_percent_without_noise(), 100.0 * without));
        let single = |found: f64, expected: f64| (found / expected - 1.0).abs() < 1e-7;
        assert!(single(errors.percentiles.p50, 20.0));
        assert!(single(errors.percentiles.p90, 40.0));
        assert!(single(errors.percentiles.max, 40.0));
        assert_eq!(errors.values, 2);
    }

    #[test]
    fn nothing_is_a_percentage_of_nothing() {
        assert_eq!(Differences::default().errors(), None);
        let mut dark = Differences::default();
        dark.add(1.0, 0.0, 1.0);
        assert_eq!(dark.errors(), None);
    }
}
