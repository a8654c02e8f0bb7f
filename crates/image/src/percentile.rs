//! Percentiles: the number that a share of some numbers are less than.

/// Of numbers put in order, the one whose rank is `share` of the way from the first to the last, to
/// the nearest rank: 0 gives the least, 0.5 the median, 1 the greatest. `None` if there are none.
///
/// ```
/// use radiosity_image::percentile;
///
/// let numbers = [5.0, 1.0, 4.0, 2.0, 3.0];
/// assert_eq!(percentile(numbers.into_iter(), 0.5), Some(3.0));
/// assert_eq!(percentile(numbers.into_iter(), 1.0), Some(5.0));
/// assert_eq!(percentile([].into_iter(), 0.5), None);
/// ```
pub fn percentile(numbers: impl Iterator<Item = f32>, share: f64) -> Option<f32> {
    let mut numbers: Vec<f32> = numbers.collect();
    let last = numbers.len().checked_sub(1)?;
    let rank = (share * last as f64).round() as usize;
    let (_, number, _) = numbers.select_nth_unstable_by(rank, f32::total_cmp);
    Some(*number)
}

/// Whether a number tells of light: black pixels say nothing of how bright the others are.
pub(crate) fn is_lit(number: &f32) -> bool {
    *number > 0.0 && number.is_finite()
}
