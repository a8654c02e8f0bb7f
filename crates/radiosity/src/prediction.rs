//! What a long run will take, said before it begins.

use crate::resources::{Needs, bytes, duration, grouped};
use radiosity_form_factors::{Estimation, Estimator};
use std::time::Instant;

/// Below this many pairs of points a prediction costs more than it is worth.
const PREDICTED_FROM: u64 = 20_000_000;
/// The share of a run that a prediction may cost, as one in so many, and the most pairs of
/// points it tries: some tenths of a second's work.
const REHEARSED_ONE_IN: u64 = 40;
const MOST_REHEARSED: u64 = 30_000_000;

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
    let tried = (work / REHEARSED_ONE_IN).min(MOST_REHEARSED) / estimator.point_pairs();
    let start = Instant::now();
    let tried = estimation.rehearse(tried.max(2 * rayon::current_num_threads() as u64));
    let seconds = start.elapsed().as_secs_f64() * left as f64 / tried as f64;
    Some(format!(
        "{} patches, {} pairs: {} of memory, {} of disk, {}",
        grouped(needs.patches as u64),
        grouped(needs.pairs),
        bytes(needs.memory),
        bytes(needs.disk),
        duration(seconds),
    ))
}
