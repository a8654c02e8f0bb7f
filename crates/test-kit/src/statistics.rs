//! Means of samples, and how well they are known.

/// The mean of independent samples.
#[derive(Clone, Copy, Debug)]
pub struct Mean {
    /// The mean.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
}

impl Mean {
    /// Of at least two samples.
    pub fn of(samples: impl IntoIterator<Item = f64>) -> Mean {
        let samples: Vec<f64> = samples.into_iter().collect();
        let count = samples.len() as f64;
        let value = samples.iter().sum::<f64>() / count;
        let squares: f64 = samples.iter().map(|x| (x - value).powi(2)).sum();
        Mean {
            value,
            error: (squares / (count - 1.0) / count).sqrt(),
        }
    }
}
