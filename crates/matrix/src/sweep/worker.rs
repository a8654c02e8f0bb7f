//! What one thread knows of a sweep, and does in it.

use super::band::{Block, BlockInBand, OfRows, blocks_of, is_zero};
use super::step::Step;
use super::workers::{Claim, End, Workers};

/// After so many blocks, sums in single precision become part of those in double precision.
const FLUSHING: usize = 4;

/// One of the workers.
pub(super) struct Worker<'a, 't> {
    workers: &'t Workers<'a>,
    index: usize,
    /// The number of the next block.
    block: Option<usize>,
    last: Option<Block<'a>>,
    next: Option<Block<'a>>,
    after_next: Option<Block<'a>>,
    /// Those of the last block.
    values: Vec<OfRows<f32>>,
    /// Those of the next block with a band.
    products: Vec<OfRows<f32>>,
}

impl<'a, 't> Worker<'a, 't> {
    pub(super) fn new(workers: &'t Workers<'a>, index: usize) -> Worker<'a, 't> {
        let of_triples = || vec![OfRows::default(); workers.triples];
        Worker {
            workers,
            index,
            block: None,
            last: None,
            next: None,
            after_next: None,
            values: of_triples(),
            products: of_triples(),
        }
    }

    /// Takes bands of the current step until there are no more; gives its number.
    pub(super) fn take_bands(&mut self) -> u64 {
        let (number, mut bands) = self.take_run(self.index, End::Front);
        for other in (self.index + 1..self.workers.size()).chain(0..self.index) {
            bands += self.take_run(other, End::Back).1;
        }
        if bands > 0 {
            self.workers.count(bands);
        }
        number
    }

    /// Takes what is left of a run; gives the number of the step, and how many bands it took.
    fn take_run(&mut self, owner: usize, end: End) -> (u64, usize) {
        let mut bands = 0;
        loop {
            let (number, claim) = self.workers.claim(owner, end);
            let Some(claim) = claim else {
                return (number, bands);
            };
            self.turn_to(claim.block);
            self.step(&claim);
            bands += 1;
        }
    }

    fn turn_to(&mut self, block: usize) {
        let matrix = self.workers.matrix;
        if self.block == Some(block) {
            return;
        }
        if self.block.map(|before| before + 1) == Some(block) {
            (self.last, self.next) = (self.next, self.after_next);
        } else {
            self.last = block
                .checked_sub(1)
                .and_then(|last| Block::new(matrix, last));
            self.next = Block::new(matrix, block);
        }
        self.after_next = Block::new(matrix, block + 1);
        self.workers.values(&mut self.values);
        self.last = self.last.take().filter(|_| !is_zero(&self.values));
        self.block = Some(block);
    }

    fn step(&mut self, claim: &Claim) {
        let (workers, band) = (self.workers, claim.band);
        let last = self.last.as_ref().map(|last| last.in_band(band));
        let next = nonzero(workers, &self.next, band);
        let prefetched = match claim.following {
            Some(band) => nonzero(workers, &self.next, band),
            None => nonzero(workers, &self.after_next, claim.first),
        };
        if next.is_none() {
            self.products.fill(OfRows::default());
        }
        let is_at_end = claim.block == blocks_of(workers.matrix);
        workers.set.run(Step {
            band: &mut workers.band(band),
            last: last.map(|last| (last, &self.values[..])),
            next: next.map(|next| (next, &mut self.products[..])),
            prefetched,
            flushes: is_at_end || claim.block.is_multiple_of(FLUSHING),
        });
        workers.set_products(band, &self.products);
    }
}

/// A block in a band, unless that is dark, so that there is nothing to multiply.
fn nonzero<'b>(
    workers: &Workers<'_>,
    block: &'b Option<Block<'_>>,
    band: usize,
) -> Option<BlockInBand<'b>> {
    let block = block.as_ref().filter(|_| workers.is_nonzero(band));
    block.map(|block| block.in_band(band))
}
