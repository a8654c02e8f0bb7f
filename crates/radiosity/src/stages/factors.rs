//! Stage 2: form factors, as they are estimated or closed.

use super::patches::Patches;
use crate::artifact::{CachePolicy, Origin, Provenance, Recipe, get_or_compute};
use crate::closure_file::closed;
use crate::covers;
use crate::error::Error;
use crate::estimate_to_file::Job;
use crate::forecast::predicted_seconds;
use crate::metadata::{self, CLOSURE, FORM_FACTORS, FactorFacts};
use crate::remedy::Remedy;
use crate::row_columns::is_finite;
use crate::row_statistics::RowSummary;
use radiosity_cache::{Id, Key, Miss, Store};
use radiosity_form_factors::{self as form_factors, Estimation, FormFactors, Mode, Params};
use radiosity_matrix::{DenseExchange, SymmetricMatrix};
use radiosity_params::Parameters;
use radiosity_solver::SolveError;
use std::ops::DerefMut;
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::time::Instant;

/// The form factors of patches, made or read when they are asked for, and kept as long as somebody
/// holds them: their memory is free while pictures are made that do not need them.
pub struct Factors<'a> {
    pub(super) patches: &'a Patches<'a>,
    pub(super) params: Params,
    /// The identity of the form factors as they are estimated.
    estimate: Key,
    /// And of those that are used.
    pub(super) key: Key,
    made: Mutex<Weak<FormFactorsMade>>,
}

/// Form factors and where they came from.
pub struct FormFactorsMade {
    /// The artifact.
    pub form_factors: FormFactors,
    /// Statistics.
    pub rows: RowSummary,
    /// Cached or computed.
    pub origin: Origin,
}

/// The form factors of patches. They are made when they are asked for ([`Factors::made`]).
pub fn estimate<'a>(patches: &'a Patches<'a>, params: &Params) -> Result<Factors<'a>, Error> {
    params.check()?;
    for note in covers::notes(patches.scene, &patches.mesh, params.mode) {
        patches.context.observer.note(&note);
    }
    let inputs = (metadata::FACTORS_VERSION, &patches.mesh, params.estimator());
    let estimate = Key::of(FORM_FACTORS, form_factors::VERSION, &inputs);
    Ok(Factors {
        key: if params.closure {
            Key::of(CLOSURE, form_factors::VERSION, &estimate.bytes())
        } else {
            estimate
        },
        estimate,
        patches,
        params: *params,
        made: Mutex::default(),
    })
}

impl<'a> Factors<'a> {
    /// The form factors, from the cache where possible.
    ///
    /// Whoever holds them has them made or read only once.
    pub fn made(&self) -> Result<Arc<FormFactorsMade>, Error> {
        self.made_from(CachePolicy::Cached)
    }

    /// The form factors, estimated even if they are cached.
    pub fn made_anew(&self) -> Result<Arc<FormFactorsMade>, Error> {
        *self.held() = Weak::new();
        self.made_from(CachePolicy::Computed)
    }

    fn held(&self) -> impl DerefMut<Target = Weak<FormFactorsMade>> {
        self.made.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The patches.
    pub fn patches(&self) -> &'a Patches<'a> {
        self.patches
    }

    /// Why row sums may exceed 1, unless the estimator tells its errors.
    pub fn known_weakness(&self) -> Option<&'static str> {
        match self.params.mode {
            Mode::Regular => Some("the regular rule overestimates patches that touch"),
            Mode::MonteCarlo => {
                Some("the variance is unbounded where patches touch; more pairs of points help")
            }
            Mode::Accurate => None,
        }
    }

    /// Whether they are cached.
    pub fn are_cached(&self) -> bool {
        let cache = self.patches.context.cache;
        cache.is_some_and(|store| store.read::<FactorFacts>(&self.id()).is_ok())
    }

    /// About how many seconds it takes here to estimate them, from a timed sample; 0 if it takes
    /// less than a sample does.
    pub fn forecast(&self) -> f64 {
        let job = self.job();
        let estimation = Estimation::new(job.mesh, job.estimator);
        predicted_seconds(job.needs().pairs, &estimation, &job).unwrap_or(0.0)
    }

    fn made_from(&self, sources: CachePolicy) -> Result<Arc<FormFactorsMade>, Error> {
        let mut held = self.held();
        if let Some(made) = held.upgrade() {
            return Ok(made);
        }
        let made = if self.params.closure {
            let id = self.id();
            self.obtained(&id, sources, |store| {
                self.job().needs().with_closure(true).check_memory()?;
                let raw = self.estimated(sources)?.form_factors;
                closed(&self.job(), &raw, store, &id)
            })
        } else {
            self.estimated(sources)
        }?;
        let made = Arc::new(made);
        *held = Arc::downgrade(&made);
        Ok(made)
    }

    /// The form factors as they are estimated.
    fn estimated(&self, sources: CachePolicy) -> Result<FormFactorsMade, Error> {
        let id = self.patches.id(FORM_FACTORS, self.estimate);
        self.obtained(&id, sources, |store| match store {
            Some(store) => self.job().run_journaled(store, &id, sources),
            None => Ok((self.job().run()?, false)),
        })
    }

    /// Form factors from the cache, or made anew.
    fn obtained(
        &self,
        id: &Id<'_>,
        sources: CachePolicy,
        make: impl FnOnce(Option<&Store>) -> Result<(FormFactors, bool), Error>,
    ) -> Result<FormFactorsMade, Error> {
        let start = Instant::now();
        let recipe = Recipe {
            read: |store: &Store| {
                let (facts, values) = store.read::<FactorFacts>(id)?.into_values()?;
                self.stored_form_factors(facts, values).ok_or(Miss::Header)
            },
            make,
        };
        let (form_factors, mut origin) = get_or_compute(self.patches.context, id, sources, recipe)?;
        self.check_finite(&form_factors)?;
        origin.bytes = 4 * form_factors.exchange.matrix().values().len() as u64;
        origin.seconds = start.elapsed().as_secs_f64();
        let surface = |patch: usize| self.patches.mesh.patches[patch].surface.index();
        let rows = RowSummary::of(&form_factors, surface);
        Ok(FormFactorsMade {
            form_factors,
            rows,
            origin,
        })
    }

    fn job(&self) -> Job<'_> {
        Job {
            mesh: &self.patches.mesh,
            estimator: self.params.estimator(),
            closure: self.params.closure,
            observer: self.patches.context.observer,
        }
    }

    /// Of the form factors that are used.
    fn id(&self) -> Id<'a> {
        let stage = if self.params.closure {
            CLOSURE
        } else {
            FORM_FACTORS
        };
        self.patches.id(stage, self.key)
    }

    fn stored_form_factors(
        &self,
        facts: FactorFacts,
        values: impl AsRef<[f32]> + Send + Sync + 'static,
    ) -> Option<FormFactors> {
        let patches = self.patches.mesh.patches.len();
        let is_sound = facts.rows.len() == patches && facts.are_sound(values.as_ref().len());
        let matrix = SymmetricMatrix::new(patches, values).ok()?;
        is_sound.then(|| FormFactors {
            exchange: DenseExchange::new(matrix, facts.areas.clone()).of_parts(facts.elements),
            areas: facts.areas,
            rows: facts.rows,
            classes: facts.classes,
            closure: facts.closure,
        })
    }

    /// The origin that is reported if nobody has asked for the form factors.
    pub(super) fn untouched(&self) -> Origin {
        let id = self.id();
        let store = self.patches.context.cache.filter(|_| self.are_cached());
        let file = store.map(|store| store.path(&id));
        if let Some(store) = store {
            store.tidy(&id);
        }
        Origin {
            how: if file.is_some() {
                Provenance::Cached
            } else {
                Provenance::NotNeeded
            },
            file,
            bytes: 4 * radiosity_matrix::packed_len(self.patches.mesh.patches.len()) as u64,
            seconds: 0.0,
        }
    }

    /// Refuses form factors that are no numbers. A file of such rows is not taken from the cache
    /// either.
    fn check_finite(&self, FormFactors { rows, areas, .. }: &FormFactors) -> Result<(), Error> {
        let mut rows = rows.iter().zip(areas);
        let bad = rows.position(|(row, area)| !is_finite(row, *area));
        bad.map_or(Ok(()), |patch| {
            Err(Error::Unsolvable {
                problem: format!(
                    "the form factors of `{}` are no numbers",
                    self.patches.surface_name(patch)
                ),
                remedy: Remedy::words("use numbers of ordinary size in the scene"),
            })
        })
    }

    /// Names the surfaces that an error of the solver is about.
    pub(super) fn of_solver(&self, error: &SolveError) -> Error {
        let name = |patch| self.patches.surface_name(patch).to_owned();
        Error::of_solver(error, self.params.mode, name)
    }
}
