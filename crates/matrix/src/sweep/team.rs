//! Threads that take the steps of a sweep together.
//!
//! A sweep has thousands of steps of some microseconds each, too short to call threads for. So
//! helpers are called once and wait for the next step without sleeping. Each member has a run of
//! bands of its own, the same from step to step but for a band or so, whose numbers are still in
//! its cache; then it takes what is left of those of others, who may have come late or never. A
//! claim on a band is a number that also tells the step, so whoever comes late claims nothing.

use super::band::{Band, Block};
use super::step::Step;
use radiosity_simd::InstructionSet;
use std::hint::spin_loop;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, RwLock};

/// What is shared.
pub(super) struct Team<'a> {
    set: InstructionSet,
    bands: Vec<Mutex<Band>>,
    task: RwLock<Task<'a>>,
    /// Per member: the number of the step, times [`CLAIMS`], plus how many of its bands are claimed.
    claims: Vec<AtomicU64>,
    /// Bands of this step that are done.
    done: AtomicUsize,
    is_over: AtomicBool,
}

/// One step.
#[derive(Default)]
struct Task<'a> {
    number: u64,
    /// The first so many bands.
    bands: usize,
    last: Option<Block<'a>>,
    next: Option<Block<'a>>,
}

/// More than there are bands.
const CLAIMS: u64 = 1 << 32;
/// How often one looks before letting others have the processor.
const PATIENCE: u32 = 256;

impl<'a> Team<'a> {
    pub(super) fn new(set: InstructionSet, bands: Vec<Band>, members: usize) -> Team<'a> {
        Team {
            set,
            bands: bands.into_iter().map(Mutex::new).collect(),
            task: RwLock::default(),
            claims: (0..members).map(|_| AtomicU64::new(0)).collect(),
            done: AtomicUsize::new(0),
            is_over: AtomicBool::new(false),
        }
    }

    pub(super) fn band(&self, index: usize) -> MutexGuard<'_, Band> {
        self.bands[index].lock().expect("no step has panicked")
    }

    pub(super) fn into_bands(self) -> impl Iterator<Item = Band> {
        let bands = self.bands.into_iter();
        bands.map(|band| band.into_inner().expect("no step has panicked"))
    }

    /// Leads a step on the first so many bands, and gives the next block back when it is done.
    pub(super) fn lead(
        &self,
        bands: usize,
        last: Option<Block<'a>>,
        next: Option<Block<'a>>,
    ) -> Option<Block<'a>> {
        let number = {
            let mut task = self.task.write().expect("no step has panicked");
            let number = task.number + 1;
            *task = Task {
                number,
                bands,
                last,
                next,
            };
            number
        };
        self.done.store(0, Ordering::Relaxed);
        for claims in &self.claims {
            claims.store(number * CLAIMS, Ordering::Release);
        }
        self.take_bands(0);
        wait_while(|| self.done.load(Ordering::Acquire) < bands);
        self.task.write().expect("no step has panicked").next.take()
    }

    /// Takes part in all steps, as a member other than the first, until the team is dismissed.
    pub(super) fn help(&self, member: usize) {
        while !self.is_over.load(Ordering::Acquire) {
            let number = self.take_bands(member);
            wait_while(|| {
                let is_same = self.claims[member].load(Ordering::Acquire) / CLAIMS == number;
                is_same && !self.is_over.load(Ordering::Acquire)
            });
        }
    }

    /// Takes bands of the current step until there are no more; gives its number.
    fn take_bands(&self, member: usize) -> u64 {
        let number = self.take_bands_of(member);
        for other in (member + 1..self.claims.len()).chain(0..member) {
            self.take_bands_of(other);
        }
        number
    }

    fn take_bands_of(&self, owner: usize) -> u64 {
        loop {
            let claim = self.claims[owner].fetch_add(1, Ordering::AcqRel);
            let number = claim / CLAIMS;
            let task = self.task.read().expect("no step has panicked");
            let bound = |member: usize| member * task.bands / self.claims.len();
            let index = bound(owner) + (claim % CLAIMS) as usize;
            if task.number != number || index >= bound(owner + 1) {
                return number;
            }
            let _count = CountWhenDone(&self.done);
            self.set.run(Step {
                band: &mut self.band(index),
                last: task.last.as_ref(),
                next: task.next.as_ref(),
            });
        }
    }

    /// Sends the helpers away, be it by a panic.
    pub(super) fn dismissed_at_end(&self) -> impl Drop {
        Dismissal(&self.is_over)
    }
}

struct CountWhenDone<'a>(&'a AtomicUsize);

impl Drop for CountWhenDone<'_> {
    fn drop(&mut self) {
        self.0.fetch_add(1, Ordering::AcqRel);
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
