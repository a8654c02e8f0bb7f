//! Form factors whose rows sum to 1: a variant of those that were estimated, and a file of its own.

use crate::artifact::{CachePolicy, usable};
use crate::error::Error;
use crate::estimate_to_file::{Job, not_kept};
use crate::metadata::FactorFacts;
use radiosity_cache::{Batch, Id, Store};
use radiosity_form_factors::{Closure, ClosureFacts, FormFactors};
use radiosity_matrix::{SymmetricMatrix, packed_len};
use std::ops::Range;

/// Values that are scaled at a time.
const VALUES_AT_A_TIME: usize = 1 << 22;

/// Closes form factors, in their file if there is a cache; says whether it is there.
pub(crate) fn closed(
    job: &Job<'_>,
    raw: &FormFactors,
    store: Option<&Store>,
    id: &Id<'_>,
) -> Result<(FormFactors, bool), Error> {
    let closure = Closure::of(raw);
    let facts = |made: &FormFactors| FactorFacts::new(job.mesh, job.estimator, made);
    let mut blank = facts(raw);
    blank.closure = Some(ClosureFacts::default());
    blank.classes = None;
    let begin = |store: &Store| job.begin_draft(store, id, &blank);
    let Some(mut draft) = store.map(begin).transpose()?.flatten() else {
        // The first is in memory already, so there must be room for another.
        job.needs().check_memory()?;
        return Ok((closure.close(raw), false));
    };
    draft.extend(batches(&closure, raw), &|error, _| {
        job.observer
            .note(&not_kept(error, id, 0.0, CachePolicy::Computed));
    })?;
    let matrix = SymmetricMatrix::new(raw.areas.len(), draft.values()?);
    let made = closure.complete(raw, matrix.expect("all rows are made"));
    let is_cached = usable(draft.finish(&facts(&made)), job.observer, id) == Some(true);
    Ok((made, is_cached))
}

/// All rows, scaled, without a second copy in memory.
fn batches(closure: &Closure, raw: &FormFactors) -> impl Iterator<Item = Batch<()>> {
    runs(raw.areas.len()).map(|rows| {
        let range = packed_len(rows.start)..packed_len(rows.end);
        let mut values = raw.exchange.matrix().values()[range].to_vec();
        closure.apply(rows, &mut values);
        Batch {
            values: vec![values],
            state: None,
        }
    })
}

/// All rows, some at a time.
fn runs(size: usize) -> impl Iterator<Item = Range<usize>> {
    let mut first = 0;
    std::iter::from_fn(move || {
        let start = first;
        while first < size && packed_len(first) - packed_len(start) < VALUES_AT_A_TIME {
            first += 1;
        }
        (start < size).then_some(start..first)
    })
}
