//! Stage 2 of the chain: form factors, as they are estimated or closed.

use super::{FormFactorsMade, Pipeline};
use crate::artifact::{How, Origin, Recipe, Sources, obtain};
use crate::closed::closed;
use crate::error::Error;
use crate::facts::{CLOSURE, FORM_FACTORS, FactorFacts};
use crate::job::Job;
use crate::rows::RowSummary;
use crate::settings;
use radiosity_cache::{Id, Miss, Store};
use radiosity_form_factors::FormFactors;
use radiosity_matrix::SymmetricMatrix;
use std::sync::OnceLock;
use std::time::Instant;

impl Pipeline<'_> {
    /// Stage 2: the form factors.
    pub fn form_factors(&self, sources: Sources) -> Result<FormFactorsMade, Error> {
        let made = if self.scene.form_factors.closure {
            let id = self.form_factors_id();
            self.obtained(&id, sources, |store| {
                self.job().needs().with_closure(true).check_memory()?;
                let raw = self.estimated(sources)?.form_factors;
                closed(&self.job(), &raw, store, &id)
            })
        } else {
            self.estimated(sources)
        }?;
        if let Some(kept) = &self.kept {
            // Copies share the numbers; those that were kept before are the same.
            let _ = kept.set(made.form_factors.clone());
        }
        Ok(made)
    }

    /// The form factors that were kept, or else made.
    pub(super) fn known_form_factors(&self) -> Result<FormFactors, Error> {
        match self.kept.as_ref().and_then(OnceLock::get) {
            Some(kept) => Ok(kept.clone()),
            None => Ok(self.form_factors(Sources::Cached)?.form_factors),
        }
    }

    /// The form factors as they are estimated.
    fn estimated(&self, sources: Sources) -> Result<FormFactorsMade, Error> {
        let id = self.id(FORM_FACTORS, self.estimate);
        self.obtained(&id, sources, |store| match store {
            Some(store) => self.job().run_journaled(store, &id, sources),
            None => Ok((self.job().run()?, false)),
        })
    }

    /// Form factors from the cache, or made anew.
    fn obtained(
        &self,
        id: &Id<'_>,
        sources: Sources,
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
        let (form_factors, mut origin) = obtain(self.cache, self.observer, id, sources, recipe)?;
        self.check_finite(&form_factors)?;
        origin.bytes = 4 * form_factors.exchange.values().len() as u64;
        origin.seconds = start.elapsed().as_secs_f64();
        let surface = |patch: usize| self.mesh.patches[patch].surface.index();
        let rows = RowSummary::of(&form_factors, surface);
        Ok(FormFactorsMade {
            form_factors,
            rows,
            origin,
        })
    }

    fn job(&self) -> Job<'_> {
        Job {
            mesh: &self.mesh,
            estimator: settings::estimator(self.scene),
            closure: self.scene.form_factors.closure,
            observer: self.observer,
        }
    }

    /// Of the form factors that are used.
    pub(super) fn form_factors_id(&self) -> Id<'_> {
        let stage = if self.scene.form_factors.closure {
            CLOSURE
        } else {
            FORM_FACTORS
        };
        self.id(stage, self.key)
    }

    fn stored_form_factors(
        &self,
        facts: FactorFacts,
        values: impl AsRef<[f32]> + Send + Sync + 'static,
    ) -> Option<FormFactors> {
        let patches = self.mesh.patches.len();
        let is_sound = facts.rows.len() == patches && facts.are_sound(values.as_ref().len());
        let exchange = SymmetricMatrix::new(patches, values).ok()?;
        is_sound.then_some(FormFactors {
            areas: facts.areas,
            exchange,
            rows: facts.rows,
            classes: facts.classes,
            closure: facts.closure,
        })
    }

    /// What to say of form factors that nobody asked for.
    pub(super) fn untouched_form_factors(&self) -> Origin {
        let id = self.form_factors_id();
        let is_there = |store: &&Store| store.read::<FactorFacts>(&id).is_ok();
        let store = self.cache.filter(is_there);
        let file = store.map(|store| store.path(&id));
        if let Some(store) = store {
            store.tidy(&id);
        }
        Origin {
            how: if file.is_some() {
                How::Cached
            } else {
                How::NotNeeded
            },
            file,
            bytes: 4 * radiosity_matrix::packed_len(self.mesh.patches.len()) as u64,
            seconds: 0.0,
        }
    }
}
