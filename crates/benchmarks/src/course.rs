//! The solver of the course's program, written anew: the baseline.
//!
//! It keeps the whole matrix in double precision, and goes through it 40 times, row by row and
//! column by column, with a colour for each patch. Loops and precision are the course's; the words
//! are ours.

use crate::timing::best_seconds;
use radiosity::form_factors::FormFactors;

const SWEEPS: u32 = 40;
/// Sweeps that are timed where one takes long; all take as long.
const FEW: u32 = 3;
const LARGE: usize = 10_000;

/// What 40 sweeps take on one thread, each as long as the shortest.
pub(crate) fn seconds(made: &FormFactors) -> f64 {
    let patches = made.areas.len();
    let mut factors = vec![0.0; patches * patches];
    for (i, row) in factors.chunks_exact_mut(patches).enumerate() {
        row.copy_from_slice(&made.row(i));
    }
    // Numbers do not change how long it takes.
    let (emission, reflectance) = (vec![[0.1, 0.2, 0.3]; patches], [0.75, 0.5, 0.25]);
    let mut radiosity = emission.clone();
    let sweeps = if patches < LARGE { SWEEPS } else { FEW };
    let seconds = best_seconds(sweeps, || {
        sweep(&factors, &emission, reflectance, &mut radiosity);
    });
    std::hint::black_box(&radiosity);
    f64::from(SWEEPS) * seconds
}

fn sweep(
    factors: &[f64],
    emission: &[[f64; 3]],
    reflectance: [f64; 3],
    radiosity: &mut [[f64; 3]],
) {
    let patches = emission.len();
    for i in 0..patches {
        let mut incoming = [0.0; 3];
        for j in 0..patches {
            let factor = factors[i * patches + j];
            for c in 0..3 {
                incoming[c] += factor * radiosity[j][c];
            }
        }
        for c in 0..3 {
            radiosity[i][c] = emission[i][c] + reflectance[c] * incoming[c];
        }
    }
}
