//! Stage 3: the radiosities that each light makes, and their sum.

use super::factors::Factors;
use crate::artifact::{CachePolicy, Origin, Recipe, get_or_compute, usable};
use crate::energy::Energy;
use crate::error::Error;
use crate::metadata::{self, SOLUTION, SolutionFacts};
use crate::observer::Stage;
use crate::row_statistics::RowSummary;
use radiosity_cache::{Id, Key, Miss, Store};
use radiosity_params::Parameters;
use radiosity_solver::{self as solver, Params, Solution, Solver, System};
use std::time::Instant;

/// A solution, where it came from, and what it was made from.
pub struct Solved<'a> {
    /// The artifact: each light undimmed.
    pub solution: Solution,
    /// Its identity: of all that it is made from.
    pub key: Key,
    /// Cached or computed.
    pub origin: Origin,
    /// The rows of the form factors that it was made from.
    pub rows: RowSummary,
    /// Where those came from.
    pub form_factors: Origin,
    pub(super) factors: &'a Factors<'a>,
    /// Of each light.
    pub(super) energies: Vec<Energy>,
    /// See [`PatchLight`](super::light::PatchLight).
    pub(super) elements: Vec<f32>,
    /// See there.
    pub(super) visible: Vec<f32>,
}

/// Solves for the radiosities, or takes them from the cache: then form factors are not even looked
/// at.
pub fn solve<'a>(factors: &'a Factors<'a>, params: &Params) -> Result<Solved<'a>, Error> {
    solve_from(factors, params, CachePolicy::Cached)
}

/// [`solve`], even if the solution is cached.
pub fn solve_anew<'a>(factors: &'a Factors<'a>, params: &Params) -> Result<Solved<'a>, Error> {
    solve_from(factors, params, CachePolicy::Computed)
}

fn solve_from<'a>(
    factors: &'a Factors<'a>,
    params: &Params,
    sources: CachePolicy,
) -> Result<Solved<'a>, Error> {
    params.check()?;
    let context = factors.patches.context;
    let id = factors.solution_id(params);
    let mut start = Instant::now();
    let mut made_from = None;
    let recipe = Recipe {
        read: |store: &Store| factors.stored_solution(store, &id),
        make: |store: Option<&Store>| {
            let made = factors.made()?;
            start = Instant::now();
            let solution = factors.solution(params)?;
            let facts = SolutionFacts {
                report: solution.report.clone(),
                rows: made.rows.clone(),
                lights: factors.light_names(),
                energies: Energy::of_lights(&made.form_factors, &solution, &factors.patches.lights),
                elements: made.form_factors.element_shares(),
                visible: made.form_factors.visible_shares(),
            };
            let values = [solution.lights.concat(), solution.direct.concat()].concat();
            let write = |store: &Store| {
                let written = store.write(&id, &facts, values.as_flattened());
                usable(written, context.observer, &id).is_some()
            };
            let is_cached = store.is_some_and(write);
            made_from = Some(made.origin.clone());
            Ok(((solution, facts), is_cached))
        },
    };
    let ((solution, facts), mut origin) = get_or_compute(context, &id, sources, recipe)?;
    origin.bytes = 24 * (solution.lights.len() * factors.patches.mesh.patches.len()) as u64;
    origin.seconds = start.elapsed().as_secs_f64();
    let form_factors = made_from.unwrap_or_else(|| factors.untouched());
    Ok(Solved {
        solution,
        key: id.key,
        origin,
        rows: facts.rows,
        form_factors,
        factors,
        energies: facts.energies,
        elements: facts.elements,
        visible: facts.visible,
    })
}

impl<'a> Solved<'a> {
    /// The form factors. They are made when they are first asked for.
    pub fn factors(&self) -> &'a Factors<'a> {
        self.factors
    }
}

/// Into how many steps the solver's progress is divided.
const SOLVER_STEPS: u64 = 100;

impl<'a> Factors<'a> {
    /// Whether the cache has a solution of these, which then are not needed.
    pub fn have_solution(&self, params: &Params) -> bool {
        let id = self.solution_id(params);
        let cache = self.patches.context.cache;
        cache.is_some_and(|store| store.read::<SolutionFacts>(&id).is_ok())
    }

    /// Solves without the cache of solutions.
    pub fn solution(&self, params: &Params) -> Result<Solution, Error> {
        let made = self.made()?;
        let made = &made.form_factors;
        let system = System {
            exchange: &made.exchange,
            reflectance: &self.patches.reflectance,
            lights: &self.patches.lights,
        };
        self.observed(&system, params)
            .map_err(|error| self.of_solver(&error))
    }

    fn observed(
        &self,
        system: &System<'_>,
        params: &Params,
    ) -> Result<Solution, solver::SolveError> {
        let observer = self.patches.context.observer;
        let mut solver = Solver::new(system, params)?;
        observer.begin(Stage::Solve, SOLVER_STEPS);
        let mut reached = 0;
        let result = loop {
            match solver.advance() {
                Ok(Some(residual)) => {
                    // Residuals fall by a factor per sweep, so their logarithm goes evenly.
                    let share = (residual.ln() / params.residual.ln()).clamp(0.0, 1.0);
                    let now = (share * SOLVER_STEPS as f64) as u64;
                    observer.advance(now.saturating_sub(reached));
                    reached = reached.max(now);
                }
                Ok(None) => break solver.finish(),
                Err(error) => break Err(error),
            }
        };
        observer.end();
        result
    }

    fn light_names(&self) -> Vec<String> {
        let lights = self.patches.scene.lights.iter();
        lights.map(|light| light.name.clone()).collect()
    }

    fn stored_solution(&self, store: &Store, id: &Id<'_>) -> Result<Stored, Miss> {
        let artifact = store.read::<SolutionFacts>(id)?;
        let (facts, values) = artifact.into_values()?;
        if !facts.are_sound(values.as_ref()) {
            return Err(Miss::Header);
        }
        let (lights, direct) =
            by_light(values.as_ref(), self.patches.lights.len()).ok_or(Miss::Header)?;
        values.check()?;
        let patches = self.patches.mesh.patches.len();
        if lights.iter().any(|light| light.len() != patches) || facts.visible.len() != patches {
            return Err(Miss::Header);
        }
        let solution = Solution {
            lights,
            direct,
            report: facts.report.clone(),
        };
        Ok((solution, facts))
    }

    fn solution_id(&self, params: &Params) -> Id<'a> {
        let inputs = (
            metadata::SOLUTION_VERSION,
            self.key.bytes(),
            &self.patches.lights,
            &self.patches.reflectance,
            params.used(),
        );
        self.patches
            .id(SOLUTION, Key::of(SOLUTION, solver::VERSION, &inputs))
    }
}

/// A solution, and what is stored beside it.
type Stored = (Solution, SolutionFacts);
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
