//! Stage 3 of the chain: the radiosities that each light makes, and their sum.

use super::visible::visible_shares;
use super::{PatchLight, Pipeline};
use crate::artifact::{Origin, Recipe, Sources, obtain, usable};
use crate::error::Error;
use crate::facts::{self, SOLUTION, SolutionFacts};
use crate::observer::Stage;
use crate::rows::RowSummary;
use crate::settings;
use radiosity_cache::{Id, Key, Miss, Store};
use radiosity_form_factors::{FormFactors, RowFacts};
use radiosity_solver::{self as solver, Energy, Method, Solution, System};
use std::time::Instant;

/// A solution, where it came from, and what it was made from.
pub struct Solved {
    /// The artifact: each light undimmed.
    pub solution: Solution,
    /// What patches shine with.
    pub light: PatchLight,
    /// The power balance with those lights.
    pub energy: Energy,
    /// Cached or computed.
    pub origin: Origin,
    /// The rows of the form factors that it was made from.
    pub rows: RowSummary,
    /// Where those came from.
    pub form_factors: Origin,
}

/// Into how many steps the solver's progress is divided.
const SOLVER_STEPS: u64 = 100;

impl Pipeline<'_> {
    /// Stage 3: the solution. `sources` is about the solution alone; form factors are taken
    /// from the cache where possible, and not even looked at where the solution is cached.
    pub fn solution(&self, sources: Sources) -> Result<Solved, Error> {
        self.solution_after(sources, &mut |_, _| ())
    }

    /// [`Pipeline::solution`], telling of the form factors as soon as they are there and before
    /// anything is solved.
    pub fn solution_after(
        &self,
        sources: Sources,
        on_form_factors: &mut dyn FnMut(&Origin, &RowSummary),
    ) -> Result<Solved, Error> {
        let id = self.solution_id();
        let mut made_from = None;
        let mut start = Instant::now();
        let recipe = Recipe {
            read: |store: &Store| self.stored_solution(store, &id),
            make: |store: Option<&Store>| {
                let made = self.form_factors(Sources::Cached)?;
                on_form_factors(&made.origin, &made.rows);
                start = Instant::now();
                let solution = self.solve(&made.form_factors)?;
                made_from = Some(made.origin);
                let facts = SolutionFacts {
                    report: solution.report.clone(),
                    rows: made.rows,
                    lights: self.light_names(),
                    visible: visible_shares(&made.form_factors.rows),
                };
                let values = [solution.lights.concat(), solution.direct.concat()].concat();
                let write = |store: &Store| {
                    let written = store.write(&id, &facts, values.as_flattened());
                    usable(written, self.observer, &id).is_some()
                };
                let is_cached = store.is_some_and(write);
                Ok(((solution, facts.rows, facts.visible), is_cached))
            },
        };
        let ((solution, rows, visible), mut origin) =
            obtain(self.cache, self.observer, &id, sources, recipe)?;
        origin.bytes = 24 * (solution.lights.len() * self.mesh.patches.len()) as u64;
        origin.seconds = start.elapsed().as_secs_f64();
        let form_factors = made_from.unwrap_or_else(|| {
            let untouched = self.untouched_form_factors();
            on_form_factors(&untouched, &rows);
            untouched
        });
        Ok(Solved {
            light: self.finite(self.light_of(&solution, visible))?,
            energy: solution.energy(&settings::dimming(self.scene)),
            solution,
            origin,
            rows,
            form_factors,
        })
    }

    /// The radiosities of the lights, as bright as the scene has them.
    pub(super) fn dimmed(&self, lights: &[Vec<[f32; 3]>]) -> Vec<[f32; 3]> {
        let mut sum = solver::relit(lights, &settings::dimming(self.scene));
        // It is dark where there are no lights.
        sum.resize(self.mesh.patches.len(), [0.0; 3]);
        sum
    }

    fn light_names(&self) -> Vec<String> {
        let lights = self.scene.lights.iter();
        lights.map(|light| light.name.clone()).collect()
    }

    fn stored_solution(&self, store: &Store, id: &Id<'_>) -> Result<Stored, Miss> {
        let artifact = store.read::<SolutionFacts>(id)?;
        let (facts, values) = artifact.into_values()?;
        if !facts.are_sound(values.as_ref()) {
            return Err(Miss::Header);
        }
        let (lights, direct) = by_light(values.as_ref(), self.lights.len()).ok_or(Miss::Header)?;
        values.check()?;
        let patches = self.mesh.patches.len();
        if lights.iter().any(|light| light.len() != patches) || facts.visible.len() != patches {
            return Err(Miss::Header);
        }
        let solution = Solution {
            lights,
            direct,
            report: facts.report,
        };
        Ok((solution, facts.rows, facts.visible))
    }

    /// The identity of the solution: of all that it is made from.
    pub fn solution_key(&self) -> Key {
        self.solution_id().key
    }

    fn solution_id(&self) -> Id<'_> {
        let inputs = (
            facts::SOLUTION_VERSION,
            self.key.bytes(),
            &self.lights,
            &self.reflectance,
            settings::solver_params(self.scene),
        );
        self.id(SOLUTION, Key::of(SOLUTION, solver::VERSION, &inputs))
    }

    /// Stage 3 alone, with these form factors and without the cache.
    pub fn solve(&self, form_factors: &FormFactors) -> Result<Solution, Error> {
        let params = settings::solver_params(self.scene);
        self.solve_by(params.method, form_factors)
    }

    /// [`Pipeline::solve`] by a method of the caller's.
    pub fn solve_by(&self, method: Method, form_factors: &FormFactors) -> Result<Solution, Error> {
        let share = |share: fn(&RowFacts) -> f64| -> Vec<f64> {
            form_factors.rows.iter().map(share).collect()
        };
        let system = System {
            exchange: &form_factors.exchange,
            areas: &form_factors.areas,
            visible: &self.elements(&form_factors.rows),
            reflectance: &self.reflectance,
            lights: &self.lights,
            backs: &share(|row| row.backs),
            background: &share(|row| row.background),
        };
        let params = solver::Params {
            method,
            ..settings::solver_params(self.scene)
        };
        self.observer.begin(Stage::Solve, SOLVER_STEPS);
        let mut reached = 0;
        let solution = solver::solve(&system, &params, &mut |residual| {
            // Residuals fall by a factor per sweep, so their logarithm goes evenly.
            let share = (residual.ln() / params.tolerance.ln()).clamp(0.0, 1.0);
            let now = (share * SOLVER_STEPS as f64) as u64;
            self.observer.advance(now.saturating_sub(reached));
            reached = reached.max(now);
        });
        self.observer.end();
        solution.map_err(|error| self.of_solver(&error))
    }
}

/// A solution, the rows behind it, and the visible share of each patch.
type Stored = (Solution, RowSummary, Vec<f32>);
/// Of each light, a value of each patch.
type ByLight = Vec<Vec<[f32; 3]>>;

/// The radiosities of so many lights one after the other, and then their direct parts, if they are
/// as many.
fn by_light(values: &[f32], lights: usize) -> Option<(ByLight, ByLight)> {
    let (triples, rest) = values.as_chunks::<3>();
    let parts = (2 * lights).max(1);
    let fits = rest.is_empty() && triples.len().is_multiple_of(parts);
    let patches = (triples.len() / parts).max(1);
    let mut found: ByLight = triples.chunks(patches).map(<[_]>::to_vec).collect();
    if !fits || found.len() != 2 * lights {
        return None;
    }
    let direct = found.split_off(lights);
    Some((found, direct))
}
