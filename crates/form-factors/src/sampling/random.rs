//! Random numbers that are functions of a seed and a pair of patches.

/// SplitMix64 (Steele, Lea & Flood, "Fast Splittable Pseudorandom Number Generators", 2014).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stream(u64);

const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

impl Stream {
    /// An independent stream for each pair of indices.
    pub(crate) fn of_pair(seed: u64, i: usize, j: usize) -> Stream {
        let absorb =
            |state: u64, next: u64| finalize(state.wrapping_add(next).wrapping_add(GOLDEN));
        Stream([seed, i as u64, j as u64].into_iter().fold(0, absorb))
    }

    /// What names the stream, for seeding other generators.
    pub(crate) fn seed(self) -> u64 {
        self.0
    }

    /// The next number, uniform in `[0, 1)`.
    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(GOLDEN);
        const BITS: u32 = f64::MANTISSA_DIGITS;
        (finalize(self.0) >> (u64::BITS - BITS)) as f64 / (1u64 << BITS) as f64
    }
}

fn finalize(z: u64) -> u64 {
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
