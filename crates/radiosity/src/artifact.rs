//! How a stage comes by its artifact: from the cache, or by computing it.

use crate::context::Context;
use crate::error::Error;
use crate::observer::Observer;
use radiosity_cache::{CacheError, Id, Miss, Store};
use std::path::PathBuf;

/// Whether a stage may take its result from the cache.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CachePolicy {
    /// Take what is cached, compute what is not.
    Cached,
    /// Compute anew, and cache that.
    Computed,
}

/// How an artifact was come by.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Provenance {
    /// Taken from the cache.
    Cached,
    /// Computed, for this reason.
    Computed(String),
    /// What would have been made from it was cached, and it was not.
    NotNeeded,
}

/// Where an artifact came from.
#[derive(Clone, Debug)]
pub struct Origin {
    /// Cached or computed.
    pub how: Provenance,
    /// Its file, if it is cached now.
    pub file: Option<PathBuf>,
    /// The size of its data.
    pub bytes: u64,
    /// What the stage took.
    pub seconds: f64,
}

/// How one artifact is read and made.
pub(crate) struct Recipe<R, M> {
    /// Takes it from the cache.
    pub(crate) read: R,
    /// Makes it anew, and puts it into the cache if there is one that can be used; says whether it
    /// is there.
    pub(crate) make: M,
}

/// Takes an artifact from the cache, or computes and caches it, one process at a time. A cache that
/// cannot be used, or not any more, costs a note and nothing else.
pub(crate) fn get_or_compute<T>(
    context: Context<'_>,
    id: &Id<'_>,
    sources: CachePolicy,
    recipe: Recipe<
        impl Fn(&Store) -> Result<T, Miss>,
        impl FnOnce(Option<&Store>) -> Result<(T, bool), Error>,
    >,
) -> Result<(T, Origin), Error> {
    let observer = context.observer;
    let Some(store) = context.cache else {
        let reason = "caching is off".to_owned();
        let (artifact, _) = (recipe.make)(None)?;
        return Ok((artifact, Origin::new(Provenance::Computed(reason), None)));
    };
    let path = store.path(id);
    let look = || match sources {
        CachePolicy::Cached => (recipe.read)(store).map_err(|miss| miss.to_string()),
        CachePolicy::Computed => Err("asked for".to_owned()),
    };
    if let Ok(artifact) = look() {
        store.tidy(id);
        return Ok((artifact, Origin::new(Provenance::Cached, Some(path))));
    }
    let waiting = || {
        let stage = id.stage;
        observer.note(&format!(
            "waiting for another process that makes the {stage}"
        ));
    };
    let lock = usable(store.lock(id, waiting), observer, id);
    // Whoever had the lock before may have made it meanwhile.
    let reason = match look() {
        Ok(artifact) => {
            drop(lock);
            store.tidy(id);
            return Ok((artifact, Origin::new(Provenance::Cached, Some(path))));
        }
        Err(reason) => reason,
    };
    let (artifact, is_cached) = (recipe.make)(lock.as_ref().map(|_| store))?;
    store.check()?;
    let file = is_cached.then_some(path);
    Ok((artifact, Origin::new(Provenance::Computed(reason), file)))
}

/// What was asked of the cache, or a note that it cannot be used.
pub(crate) fn usable<T>(
    result: Result<T, CacheError>,
    observer: &dyn Observer,
    id: &Id<'_>,
) -> Option<T> {
    let not_cached = |error: &CacheError| {
        observer.note(&format!("{error}: no caching of the {}", id.stage));
    };
    result.inspect_err(not_cached).ok()
}

impl Origin {
    /// Whether it was taken from the cache.
    pub fn is_cached(&self) -> bool {
        self.how == Provenance::Cached
    }

    /// Why it was not taken from the cache.
    pub fn reason(&self) -> Option<&str> {
        match &self.how {
            Provenance::Cached => None,
            Provenance::Computed(reason) => Some(reason),
            Provenance::NotNeeded => Some("not needed: the solution is cached"),
        }
    }

    fn new(how: Provenance, file: Option<PathBuf>) -> Origin {
        Origin {
            how,
            file,
            bytes: 0,
            seconds: 0.0,
        }
    }
}
