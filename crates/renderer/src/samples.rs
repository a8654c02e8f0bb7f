//! Where the samples of a pixel lie: sets of places, made once, of which each pixel takes one.
//!
//! In each part of a pixel the places are the first points of the two-dimensional Sobol' sequence,
//! scrambled by random digits (Kollig & Keller, "Efficient Multidimensional Sampling", 2002): every
//! place is uniformly distributed, and together they leave no gaps.

use radiosity_geometry::{DVec2, Film, Offsets};
use radiosity_simd::LANES;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// All sets.
pub(crate) struct SampleSets {
    sets: Vec<SampleSet>,
    seed: u64,
}

/// The samples of a pixel, eight by eight. If they are fewer, the last ones do not count.
pub(crate) struct SampleSet {
    /// Places, in pixels from the pixel's corner.
    pub(crate) offsets: Vec<Offsets>,
    /// How much each counts; they sum to 1.
    pub(crate) weights: Vec<[f32; LANES]>,
}

/// About so many samples are kept: they should stay in the processor's cache.
const KEPT: u32 = 1 << 12;
/// And so many sets at least, so that neighbours differ.
const LEAST_SETS: u32 = 16;

impl SampleSets {
    /// Sets of so many samples for each part of a pixel.
    pub(crate) fn new(film: &Film, per_part: u32, seed: u64) -> SampleSets {
        let count = KEPT / (film.parts() * per_part);
        let set = |index: u32| {
            let mut rng = Pcg64Mcg::seed_from_u64(seed ^ u64::from(index).rotate_left(32));
            SampleSet::new(film, per_part, &mut rng)
        };
        SampleSets {
            sets: (0..count.max(LEAST_SETS)).map(set).collect(),
            seed,
        }
    }

    /// The digits that scramble a pixel's further random numbers.
    pub(crate) fn scramble_of(&self, (x, y): (u32, u32)) -> [u32; 2] {
        let place = u64::from(y) << 32 | u64::from(x);
        let hash = mix(mix(place) ^ self.seed);
        [hash as u32, (hash >> 32) as u32]
    }

    /// The set of the pixel in column `x` and row `y`, in the round of samples of this number.
    pub(crate) fn of_pixel(&self, x: u32, y: u32, round: u32) -> &SampleSet {
        let place = u64::from(y) << 32 | u64::from(x);
        let hash = mix(place ^ mix(self.seed ^ u64::from(round)));
        &self.sets[(hash % self.sets.len() as u64) as usize]
    }
}

impl SampleSet {
    fn new(film: &Film, per_part: u32, rng: &mut Pcg64Mcg) -> SampleSet {
        let count = (film.parts() * per_part) as usize;
        let groups = count.div_ceil(LANES);
        let mut set = SampleSet {
            offsets: vec![[[0.5; LANES]; 2]; groups],
            weights: vec![[0.0; LANES]; groups],
        };
        let mut index = 0;
        for part in 0..film.parts() {
            let scramble: [u32; 2] = rng.random();
            for k in 0..per_part {
                let (offset, weight) = film.sample(part, sobol(k, scramble));
                let (group, lane) = (index / LANES, index % LANES);
                let [x, y] = &mut set.offsets[group];
                (x[lane], y[lane]) = (offset.x as f32, offset.y as f32);
                set.weights[group][lane] = weight as f32;
                index += 1;
            }
        }
        let sum: f32 = set.weights.as_flattened().iter().sum();
        set.weights
            .as_flattened_mut()
            .iter_mut()
            .for_each(|weight| *weight /= sum);
        set
    }
}

/// A point of Sobol's sequence in the unit square.
pub(crate) fn sobol(index: u32, [x, y]: [u32; 2]) -> DVec2 {
    let (mut second, mut direction, mut rest) = (0, 1u32 << 31, index);
    while rest != 0 {
        if rest & 1 != 0 {
            second ^= direction;
        }
        direction ^= direction >> 1;
        rest >>= 1;
    }
    let to_unit = |digits: u32| (f64::from(digits) + 0.5) / 2f64.powi(32);
    DVec2::new(to_unit(index.reverse_bits() ^ x), to_unit(second ^ y))
}

/// Stafford's variant 13 of the finalizer of MurmurHash3.
pub(crate) fn mix(number: u64) -> u64 {
    let number = (number ^ number >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let number = (number ^ number >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    number ^ number >> 31
}

#[cfg(test)]
mod tests {
    use super::*;
    use radiosity_geometry::PixelFilter;

    fn film(filter: PixelFilter) -> Film {
        Film {
            width: 1,
            height: 1,
            subpixels: 2,
            filter,
        }
    }

    /// Each of 16 points in its own part of the square, however that is cut into 16 equal boxes.
    #[test]
    fn points_leave_no_gaps() {
        let points: Vec<DVec2> = (0..16)
            .map(|k| sobol(k, [0x9e37_79b9, 0x85eb_ca6b]))
            .collect();
        for (a, b) in [(1.0, 16.0), (2.0, 8.0), (4.0, 4.0), (8.0, 2.0), (16.0, 1.0)] {
            let boxes = points
                .iter()
                .map(|p| (p.x * a) as u32 * 16 + (p.y * b) as u32);
            let boxes: std::collections::BTreeSet<u32> = boxes.collect();
            assert_eq!(boxes.len(), 16, "{a} x {b}");
        }
    }

    #[test]
    fn weights_sum_to_one_and_what_is_left_over_does_not_count() {
        for (filter, per_part) in [(PixelFilter::Box, 1), (PixelFilter::Mitchell, 5)] {
            let sets = SampleSets::new(&film(filter), per_part, 3);
            for x in 0..50 {
                let set = sets.of_pixel(x, 7, 0);
                let weights = set.weights.as_flattened();
                assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-5);
                let counted = weights.iter().filter(|weight| **weight != 0.0).count();
                assert_eq!(counted, 4 * per_part as usize);
            }
        }
    }
}
