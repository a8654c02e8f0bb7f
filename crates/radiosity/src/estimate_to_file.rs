//! Stage 2 on a real machine: form factors are kept as they are made.

use crate::artifact::{CachePolicy, usable};
use crate::error::Error;
use crate::forecast::prediction;
use crate::metadata::FactorFacts;
use crate::observer::{Observer, Stage};
use crate::resources::Needs;
use crate::row_batches::{Batches, Finished, estimate_in_memory};
use radiosity_cache::{CacheError, Draft, Id, Store, Unusable};
use radiosity_form_factors::{Estimation, Estimator, FormFactors};
use radiosity_geometry::Mesh;
use radiosity_matrix::{SymmetricMatrix, packed_len};

/// What is to be estimated.
pub(crate) struct Job<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) estimator: Estimator,
    /// Whether they are closed afterwards.
    pub(crate) closure: bool,
    pub(crate) observer: &'a dyn Observer,
}

impl Job<'_> {
    /// In memory.
    pub(crate) fn run(&self) -> Result<FormFactors, Error> {
        self.needs().check_memory()?;
        Ok(self.run_in_memory(&Estimation::new(self.mesh, self.estimator)))
    }

    fn run_in_memory(&self, estimation: &Estimation<'_>) -> FormFactors {
        self.begin(&self.needs(), 0, estimation);
        let patches = self.mesh.patches.len();
        let (values, tally) = estimate_in_memory(estimation, self.observer);
        self.observer.end();
        let matrix = SymmetricMatrix::new(patches, values).expect("all rows are made");
        estimation.complete(matrix, &tally)
    }

    /// In a draft of the artifact's file, which an interrupted run may have begun. The caller has
    /// the artifact's lock.
    pub(crate) fn run_journaled(
        &self,
        store: &Store,
        id: &Id<'_>,
        sources: CachePolicy,
    ) -> Result<(FormFactors, bool), Error> {
        let needs = self.needs();
        needs.check_memory()?;
        let estimation = Estimation::new(self.mesh, self.estimator);
        let blank = FactorFacts::blank(self.mesh, self.estimator, estimation.tells_errors());
        let resumed = match sources {
            CachePolicy::Cached => self.resume(store, id, &blank, &estimation),
            CachePolicy::Computed => None,
        };
        let begun = match resumed {
            Some((draft, finished)) => {
                needs.check_disk(store, 4 * draft.saved())?;
                Some((draft, finished))
            }
            None => {
                let draft = self.begin_draft(store, id, &blank)?;
                draft.map(|draft| (draft, Finished::nothing(needs.patches)))
            }
        };
        let Some((mut draft, finished)) = begun else {
            return Ok((self.run_in_memory(&estimation), false));
        };
        self.begin(&needs, finished.pairs, &estimation);
        let mut batches = Batches::after(finished, &estimation, self.observer);
        let written = draft.extend(&mut batches, &|error, kept| {
            let kept = kept as f64 / needs.pairs as f64;
            self.observer.note(&not_kept(error, id, kept, sources));
        });
        self.observer.end();
        written?;
        let matrix = SymmetricMatrix::new(self.mesh.patches.len(), draft.values()?);
        let matrix = matrix.expect("all rows are made");
        let made = estimation.complete(matrix, &batches.into_tally());
        let facts = FactorFacts::new(self.mesh, self.estimator, &made);
        let is_cached = usable(draft.finish(&facts), self.observer, id) == Some(true);
        Ok((made, is_cached))
    }

    /// A new draft, if the cache can be used and the disk has room, without what an interrupted
    /// writer has left.
    pub(crate) fn begin_draft(
        &self,
        store: &Store,
        id: &Id<'_>,
        blank: &FactorFacts,
    ) -> Result<Option<Draft>, Error> {
        let needs = self.needs();
        // It would only take the room that is needed now.
        Draft::discard(store, id);
        needs.check_disk(store, 0)?;
        let draft = Draft::begin(store, id, blank, needs.pairs);
        Ok(usable(draft, self.observer, id))
    }

    pub(crate) fn needs(&self) -> Needs {
        Needs::of(
            self.mesh.patches.len(),
            self.mesh.faces.len(),
            self.estimator,
        )
    }

    /// Says what lies ahead.
    fn begin(&self, needs: &Needs, done: u64, estimation: &Estimation<'_>) {
        let left = needs.pairs - done;
        if done > 0 {
            let percent = 100.0 * done as f64 / needs.pairs as f64;
            self.observer.note(&format!(
                "an interrupted run has left {percent:.0} % of the form factors: only the others \
                 are computed"
            ));
        }
        let told = needs.with_closure(self.closure);
        if let Some(prediction) = prediction(&told, left, estimation, self) {
            self.observer.note(&prediction);
        }
        self.observer.begin(Stage::FormFactors, needs.pairs);
        self.observer.advance(done);
    }

    /// What an interrupted run has left, or a note why it cannot be used.
    fn resume(
        &self,
        store: &Store,
        id: &Id<'_>,
        blank: &FactorFacts,
        estimation: &Estimation<'_>,
    ) -> Option<(Draft, Finished)> {
        let size = self.mesh.patches.len();
        let count = packed_len(size) as u64;
        let resumed = Draft::resume::<Finished>(store, id, blank, count).and_then(|resumed| {
            let fits = |(draft, finished): &(Draft, Finished)| {
                let first = finished.rows as usize;
                let ends = finished.begun.iter().map(|begun| begun.rows.end);
                let starts = std::iter::once(first).chain(ends);
                let mut begun = finished.begun.iter().zip(starts);
                let is_end = first == size || estimation.next_rows(first, 0).is_some();
                is_end
                    && draft.saved() == packed_len(first) as u64
                    && (draft.saved()..=count).contains(&finished.pairs)
                    && begun.all(|(begun, first)| estimation.has_begun(begun, first))
            };
            let is_whole = resumed.as_ref().is_none_or(fits);
            is_whole.then_some(resumed).ok_or(Unusable::Version)
        });
        let not_used = |why: &Unusable| {
            self.observer.note(&format!(
                "what an interrupted run has left of the {} is not used: {why}",
                id.stage
            ));
        };
        resumed.inspect_err(not_used).ok().flatten()
    }
}

/// Says that the rest is made in memory, and what the next run has of it.
pub(crate) fn not_kept(error: &CacheError, id: &Id<'_>, kept: f64, sources: CachePolicy) -> String {
    let stage = id.stage;
    let lost = format!("{error}: the {stage} are finished in memory and not kept");
    match sources {
        CachePolicy::Cached if kept > 0.0 => format!(
            "{lost}, but for {:.0} % of them, where the next run goes on",
            100.0 * kept
        ),
        _ => lost,
    }
}
