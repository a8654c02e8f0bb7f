//! What one step of a sweep does on a band of columns.

use super::Triple;
use super::band::{BLOCK, Band, BlockInBand, OfBand, OfRows, PIECES, Piece};
use radiosity_simd::{Float, Kernel, LANES, Simd, WideFloat};

/// Rows that are taken together: their sums, or their factors, fit into the registers.
const QUAD: usize = 4;
/// So many rows of a quad are prefetched while one is added, the others while one is multiplied.
const HALF: usize = QUAD / 2;

/// A step on one band: adds the last block, and multiplies by the next one.
pub(super) struct Step<'a> {
    pub(super) band: &'a mut Band,
    /// The last block in this band, with its values.
    pub(super) last: Option<(BlockInBand<'a>, &'a [OfRows<f32>])>,
    /// The next block in this band, and where its products with the band go.
    pub(super) next: Option<(BlockInBand<'a>, &'a mut [OfRows<f32>])>,
    /// What the next step of this thread reads first; where it helps another with that one's last
    /// band, what the other does.
    pub(super) prefetched: Option<BlockInBand<'a>>,
    /// Whether what the last blocks added becomes part of the sums in double precision.
    pub(super) flushes: bool,
}

impl Kernel for Step<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let triples = &mut self.band.triples;
        if let Some((rows, values)) = &self.last {
            for quad in 0..BLOCK / QUAD {
                // The first triple's numbers come from far, and are still at hand for the others.
                let mut of_triples = triples.iter_mut().zip(*values);
                if let Some((triple, values)) = of_triples.next() {
                    let prefetched = fetched(&self.prefetched, quad * QUAD);
                    add(simd, rows, quad, prefetched, values, &mut triple.pending);
                }
                for (triple, values) in of_triples {
                    add(simd, rows, quad, NOTHING, values, &mut triple.pending);
                }
            }
        }
        if self.flushes {
            for triple in &mut *triples {
                flush(simd, triple);
            }
        }
        if let Some((rows, products)) = self.next {
            for quad in 0..BLOCK / QUAD {
                let mut of_triples = triples.iter().zip(&mut *products);
                if let Some((triple, products)) = of_triples.next() {
                    let prefetched = fetched(&self.prefetched, quad * QUAD + HALF);
                    multiply(simd, &rows, quad, prefetched, &triple.x, products);
                }
                for (triple, products) in of_triples {
                    multiply(simd, &rows, quad, NOTHING, &triple.x, products);
                }
            }
        }
    }
}

/// Rows that are fetched.
type Prefetched<'a> = [&'a [Piece<f32>]; HALF];
const NOTHING: Prefetched<'_> = [&[]; HALF];

/// Some rows, from one on, of what is to be prefetched.
#[inline(always)]
fn fetched<'a>(prefetched: &Option<BlockInBand<'a>>, first: usize) -> Prefetched<'a> {
    match prefetched {
        Some(prefetched) => prefetched.rows(first, prefetched.pieces.len()),
        None => NOTHING,
    }
}

#[inline(always)]
fn fetch<S: Simd>(simd: S, prefetched: Prefetched<'_>, piece: usize) {
    if piece < prefetched[0].len() {
        for row in prefetched {
            simd.prefetch(&row[piece]);
        }
    }
}

/// Adds some rows times their values to the sums, and prefetches others.
#[inline(always)]
fn add<S: Simd>(
    simd: S,
    rows: &BlockInBand<'_>,
    quad: usize,
    prefetched: Prefetched<'_>,
    values: &OfRows<f32>,
    sums: &mut Triple<[Piece<f32>; PIECES]>,
) {
    let first = quad * QUAD;
    let count = rows.pieces.len();
    let rows = rows.rows::<QUAD>(first, count);
    let mut factors = [[simd.splat_wide(0.0); 3]; QUAD];
    for k in 0..QUAD {
        for c in 0..3 {
            factors[k][c] = simd.splat_wide(values[c][first + k]);
        }
    }
    let [x, y, z] = sums;
    let (x, y, z) = (&mut x[..count], &mut y[..count], &mut z[..count]);
    for piece in 0..count {
        fetch(simd, prefetched, piece);
        let mut sums = [
            simd.wide(&x[piece]),
            simd.wide(&y[piece]),
            simd.wide(&z[piece]),
        ];
        for k in 0..QUAD {
            let entries = simd.wide(&rows[k][piece]);
            for c in 0..3 {
                sums[c] = sums[c] + entries * factors[k][c];
            }
        }
        x[piece] = sums[0].lanes();
        y[piece] = sums[1].lanes();
        z[piece] = sums[2].lanes();
    }
}

#[inline(always)]
fn flush<S: Simd>(simd: S, triple: &mut OfBand) {
    for c in 0..3 {
        let below = triple.below[c].as_flattened_mut().as_chunks_mut();
        let pending = triple.pending[c].as_flattened_mut().as_chunks_mut();
        for (below, pending) in below.0.iter_mut().zip(pending.0) {
            *below = (simd.f64(below) + simd.widen(simd.f32(pending))).lanes();
            *pending = [0.0; LANES];
        }
    }
}

/// The products of some rows with the values of a band; prefetches others.
#[inline(always)]
fn multiply<S: Simd>(
    simd: S,
    rows: &BlockInBand<'_>,
    quad: usize,
    prefetched: Prefetched<'_>,
    [x, y, z]: &Triple<[Piece<f32>; PIECES]>,
    products: &mut OfRows<f32>,
) {
    let first = quad * QUAD;
    let count = rows.pieces.len();
    let rows = rows.rows::<QUAD>(first, count);
    let [x, y, z] = [&x[..count], &y[..count], &z[..count]];
    let mut sums = [[simd.splat_wide(0.0); 3]; QUAD];
    for piece in 0..count {
        fetch(simd, prefetched, piece);
        let x = [
            simd.wide(&x[piece]),
            simd.wide(&y[piece]),
            simd.wide(&z[piece]),
        ];
        for k in 0..QUAD {
            let entries = simd.wide(&rows[k][piece]);
            for c in 0..3 {
                sums[k][c] = sums[k][c] + entries * x[c];
            }
        }
    }
    for c in 0..3 {
        let totals = S::Wide::totals([sums[0][c], sums[1][c], sums[2][c], sums[3][c]]);
        products[c][first..first + QUAD].copy_from_slice(&totals);
    }
}
