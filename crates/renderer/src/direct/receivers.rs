//! Points that light from emitters arrives at, and where segments from them end.

use crate::samples::{mix, sobol};
use radiosity_geometry::{DVec2, DVec3};
use radiosity_simd::{Float, LANES};

/// Points on an emitter to which segments are tried where more are in the way: from each sample, of
/// which a pixel has many.
const POINTS: u32 = 8;

/// Eight points of patches that light arrives at, with their normals.
pub(crate) struct Receivers<F> {
    pub(crate) patches: [u32; LANES],
    pub(crate) at: [F; 3],
    pub(crate) normals: [F; 3],
    pub(crate) lanes: u8,
    pub(crate) samples: EmitterSamples,
}

/// The points of an emitter to which segments are tried, where too much is in the way.
#[derive(Clone, Copy)]
pub(crate) enum EmitterSamples {
    /// The samples of a pixel share a sequence, which this scrambles; the number is that of the
    /// sample in the first lane.
    Shared([u32; 2], u32),
    /// To a point that depends on the place alone.
    Single,
}

impl<F: Float<f64>> Receivers<F> {
    /// Where segments from a lane end, in coordinates of an emitter.
    #[inline(always)]
    pub(super) fn ends(&self, lane: usize, at: DVec3) -> impl Iterator<Item = DVec2> + use<F> {
        let (scramble, first, count) = match self.samples {
            EmitterSamples::Shared(scramble, sample) => {
                let first = sample.wrapping_add(lane as u32).wrapping_mul(POINTS);
                (scramble, first, POINTS)
            }
            EmitterSamples::Single => {
                let bits = at.to_array().map(f64::to_bits);
                let hash = bits.into_iter().fold(0, |hash, bits| mix(hash ^ bits));
                ([hash as u32, (hash >> 32) as u32], 0, 1)
            }
        };
        (0..count).map(move |k| sobol(first.wrapping_add(k), scramble))
    }
}
