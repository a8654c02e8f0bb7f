//! What a long run will take, said before it begins.

use crate::resources::{Needs, bytes, duration, grouped};
use radiosity_form_factors::{Estimation, Estimator};
use std::time::{Duration, Instant};

/// Below this many pairs of points a prediction costs more than it is worth.
const PREDICTED_FROM: u64 = 20_000_000;
/// The share of a run that a prediction may cost, as one in so many, and the most pairs of
/// points it tries: some tenths of a second's work where pairs are fast.
const REHEARSED_ONE_IN: u64 = 40;
const MOST_REHEARSED: u64 = 30_000_000;
/// How long it takes at most where pairs are slow: nothing of it is kept.
const MOST_TIME: Duration = Duration::from_secs(1);
/// So many times more pairs are tried after those that took little time.
const GROWTH: u64 = 8;

/// Patches, pairs, memory, disk and time of an estimation of which so many pairs are left, the
/// time from a rehearsal; `None` if it will be over soon.
pub(crate) fn prediction(
    needs: &Needs,
    left: u64,
    estimation: &Estimation<'_>,
    estimator: Estimator,
) -> Option<String> {
    let work = left.saturating_mul(estimator.point_pairs());
    if work < PREDICTED_FROM {
        return None;
    }
    let wanted = (work / REHEARSED_ONE_IN).min(MOST_REHEARSED) / estimator.point_pairs();
    let (tried, took) = rehearse(estimation, wanted);
    let seconds = took.as_secs_f64() * left as f64 / tried as f64;
    Some(format!(
        "{} patches, {} pairs: {} of memory, {} of disk, {}",
        grouped(needs.patches as u64),
        grouped(needs.pairs),
        bytes(needs.memory),
        bytes(needs.disk),
        duration(seconds),
    ))
}

/// Tries as many pairs as wanted, or as time allows; how many, and how long they took.
fn rehearse(estimation: &Estimation<'_>, wanted: u64) -> (u64, Duration) {
    let mut next = few(wanted, 2 * rayon::current_num_threads() as u64);
    loop {
        let start = Instant::now();
        let tried = estimation.rehearse(next);
        let took = start.elapsed();
        match more(next, took, wanted) {
            Some(more) => next = more,
            None => return (tried, took),
        }
    }
}

/// How many pairs to try first, so that some times more are as many as wanted: at least these.
fn few(wanted: u64, least: u64) -> u64 {
    let mut few = wanted.max(least);
    while few >= GROWTH * least {
        few = few.div_ceil(GROWTH);
    }
    few
}

/// How many pairs to try after so many that took so long, if it is worth it.
fn more(tried: u64, took: Duration, wanted: u64) -> Option<u64> {
    let is_time = took <= MOST_TIME / GROWTH as u32;
    (tried < wanted && is_time).then_some(wanted.min(GROWTH * tried))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many pairs are tried, and how long that takes with all before them, where each takes so
    /// long.
    fn tried(of_a_pair: Duration, wanted: u64) -> (u64, Duration) {
        let first = few(wanted, 4);
        let (mut tried, mut took) = (first, of_a_pair * first as u32);
        let mut total = took;
        while let Some(next) = more(tried, took, wanted) {
            (tried, took) = (next, of_a_pair * next as u32);
            total += took;
        }
        (tried, total)
    }

    #[test]
    fn slow_pairs_are_tried_for_a_second() {
        for of_a_pair in [1, 5, 20].map(Duration::from_millis) {
            let (tried, total) = tried(of_a_pair, 150_000);
            assert!(
                tried >= 6 && total < MOST_TIME * 5 / 4,
                "{tried} in {total:?}"
            );
        }
    }

    #[test]
    fn fast_pairs_are_tried_as_wanted() {
        let (tried, total) = tried(Duration::from_nanos(100), 150_000);
        assert_eq!(tried, 150_000);
        assert!(total < Duration::from_micros(15_000 * 6 / 5));
    }
}
