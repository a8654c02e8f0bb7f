//! Sweeps against the loops of textbooks, in double precision.

use super::*;
use crate::packed_len;
use proptest::prelude::*;
use std::panic::AssertUnwindSafe;

/// Numbers in [0, 1) that are not too regular.
fn number(seed: usize) -> f32 {
    (seed as u32).wrapping_mul(2_654_435_761).rotate_left(16) as f32 / u32::MAX as f32
}

/// Rows that sum to at most 1.
fn matrix(size: usize) -> SymmetricMatrix {
    let values = (0..packed_len(size)).map(|k| number(k) / size as f32);
    SymmetricMatrix::new(size, values.collect::<Vec<f32>>()).unwrap()
}

fn vectors(size: usize, triples: usize) -> Vec<Triple<f32>> {
    let triple = |k: usize| std::array::from_fn(|c| number(1_000_003 * c + 7 * k));
    (0..size * triples).map(triple).collect()
}

/// Half of what it was, and half of the sum: of the size of 1.
fn relax(sums: &[Triple<f64>], x: &mut [Triple<f32>]) {
    for (sum, x) in sums.iter().zip(x) {
        (0..3).for_each(|c| x[c] = (0.5 * f64::from(x[c]) + 0.5 * sum[c]) as f32);
    }
}

/// What `update` was told, and what was returned.
type Sums = (Vec<Triple<f64>>, Vec<Triple<f64>>);

fn swept(
    set: InstructionSet,
    count: usize,
    matrix: &SymmetricMatrix,
    x: &mut [Triple<f32>],
    triples: usize,
) -> Sums {
    let mut above = Vec::new();
    let below = matrix.sweep_on(set, count, x, triples, &mut |i, sums, x| {
        assert_eq!(above.len(), i * triples, "row after row");
        above.extend_from_slice(sums);
        relax(sums, x);
    });
    (above, below)
}

/// The same, entry by entry, with the values that the sweep found: rounding alone may differ.
fn plain(matrix: &SymmetricMatrix, x: &[Triple<f32>], triples: usize) -> Sums {
    let mut above = vec![[0.0; 3]; x.len()];
    let mut below = above.clone();
    for (i, row) in matrix.rows() {
        for (j, &entry) in row.iter().enumerate() {
            for k in 0..triples {
                for c in 0..3 {
                    above[i * triples + k][c] +=
                        f64::from(entry) * f64::from(x[j * triples + k][c]);
                    below[j * triples + k][c] +=
                        f64::from(entry) * f64::from(x[i * triples + k][c]);
                }
            }
        }
    }
    (above, below)
}

/// The most operations in single precision behind a sum: a product, and additions of 64 rows.
/// All terms are positive, so each operation errs by at most 2^-24 of the sum.
const ROUNDING: f64 = 65.0 / (1 << 24) as f64;

fn assert_close(found: &[Triple<f64>], expected: &[Triple<f64>]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
        assert!(
            (found - expected).abs() <= ROUNDING * expected,
            "{found} {expected}"
        );
    }
}

fn check(size: usize, triples: usize) {
    let matrix = matrix(size);
    let start = vectors(size, triples);
    let mut x = start.clone();
    let found = swept(InstructionSet::current(), 1, &matrix, &mut x, triples);
    let expected = plain(&matrix, &x, triples);
    assert_close(&found.0, &expected.0);
    assert_close(&found.1, &expected.1);
    let mut relaxed = start;
    relax(&found.0, &mut relaxed);
    assert_eq!(x, relaxed, "what the updates made of the sums");
}

proptest! {
    #[test]
    fn every_sum_has_the_newest_values(size in 0usize..100, triples in 1usize..5) {
        check(size, triples);
    }
}

#[test]
fn bands_and_blocks_join() {
    for size in [511, 512, 513, 1023, 1024, 1025, 1041, 2063] {
        check(size, 1);
    }
    check(1100, 2);
}

/// Vectors of which some blocks and bands are dark.
fn partly_lit(size: usize, triples: usize) -> Vec<Triple<f32>> {
    let mut x = vectors(size, triples);
    for (k, x) in x.iter_mut().enumerate() {
        let row = k / triples;
        if !((600..640).contains(&row) || (1100..1111).contains(&row)) {
            *x = [0.0; 3];
        }
    }
    x
}

/// Some do not stay dark.
fn relax_some(i: usize, sums: &[Triple<f64>], x: &mut [Triple<f32>]) {
    if (1700..1750).contains(&i) {
        relax(sums, x);
    }
}

#[test]
fn dark_blocks_and_bands_have_no_part_in_sums() {
    let size = 2100;
    let matrix = matrix(size);
    let mut x = partly_lit(size, 2);
    let mut above = Vec::new();
    let below = matrix.sweep(&mut x, 2, &mut |i, sums, x| {
        above.extend_from_slice(sums);
        relax_some(i, sums, x);
    });
    let expected = plain(&matrix, &x, 2);
    assert_close(&above, &expected.0);
    assert_close(&below, &expected.1);
}

/// A number that is none times zero would be none.
#[test]
fn what_is_dark_is_passed_over() {
    let size = 2100;
    let is_nonzero = |row: usize| row / 512 == 1;
    let blocks_are_lit = |row: usize| is_nonzero(row / 16 * 16);
    let values = (0..size).flat_map(|i| {
        // Rows are multiplied by the values of a nonzero band, columns by those of a block.
        let is_read = move |j: usize| blocks_are_lit(i) || is_nonzero(j) || i / 16 == j / 16;
        (0..i).map(move |j| if is_read(j) { number(i + j) } else { f32::NAN })
    });
    let matrix = SymmetricMatrix::new(size, values.collect::<Vec<f32>>()).unwrap();
    let mut x: Vec<Triple<f32>> = (0..size)
        .map(|row| if is_nonzero(row) { [1.0; 3] } else { [0.0; 3] })
        .collect();
    let mut sums = Vec::new();
    let below = matrix.sweep(&mut x, 1, &mut |_, above, _| sums.extend_from_slice(above));
    sums.extend(below);
    assert!(sums.as_flattened().iter().all(|sum| sum.is_finite()));
}

fn pool(threads: usize) -> rayon::ThreadPool {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads")
}

/// More workers than there are threads, too: those come late, or never.
#[test]
fn neither_threads_nor_instruction_sets_have_a_part_in_the_result() {
    let size = 4200;
    let matrix = matrix(size);
    let run = |set: InstructionSet, count: usize, threads: usize| {
        let mut x = vectors(size, 1);
        let sums = pool(threads).install(|| swept(set, count, &matrix, &mut x, 1));
        (x, sums)
    };
    let expected = run(InstructionSet::current(), 1, 1);
    for (count, threads) in [(2, 2), (3, 3), (5, 5), (9, 9), (3, 1), (5, 2)] {
        assert!(
            run(InstructionSet::current(), count, threads) == expected,
            "{count} workers, {threads} threads"
        );
    }
    for set in InstructionSet::available() {
        assert!(run(set, 2, 2) == expected, "{}", set.name());
    }
}

/// Whoever takes a band, it is dark for all of them, or for none.
#[test]
fn nor_have_they_where_some_is_dark() {
    let size = 4200;
    let matrix = matrix(size);
    let run = |set: InstructionSet, count: usize| {
        let mut x = partly_lit(size, 1);
        let mut above = Vec::new();
        let below = pool(count).install(|| {
            matrix.sweep_on(set, count, &mut x, 1, &mut |i, sums, x| {
                above.extend_from_slice(sums);
                relax_some(i, sums, x);
            })
        });
        (x, above, below)
    };
    let expected = run(InstructionSet::current(), 1);
    for set in InstructionSet::available() {
        for count in [1, 2, 5] {
            assert!(run(set, count) == expected, "{} {count}", set.name());
        }
    }
}

/// Helpers go home then, and the panic comes out.
#[test]
fn a_panic_in_an_update_ends_the_sweep() {
    let size = 1100;
    let matrix = matrix(size);
    let sweep = || {
        let mut x = vectors(size, 1);
        matrix.sweep_on(InstructionSet::current(), 3, &mut x, 1, &mut |i, _, _| {
            assert!(i < 1050, "enough");
        })
    };
    let caught = std::panic::catch_unwind(AssertUnwindSafe(|| pool(3).install(sweep)));
    let reason = caught.expect_err("it panicked");
    assert_eq!(reason.downcast_ref::<&str>(), Some(&"enough"));
}

#[test]
fn nothing_is_done_without_vectors() {
    let below = matrix(5).sweep(&mut [], 0, &mut |_, _, _| {
        panic!("there is nothing to update")
    });
    assert!(below.is_empty());
}
