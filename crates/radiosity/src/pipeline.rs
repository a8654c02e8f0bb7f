//! The chain of stages, with the cache between them.

use crate::artifact::{Origin, Recipe, Sources, obtain, usable};
use crate::error::Error;
use crate::facts::{self, CLOSURE, FORM_FACTORS, SOLUTION, SolutionFacts};
use crate::observer::{Observer, Stage};
use crate::resources::check_image;
use crate::rows::RowSummary;
use crate::settings;
use radiosity_cache::{Artifact, Id, Key, Miss, Store};
use radiosity_form_factors::{self as form_factors, FormFactors};
use radiosity_geometry::{self as geometry, Mesh};
use radiosity_renderer::{self as renderer, Fields, Pictures};
use radiosity_scene::{Mode, Scene};
use radiosity_solver::{self as solver, Solution, System};
use std::time::Instant;

mod factors;

/// One scene on its way through the stages.
pub struct Pipeline<'a> {
    scene: &'a Scene,
    cache: Option<&'a Store>,
    observer: &'a dyn Observer,
    mesh: Mesh,
    /// Per patch.
    emission: Vec<[f64; 3]>,
    reflectance: Vec<[f64; 3]>,
    /// The identity of the form factors as they are estimated.
    estimate: Key,
    /// And of those that are used.
    key: Key,
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

/// A solution, where it came from, and what it was made from.
pub struct Solved {
    /// The artifact.
    pub solution: Solution,
    /// Cached or computed.
    pub origin: Origin,
    /// The rows of the form factors that it was made from.
    pub rows: RowSummary,
    /// Where those came from.
    pub form_factors: Origin,
}

/// Into how many steps the solver's progress is divided.
const SOLVER_STEPS: u64 = 100;
impl<'a> Pipeline<'a> {
    /// Stage 1: cuts the scene into patches.
    pub fn new(
        scene: &'a Scene,
        cache: Option<&'a Store>,
        observer: &'a dyn Observer,
    ) -> Result<Pipeline<'a>, Error> {
        let of_mesh = |error| Error::of_mesh(scene, &error);
        let mesh = geometry::subdivide(&scene.geometry, scene.divisions).map_err(of_mesh)?;
        let patches = mesh.patches.len();
        let material = |patch: usize| {
            let face = mesh.face_of(patch);
            scene.material(face.surface, face.input_index)
        };
        let inputs = (facts::VERSION, &mesh, settings::estimator(scene));
        let estimate = Key::of(FORM_FACTORS, form_factors::VERSION, &inputs);
        Ok(Pipeline {
            key: if scene.form_factors.closure {
                Key::of(CLOSURE, form_factors::VERSION, &estimate.bytes())
            } else {
                estimate
            },
            estimate,
            scene,
            cache,
            observer,
            emission: (0..patches).map(|patch| material(patch).emission).collect(),
            reflectance: (0..patches)
                .map(|patch| material(patch).reflectance)
                .collect(),
            mesh,
        })
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        self.scene
    }

    /// The patches.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

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
            read: |store: &Store| {
                let artifact: Artifact<SolutionFacts> = store.read(&id)?;
                let (facts, values) = artifact.into_values()?;
                let (triples, rest) = values.as_ref().as_chunks::<3>();
                let fits = triples.len() == self.mesh.patches.len() && rest.is_empty();
                fits.then(|| (triples.to_vec(), facts)).ok_or(Miss::Header)
            },
            make: |store: Option<&Store>| {
                let made = self.form_factors(Sources::Cached)?;
                on_form_factors(&made.origin, &made.rows);
                start = Instant::now();
                let Solution { radiosity, report } = self.solve(&made.form_factors)?;
                made_from = Some(made.origin);
                let facts: SolutionFacts = (report, made.rows);
                let write = |store: &Store| {
                    let written = store.write(&id, &facts, radiosity.as_flattened());
                    usable(written, self.observer, &id).is_some()
                };
                let is_cached = store.is_some_and(write);
                Ok(((radiosity, facts), is_cached))
            },
        };
        let ((radiosity, (report, rows)), mut origin) =
            obtain(self.cache, self.observer, &id, sources, recipe)?;
        origin.bytes = 12 * radiosity.len() as u64;
        origin.seconds = start.elapsed().as_secs_f64();
        let form_factors = made_from.unwrap_or_else(|| {
            let untouched = self.untouched_form_factors();
            on_form_factors(&untouched, &rows);
            untouched
        });
        Ok(Solved {
            solution: Solution { radiosity, report },
            origin,
            rows,
            form_factors,
        })
    }

    /// Stage 4: both pictures.
    pub fn pictures(&self, solution: &Solution) -> Result<Pictures, Error> {
        let camera = self.scene.camera.as_ref().ok_or(Error::NoCamera)?;
        let params = settings::image_params(self.scene);
        check_image(params.width, params.height)?;
        let to_f32 = |rgb: &[f64; 3]| rgb.map(|channel| channel as f32);
        let emission: Vec<[f32; 3]> = self.emission.iter().map(to_f32).collect();
        let reflectance: Vec<[f32; 3]> = self.reflectance.iter().map(to_f32).collect();
        let fields = Fields {
            emission: &emission,
            reflectance: &reflectance,
            radiosity: &solution.radiosity,
        };
        self.observer
            .begin(Stage::Display, u64::from(params.height));
        let advance = |rows| self.observer.advance(rows);
        let pictures = renderer::render(&self.mesh, &fields, camera, &params, &advance);
        self.observer.end();
        Ok(pictures)
    }

    /// The name of the surface that a patch belongs to.
    pub fn surface_name(&self, patch: usize) -> &str {
        &self.scene.surfaces[self.mesh.patches[patch].surface.index()].name
    }

    /// Why row sums of the scene's estimator may exceed 1.
    pub(crate) fn known_weakness(&self) -> &'static str {
        match self.scene.form_factors.mode {
            Mode::Regular => "the regular rule overestimates patches that touch",
            Mode::MonteCarlo => "the variance is unbounded where patches touch; more --pairs help",
            Mode::Accurate => "a smaller --tolerance helps",
        }
    }

    fn id(&self, stage: &'static str, key: Key) -> Id<'_> {
        let scene = &self.scene.name;
        Id { scene, stage, key }
    }

    fn solution_id(&self) -> Id<'_> {
        let inputs = (
            facts::VERSION,
            self.key.bytes(),
            &self.emission,
            &self.reflectance,
            settings::solver_params(self.scene),
        );
        self.id(SOLUTION, Key::of(SOLUTION, solver::VERSION, &inputs))
    }

    fn solve(&self, form_factors: &FormFactors) -> Result<Solution, Error> {
        let system = System {
            exchange: &form_factors.exchange,
            areas: &form_factors.areas,
            emission: &self.emission,
            reflectance: &self.reflectance,
        };
        let params = settings::solver_params(self.scene);
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
        let name_of = |patch| self.surface_name(patch).to_owned();
        solution.map_err(|error| Error::of_solver(&error, name_of))
    }
}
