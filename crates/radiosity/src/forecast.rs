//! What a run will take, said before it begins.

use crate::estimate_to_file::Job;
use crate::resources::Needs;
use crate::words::{PAIRS, bytes, counted, duration};
use radiosity_form_factors::{Estimation, Estimator};
use std::time::Instant;

/// Below this many pairs of points a prediction costs more than it is worth.
const PREDICTED_FROM: u64 = 20_000_000;
/// A timed sample goes on until it has taken so many seconds, or done one in so many of the run's
/// pairs of points: fewer may all be of patches that see nothing of each other, or more of each
/// other than most.
const LONG_ENOUGH: f64 = 0.2;
const SAMPLE_ONE_IN: u64 = 40;
/// With more points along an edge, or more pairs of points, a timed sample takes these.
const MOST_POINTS: u32 = 16;
const MOST_POINT_PAIRS: u32 = 4096;

/// Pairs, time, memory and disk of an estimation of which so many pairs are left; `None` if it will
/// be over soon.
pub(crate) fn prediction(
    needs: &Needs,
    left: u64,
    estimation: &Estimation<'_>,
    job: &Job<'_>,
) -> Option<String> {
    let seconds = predicted_seconds(left, estimation, job).filter(|seconds| *seconds >= 1.0)?;
    Some(format!(
        "{}: {}, {} of memory, {} of disk",
        counted(needs.pairs as usize, PAIRS),
        duration(seconds),
        bytes(needs.memory),
        bytes(needs.disk),
    ))
}

/// How long an estimation takes of which so many pairs are left, from a timed sample; `None` if
/// that is not worth a sample.
pub(crate) fn predicted_seconds(
    left: u64,
    estimation: &Estimation<'_>,
    job: &Job<'_>,
) -> Option<f64> {
    let work = left.saturating_mul(job.estimator.point_pairs());
    if work < PREDICTED_FROM {
        return None;
    }
    let (estimator, factor) = sampled(job.estimator);
    let smaller = (factor > 1.0).then(|| Estimation::new(job.mesh, estimator));
    let estimation = smaller.as_ref().unwrap_or(estimation);
    Some(factor * left as f64 * seconds_per_pair(estimation, enough(left, factor)))
}

/// An estimator that takes no longer than a timed sample should, and how many times as long the
/// other takes: as many as it has pairs of points.
fn sampled(estimator: Estimator) -> (Estimator, f64) {
    let smaller = match estimator {
        Estimator::Regular { points } => Estimator::Regular {
            points: points.min(MOST_POINTS),
        },
        Estimator::MonteCarlo {
            points,
            pairs,
            seed,
        } => Estimator::MonteCarlo {
            points,
            pairs: pairs.min(MOST_POINT_PAIRS),
            seed,
        },
        Estimator::Accurate { .. } => estimator,
    };
    let pairs = |of: Estimator| of.point_pairs() as f64;
    (smaller, pairs(estimator) / pairs(smaller))
}

/// How many pairs are enough of so many that are left, where each takes so many times as long.
fn enough(left: u64, factor: f64) -> u64 {
    (factor * left as f64) as u64 / SAMPLE_ONE_IN
}

/// The time of a pair, by a timed sample that need not do more than enough of them.
fn seconds_per_pair(estimation: &Estimation<'_>, enough: u64) -> f64 {
    let mut wanted = 2 * rayon::current_num_threads() as u64;
    loop {
        let start = Instant::now();
        let done = estimation.time_sample(wanted);
        let seconds = start.elapsed().as_secs_f64();
        if seconds >= LONG_ENOUGH || done >= enough {
            return seconds / done as f64;
        }
        wanted = 4 * done;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn timed_samples_are_short_whatever_is_asked_for() {
        let regular = |points| Estimator::Regular { points };
        assert_eq!(sampled(regular(3)), (regular(3), 1.0));
        assert_eq!(sampled(regular(32)), (regular(16), 16.0));
        let random = |pairs| Estimator::MonteCarlo {
            points: 4,
            pairs,
            seed: 1,
        };
        assert_eq!(sampled(random(1 << 20)), (random(1 << 12), 256.0));
        let accurate = Estimator::Accurate { tolerance: 1e-6 };
        assert_eq!(sampled(accurate), (accurate, 1.0));
    }

    /// The same part of the work, whatever the points: of few pairs, each several times.
    #[test]
    fn few_pairs_of_many_points_are_sampled_as_long() {
        assert_eq!(enough(4000, 1.0), 100);
        assert_eq!(enough(1128, 256.0), 7219);
    }
}
