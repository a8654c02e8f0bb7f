//! Passes over the matrix beside the bandwidth of memory.

use super::runs;
use crate::figure::{Figure, Target};
use crate::timing::{best_seconds, median};
use radiosity::form_factors::FormFactors;
use radiosity::matrix::SymmetricMatrix;
use rayon::prelude::*;

/// Percent of the bandwidth that are promised for one light, and how much longer four may take.
const BANDWIDTH: f64 = 70.0;
const FOUR_LIGHTS: f64 = 1.3;

/// Passes over the matrix against the bandwidth of memory. Both are timed in turn, since memory is
/// not always as fast: the shares are the middle ones of all rounds.
pub(super) fn passes(made: &FormFactors) -> Vec<Figure> {
    let patches = made.areas.len();
    let mapped = made.exchange.matrix();
    let in_memory = SymmetricMatrix::new(patches, mapped.values().to_vec());
    let in_memory = in_memory.expect("they are as many as before");
    let seconds = |matrix: &SymmetricMatrix, lights: usize| {
        let mut x = vec![[1.0; 3]; patches * lights];
        best_seconds(2, || {
            std::hint::black_box(matrix.sweep(&mut x, lights, &mut |_, _, _| ()));
        })
    };
    let round = |_| {
        let read = best_seconds(2, || {
            std::hint::black_box(sum(mapped.values()));
        });
        let pass = seconds(mapped, 1);
        let four = seconds(mapped, 4);
        [read, pass, seconds(&in_memory, 1), four]
    };
    let rounds: Vec<[f64; 4]> = (0..runs(patches)).map(round).collect();
    let of_rounds = |figure: fn(&[f64; 4]) -> f64| median(rounds.iter().map(figure).collect());
    let figure = |what: &str, value: f64, unit, target: Option<Target>| {
        let name = format!("solver.{patches}.{what}");
        Figure::new(name, Some(value), unit, target.filter(|_| patches > 10_000))
    };
    let bytes = 4e-9 * mapped.values().len() as f64;
    let most = Some(Target::AtLeast(BANDWIDTH));
    vec![
        figure(
            "read",
            bytes / of_rounds(|round| round[0]),
            "GB/s, all threads",
            None,
        ),
        figure(
            "pass",
            1e3 * of_rounds(|round| round[1]),
            "ms for one light, from a mapped file",
            None,
        ),
        figure(
            "pass.bandwidth",
            100.0 * of_rounds(|[read, pass, ..]| read / pass),
            "% of that",
            most,
        ),
        figure(
            "pass.memory",
            100.0 * of_rounds(|[read, _, pass, _]| read / pass),
            "% of that, from memory",
            most,
        ),
        figure(
            "pass.four_lights",
            of_rounds(|[_, pass, _, four]| four / pass),
            "times the pass for one",
            Some(Target::Between(0.0, FOUR_LIGHTS)),
        ),
    ]
}

/// Reads all numbers.
fn sum(values: &[f32]) -> f32 {
    let chunk = |chunk: &[f32]| {
        let mut sums = [0.0; 64];
        for values in chunk.as_chunks::<64>().0 {
            sums.iter_mut()
                .zip(values)
                .for_each(|(sum, value)| *sum += value);
        }
        sums.iter().sum::<f32>()
    };
    values.par_chunks(1 << 16).map(chunk).sum()
}
