//! Morton order: neighbours in space become neighbours in memory.

use crate::bounds::Aabb;
use glam::DVec3;

/// Bits per axis; three axes fill 63 bits of the code.
const BITS: u32 = 21;

/// The order in which `points` follow the Z-shaped curve through their bounding box; equal
/// codes keep their input order.
pub(crate) fn order(points: &[DVec3]) -> Vec<usize> {
    let bounds = Aabb::around(points.iter().copied());
    let largest = bounds.extent().max_element();
    let scale = if largest > 0.0 {
        f64::from((1u32 << BITS) - 1) / largest
    } else {
        0.0
    };
    let code = |&point: &DVec3| {
        let cell = (point - bounds.min) * scale;
        spread(cell.x as u64) | spread(cell.y as u64) << 1 | spread(cell.z as u64) << 2
    };
    let codes: Vec<u64> = points.iter().map(code).collect();
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_key(|&i| codes[i]);
    order
}

/// Moves bit `k` of the lowest [`BITS`] bits to bit `3 k`.
fn spread(x: u64) -> u64 {
    let x = x & ((1 << BITS) - 1);
    let x = (x | x << 32) & 0x001f_0000_0000_ffff;
    let x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    let x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    let x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}
