//! What one step of a sweep does on a band of columns.

use super::Triple;
use super::band::{BLOCK, Band, Block, Lanes, OfBand, PIECES, Pieces};
use radiosity_simd::{Float, Kernel, Simd};

/// Rows whose products are taken together: their sums fit into the registers.
const QUAD: usize = 4;
/// How many numbers ahead memory is asked for what comes next in a row.
const AHEAD: usize = 512;

/// A step on one band: adds the last block, and multiplies by the next one.
pub(super) struct Step<'a> {
    pub(super) band: &'a mut Band,
    pub(super) last: Option<&'a Block<'a>>,
    pub(super) next: Option<&'a Block<'a>>,
}

impl Kernel for Step<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Step { band, last, next } = self;
        for triple in &mut band.triples {
            triple.products = [[0.0; BLOCK]; 3];
        }
        // The first triple's numbers come from memory, and are still at hand for the others.
        if let Some(last) = last {
            let rows = last.pieces(band);
            let mut triples = band.triples.iter_mut().zip(&last.values);
            if let Some((triple, values)) = triples.next() {
                add::<S, true>(simd, &rows, values, &mut triple.below);
            }
            for (triple, values) in triples {
                add::<S, false>(simd, &rows, values, &mut triple.below);
            }
        }
        if let Some(next) = next {
            let rows = next.pieces(band);
            let mut triples = band.triples.iter_mut();
            if let Some(triple) = triples.next() {
                multiply::<S, true>(simd, &rows, triple);
            }
            for triple in triples {
                multiply::<S, false>(simd, &rows, triple);
            }
        }
    }
}

/// Adds the rows times their values to the sums. `FETCH` has what is needed next fetched.
#[inline(always)]
fn add<S: Simd, const FETCH: bool>(
    simd: S,
    rows: &Pieces<'_>,
    values: &Triple<[f32; BLOCK]>,
    sums: &mut Triple<[Lanes<f64>; PIECES]>,
) {
    const AT_ONCE: usize = 4;
    let pieces = rows[0].len();
    let whole = pieces - pieces % AT_ONCE;
    for first in (0..whole).step_by(AT_ONCE) {
        add_pieces::<S, AT_ONCE, FETCH>(simd, rows, first, values, sums);
    }
    for first in whole..pieces {
        add_pieces::<S, 1, false>(simd, rows, first, values, sums);
    }
}

#[inline(always)]
fn add_pieces<S: Simd, const COUNT: usize, const FETCH: bool>(
    simd: S,
    rows: &Pieces<'_>,
    first: usize,
    values: &Triple<[f32; BLOCK]>,
    sums: &mut Triple<[Lanes<f64>; PIECES]>,
) {
    let mut parts = [[simd.splat_f32(0.0); 3]; COUNT];
    for row in 0..BLOCK {
        let entries = &rows[row][first..first + COUNT];
        if FETCH {
            for pair in entries.as_chunks::<2>().0 {
                simd.prefetch(&pair[0], AHEAD);
            }
        }
        for c in 0..3 {
            let value = simd.splat_f32(values[c][row]);
            for k in 0..COUNT {
                parts[k][c] = parts[k][c] + simd.f32(&entries[k]) * value;
            }
        }
    }
    for c in 0..3 {
        let sums = &mut sums[c][first..first + COUNT];
        for k in 0..COUNT {
            sums[k] = (simd.f64(&sums[k]) + simd.widen(parts[k][c])).lanes();
        }
    }
}

/// Adds the products of rows with the values of a band. `FETCH` as in [`add`].
#[inline(always)]
fn multiply<S: Simd, const FETCH: bool>(simd: S, rows: &Pieces<'_>, triple: &mut OfBand) {
    let [x, y, z] = &triple.x;
    let x = [x, y, z].map(|x| x.as_chunks::<2>().0);
    for quad in (0..BLOCK).step_by(QUAD) {
        let rows: [&[[Lanes<f32>; 2]]; QUAD] =
            std::array::from_fn(|k| rows[quad + k].as_chunks().0);
        let mut sums = [[simd.splat_f32(0.0); 3]; QUAD];
        for pair in 0..rows[0].len() {
            let x = [&x[0][pair], &x[1][pair], &x[2][pair]];
            let rows = [
                &rows[0][pair],
                &rows[1][pair],
                &rows[2][pair],
                &rows[3][pair],
            ];
            if FETCH {
                for row in rows {
                    simd.prefetch(&row[0], AHEAD);
                }
            }
            for piece in 0..2 {
                let x = [
                    simd.f32(&x[0][piece]),
                    simd.f32(&x[1][piece]),
                    simd.f32(&x[2][piece]),
                ];
                for k in 0..QUAD {
                    let entries = simd.f32(&rows[k][piece]);
                    for c in 0..3 {
                        sums[k][c] = sums[k][c] + entries * x[c];
                    }
                }
            }
        }
        for (k, sums) in sums.iter().enumerate() {
            for (c, &sum) in sums.iter().enumerate() {
                triple.products[c][quad + k] += total(simd.widen(sum).lanes());
            }
        }
    }
}

#[inline(always)]
fn total(lanes: Lanes<f64>) -> f64 {
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}
