//! The noise that dithers levels: a function of the pixel alone, so that pictures are repeated to
//! the byte.

/// Uniform in [0, 1), and as good as independent from pixel to pixel and channel to channel.
pub(super) fn noise([x, y, channel]: [u32; 3]) -> f32 {
    let hash = mix(mix(u64::from(y) << 32 | u64::from(x)) ^ u64::from(channel));
    (hash >> 40) as f32 / (1 << 24) as f32
}

/// Stafford's variant 13 of the finalizer of MurmurHash3.
fn mix(number: u64) -> u64 {
    let number = (number ^ number >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let number = (number ^ number >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    number ^ number >> 31
}
