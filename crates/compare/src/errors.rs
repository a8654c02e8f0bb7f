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
    reference: f64,
    /// Weighted squares of the reference's standard errors.
    noise: Option<f64>,
    /// Difference and weight of each value.
    differences: Vec<(f64, f64)>,
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
    pub(crate) fn add(&mut self, weight: f64, reference: f64, found: f64) {
        self.reference += weight * reference;
        self.differences.push((found - reference, weight));
    }

    /// Tells the standard error of a reference that was added.
    pub(crate) fn add_noise(&mut self, weight: f64, standard_error: f64) {
        *self.noise.get_or_insert_default() += weight * standard_error.powi(2);
    }

    pub(crate) fn append(&mut self, other: &Differences) {
        self.reference += other.reference;
        if let Some(noise) = other.noise {
            *self.noise.get_or_insert_default() += noise;
        }
        self.differences.extend_from_slice(&other.differences);
    }

    /// `None` where there is no value, or where the reference is dark: nothing is a percentage
    /// of zero.
    pub(crate) fn errors(&self) -> Option<Errors> {
        let weight: f64 = self.differences.iter().map(|(_, weight)| weight).sum();
        let mean = self.reference / weight;
        if self.differences.is_empty() || mean.is_nan() || mean <= 0.0 {
            return None;
        }
        let mean_of = |power: i32| {
            let terms = self.differences.iter();
            terms.map(|(d, w)| w * d.powi(power)).sum::<f64>() / weight
        };
        let percent = 100.0 / mean;
        Some(Errors {
            rmse_percent: percent * mean_of(2).sqrt(),
            bias_percent: percent * mean_of(1),
            noise_percent: self.noise.map(|sum| percent * (sum / weight).sqrt()),
            percentiles: self.percentiles(percent, weight),
            values: self.differences.len(),
        })
    }

    fn percentiles(&self, scale: f64, total_weight: f64) -> Percentiles {
        let mut sizes: Vec<(f64, f64)> = self
            .differences
            .iter()
            .map(|(d, w)| (d.abs() * scale, *w))
            .collect();
        sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut below = 0.0;
        let cumulative: Vec<f64> = sizes
            .iter()
            .map(|(_, weight)| {
                below += weight;
                below
            })
            .collect();
        let at = |share: f64| {
            let index = cumulative.partition_point(|&sum| sum < share * total_weight);
            sizes[index.min(sizes.len() - 1)].0
        };
        Percentiles {
            p50: at(0.5),
            p90: at(0.9),
            p99: at(0.99),
            max: sizes[sizes.len() - 1].0,
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
        assert!(close(errors.percentiles.p50, 20.0));
        assert!(close(errors.percentiles.p90, 40.0));
        assert!(close(errors.percentiles.max, 40.0));
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
