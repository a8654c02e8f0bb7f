//! Threads that take the steps of a sweep together.
//!
//! A sweep has thousands of steps of some microseconds each, too short to call threads for. So
//! helpers are called once and wait for the next step without sleeping. Each worker has a run of
//! bands of its own, the same from step to step but for a band or so, whose numbers are still in
//! its cache; then it takes what is left of those of others, who may have come late or never: from
//! their end, so that it is the same bands again. A claim on a band is a number that also tells the
//! step, so whoever comes late claims nothing.
//!
//! Long because: how threads claim bands is right or wrong as a whole.

use super::Triple;
use super::band::{BLOCK, Band, OfRows, WIDTH, is_zero};
use super::shared::Shared;
use super::worker::Worker;
use crate::SymmetricMatrix;
use radiosity_simd::InstructionSet;
use std::hint::spin_loop;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard};

/// What is shared.
pub(super) struct Workers<'a> {
    pub(super) set: InstructionSet,
    pub(super) matrix: &'a SymmetricMatrix,
    pub(super) triples: usize,
    bands: Vec<Mutex<Band>>,
    /// Which bands have values other than zero.
    nonzero: Vec<AtomicBool>,
    /// Those of the last block.
    values: Shared,
    /// Those of the next block with each band.
    products: Shared,
    /// Per worker.
    claims: Vec<CachePadded<AtomicU64>>,
    /// Bands of this step that are done.
    done: CachePadded<AtomicUsize>,
    is_over: AtomicBool,
    /// Whether a helper has panicked, and its bands will never be done.
    has_failed: AtomicBool,
}

/// Tells the others when it is dropped in a panic.
struct TellPanic<'t>(&'t AtomicBool);

impl Drop for TellPanic<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.store(true, Ordering::Release);
        }
    }
}

/// What would slow others down if it stood in the same line of memory.
#[derive(Default)]
#[repr(align(128))]
struct CachePadded<T>(T);

/// The end of a run that bands are taken from. A claim is one addition to one number, which holds
/// three counters, so that whoever adds knows of which step and which band it is:
///
/// ```text
///  63                     40 39              20 19               0
/// +-------------------------+------------------+------------------+
/// | block of the step, + 1  | taken from back  | taken from front |
/// +-------------------------+------------------+------------------+
/// ```
///
/// A step sets the first counter and clears the others. Neither of these overflows into its
/// neighbour: of each run a worker claims once more than it gets.
#[derive(Clone, Copy)]
pub(super) enum End {
    Front = 1,
    Back = 1 << 20,
}

const STEP: u64 = 1 << 40;
/// How often one looks before letting others have the processor.
const PATIENCE: u32 = 1024;

/// A band that is one's own to work on.
pub(super) struct Claim {
    pub(super) block: usize,
    pub(super) band: usize,
    /// The band to claim after it, if nobody else does first.
    pub(super) following: Option<usize>,
    /// Where its run begins.
    pub(super) first: usize,
}

impl<'a> Workers<'a> {
    pub(super) fn new(
        set: InstructionSet,
        matrix: &'a SymmetricMatrix,
        x: &[Triple<f32>],
        triples: usize,
        count: usize,
    ) -> Workers<'a> {
        let of_bands = || x.chunks(WIDTH * triples);
        let bands = of_bands().map(|x| Mutex::new(Band::new(x, triples)));
        let bands: Vec<Mutex<Band>> = bands.collect();
        let is_nonzero = |x: &[Triple<f32>]| x.as_flattened().iter().any(|&x| x != 0.0);
        Workers {
            set,
            matrix,
            triples,
            values: Shared::new(triples),
            products: Shared::new(triples * bands.len()),
            bands,
            nonzero: of_bands().map(|x| AtomicBool::new(is_nonzero(x))).collect(),
            claims: (0..count).map(|_| CachePadded::default()).collect(),
            done: CachePadded::default(),
            is_over: AtomicBool::new(false),
            has_failed: AtomicBool::new(false),
        }
    }

    pub(super) fn band(&self, index: usize) -> MutexGuard<'_, Band> {
        self.bands[index].lock().expect("no step has panicked")
    }

    pub(super) fn into_bands(self) -> impl Iterator<Item = Band> {
        let bands = self.bands.into_iter();
        bands.map(|band| band.into_inner().expect("no step has panicked"))
    }

    /// Whether a band has values other than zero.
    pub(super) fn is_nonzero(&self, band: usize) -> bool {
        self.nonzero[band].load(Ordering::Relaxed)
    }

    /// How many workers there are.
    pub(super) fn size(&self) -> usize {
        self.claims.len()
    }

    /// Leads the step in which a block is the next one.
    pub(super) fn lead(&self, block: usize, leader: &mut Worker<'a, '_>) {
        self.open(block);
        leader.take_bands();
        self.wait_for(self.bands_of(block));
    }

    /// Lets bands be claimed for the step in which a block is the next one.
    fn open(&self, block: usize) {
        self.done.0.store(0, Ordering::Relaxed);
        for claims in &self.claims {
            claims.0.store((block as u64 + 1) * STEP, Ordering::Release);
        }
    }

    /// Waits until so many bands of this step are done.
    fn wait_for(&self, bands: usize) {
        let has_failed = || self.has_failed.load(Ordering::Acquire);
        wait_while(|| self.done.0.load(Ordering::Acquire) < bands && !has_failed());
        assert!(!has_failed(), "a helper has panicked");
    }

    /// Takes part in all steps, as a worker other than the first, until all are dismissed.
    pub(super) fn help(&self, index: usize) {
        let _guard = TellPanic(&self.has_failed);
        let mut worker = Worker::new(self, index);
        while !self.is_over.load(Ordering::Acquire) {
            let seen = worker.take_bands();
            wait_while(|| {
                let is_same = self.claims[index].0.load(Ordering::Acquire) / STEP == seen;
                is_same && !self.is_over.load(Ordering::Acquire)
            });
        }
    }

    /// Claims a band of a worker, in the step whose number comes too.
    pub(super) fn claim(&self, owner: usize, end: End) -> (u64, Option<Claim>) {
        let claims = self.claims[owner].0.fetch_add(end as u64, Ordering::AcqRel);
        let number = claims / STEP;
        let claim = |block: u64| {
            let block = block as usize;
            let bound = |worker: usize| worker * self.bands_of(block) / self.size();
            let run = bound(owner)..bound(owner + 1);
            let (before, after) = (claims % End::Back as u64, claims % STEP / End::Back as u64);
            let mut left = run.start + before as usize..run.end.saturating_sub(after as usize);
            let mut next = || match end {
                End::Front => left.next(),
                End::Back => left.next_back(),
            };
            Some(Claim {
                block,
                band: next()?,
                following: next(),
                first: run.start,
            })
        };
        (number, number.checked_sub(1).and_then(claim))
    }

    /// Tells that a worker has done so many bands.
    pub(super) fn count(&self, bands: usize) {
        self.done.0.fetch_add(bands, Ordering::AcqRel);
    }

    /// How many bands there are left of a block.
    fn bands_of(&self, block: usize) -> usize {
        self.bands.len().min((block * BLOCK).div_ceil(WIDTH))
    }

    /// The values of the block before.
    pub(super) fn values(&self, values: &mut [OfRows<f32>]) {
        self.values.get(0, values);
    }

    /// Sets those of a block at the end of its step, and the first sums below its rows.
    pub(super) fn set_values(&self, block: usize, values: &[OfRows<f32>], below: &[OfRows<f64>]) {
        self.values.set(0, values);
        let (band, column) = (block * BLOCK / WIDTH, block * BLOCK % WIDTH);
        self.band(band).set(column, values, below);
        if !is_zero(values) {
            self.nonzero[band].store(true, Ordering::Relaxed);
        }
    }

    pub(super) fn set_products(&self, band: usize, products: &[OfRows<f32>]) {
        self.products.set(band * self.triples, products);
    }

    /// The sums of a block's products with all bands.
    pub(super) fn add_products(&self, block: usize, sums: &mut [OfRows<f64>]) {
        for band in 0..self.bands_of(block) {
            self.products.add_to(sums, band * self.triples);
        }
    }

    /// Sends the helpers away, be it by a panic.
    pub(super) fn dismissed_at_end(&self) -> impl Drop {
        Dismissal(&self.is_over)
    }
}

struct Dismissal<'a>(&'a AtomicBool);

impl Drop for Dismissal<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}

fn wait_while(holds: impl Fn() -> bool) {
    let mut looks = 0;
    while holds() {
        looks += 1;
        if looks < PATIENCE {
            spin_loop();
        } else {
            std::thread::yield_now();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::packed_len;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    /// The bands that claims of both ends, in turn, give of a run, and those that follow them.
    fn claimed(workers: &Workers<'_>, owner: usize) -> Vec<(usize, Option<usize>)> {
        let ends = [End::Front, End::Back].into_iter().cycle();
        let claims = ends.map_while(|end| workers.claim(owner, end).1);
        claims.map(|claim| (claim.band, claim.following)).collect()
    }

    #[test]
    fn every_band_is_claimed_once_a_step() {
        let size = 7 * WIDTH;
        let matrix = SymmetricMatrix::new(size, vec![0.0; packed_len(size)]).unwrap();
        let workers = Workers::new(
            InstructionSet::current(),
            &matrix,
            &vec![[1.0; 3]; size],
            1,
            2,
        );
        assert!(claimed(&workers, 0).is_empty(), "before the first step");
        for block in [size / BLOCK, 5 * WIDTH / BLOCK] {
            workers.open(block);
            let bands = workers.bands_of(block);
            let runs = [claimed(&workers, 0), claimed(&workers, 1)];
            let first = |run: &[(usize, Option<usize>)]| run[0];
            assert_eq!(first(&runs[0]), (0, Some(1)));
            assert_eq!(first(&runs[1]), (bands / 2, Some(bands / 2 + 1)));
            let mut all: Vec<usize> = runs.concat().into_iter().map(|claim| claim.0).collect();
            all.sort_unstable();
            assert_eq!(all, (0..bands).collect::<Vec<usize>>());
            assert!(claimed(&workers, 0).is_empty(), "all are taken");
        }
        workers.open(size / BLOCK);
        assert_eq!(workers.claim(1, End::Back).1.unwrap().band, 6);
        let claim = workers.claim(1, End::Back).1.unwrap();
        assert_eq!((claim.band, claim.following), (5, Some(4)));
        assert_eq!((claim.block, claim.first), (size / BLOCK, 3));
    }

    /// The helper's run has a band that panics whoever takes it.
    #[test]
    fn nobody_waits_for_a_helper_that_has_panicked() {
        let size = 4 * WIDTH;
        let matrix = SymmetricMatrix::new(size, vec![0.0; packed_len(size)]).unwrap();
        let x = vec![[1.0; 3]; size];
        let workers = Workers::new(InstructionSet::current(), &matrix, &x, 1, 2);
        let poison = || {
            let _band = workers.band(3);
            panic!("on purpose");
        };
        assert!(catch_unwind(AssertUnwindSafe(poison)).is_err());
        let block = size / BLOCK - 1;
        workers.open(block);
        assert!(catch_unwind(AssertUnwindSafe(|| workers.help(1))).is_err());
        let wait = || workers.wait_for(workers.bands_of(block));
        assert!(catch_unwind(AssertUnwindSafe(wait)).is_err());
    }
}
