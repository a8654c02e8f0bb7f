//! The chain of stages, with the cache between them.

use crate::error::Error;
use crate::observer::{Observer, Stage};
use crate::resources::{Needs, bytes, duration, grouped};
use radiosity_cache::{Artifact, Id, Key, Miss, Store};
use radiosity_form_factors::{self as form_factors, Estimator, FormFactors, RowFacts};
use radiosity_geometry::{self as geometry, Mesh};
use radiosity_matrix::SymmetricMatrix;
use radiosity_renderer::{self as renderer, Fields, ImageParams, Pictures};
use radiosity_scene::{Mode, Scene};
use radiosity_solver::{self as solver, Convergence, Solution, System};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::time::Instant;

/// One scene on its way through the stages.
pub struct Pipeline<'a> {
    scene: &'a Scene,
    cache: Option<&'a Store>,
    observer: &'a dyn Observer,
    mesh: Mesh,
    /// Per patch.
    emission: Vec<[f64; 3]>,
    reflectance: Vec<[f64; 3]>,
}

/// Whether a stage may take its result from the cache.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sources {
    /// Take what is cached, compute what is not.
    Cached,
    /// Compute anew, and cache that.
    Computed,
}

/// Where an artifact came from.
#[derive(Clone, Debug)]
pub struct Origin {
    /// Why it was computed; `None` if it was cached.
    pub computed_because: Option<String>,
    /// Its file, if it is cached now.
    pub file: Option<PathBuf>,
    /// The size of its data.
    pub bytes: u64,
    /// What the stage took.
    pub seconds: f64,
}

/// Statistics of the row sums.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RowSummary {
    /// The mean row sum, patches weighted equally.
    pub mean: f64,
    /// The largest distance of a row sum from 1. In open scenes that is no error: what is
    /// missing left the scene.
    pub max_error: f64,
    /// How many rows sum to more than 1, beyond the rounding of storage.
    pub over_one: u64,
    /// The largest row sum, and its patch.
    pub largest: (f64, u64),
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

/// What is stored beside the radiosities.
type SolutionFacts = (Convergence, RowSummary);

const FORM_FACTORS: &str = "form-factors";
const SOLUTION: &str = "solution";
/// Row sums above this exceed 1 by more than the `f32` of their terms explains.
const ONE_IN_STORAGE: f64 = 1.0 + 1e-6;
/// Below this many pairs of points a prediction costs more than it is worth.
const PREDICTED_FROM: u64 = 20_000_000;
/// Rows to try for a prediction.
const REHEARSED_ROWS: usize = 16;

impl<'a> Pipeline<'a> {
    /// Stage 1: cuts the scene into patches, after checking that the machine can hold what
    /// follows.
    pub fn new(
        scene: &'a Scene,
        cache: Option<&'a Store>,
        observer: &'a dyn Observer,
    ) -> Result<Pipeline<'a>, Error> {
        let of_mesh = |error| Error::of_mesh(scene, &error);
        let patches = geometry::count_patches(&scene.geometry, scene.divisions).map_err(of_mesh)?;
        Needs::of(patches).check(cache)?;
        let mesh = geometry::subdivide(&scene.geometry, scene.divisions).map_err(of_mesh)?;
        let material = |patch: usize| {
            let face = mesh.face_of(patch);
            scene.material(face.surface, face.input_index)
        };
        Ok(Pipeline {
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

    /// The patches.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Stage 2: the form factors.
    pub fn form_factors(&self, sources: Sources) -> Result<FormFactorsMade, Error> {
        let start = Instant::now();
        let id = self.form_factors_id();
        let cached = |store: &Store| {
            let (rows, values) = store.read::<Vec<RowFacts>>(&id)?.into_values()?;
            self.stored_form_factors(rows, values).ok_or(Miss::Header)
        };
        let compute = || Ok(self.estimate());
        let write = |store: &Store, made: &FormFactors| {
            store.write(&id, &made.rows, made.exchange.values())
        };
        let (form_factors, mut origin) = self.stage(&id, sources, cached, compute, write)?;
        origin.bytes = 4 * form_factors.exchange.values().len() as u64;
        origin.seconds = start.elapsed().as_secs_f64();
        let rows = RowSummary::of(&form_factors.rows);
        Ok(FormFactorsMade {
            form_factors,
            rows,
            origin,
        })
    }

    /// Stage 3: the solution. `sources` is about the solution alone; form factors are taken
    /// from the cache where possible, and not even looked at where the solution is cached.
    pub fn solution(&self, sources: Sources) -> Result<Solved, Error> {
        let id = self.solution_id();
        let mut made_from = None;
        let mut start = Instant::now();
        let cached = |store: &Store| {
            let artifact: Artifact<SolutionFacts> = store.read(&id)?;
            let (facts, values) = artifact.into_values()?;
            let (triples, rest) = values.as_ref().as_chunks::<3>();
            let fits = triples.len() == self.mesh.patches.len() && rest.is_empty();
            fits.then(|| (triples.to_vec(), facts)).ok_or(Miss::Header)
        };
        let compute = || {
            let made = self.form_factors(Sources::Cached)?;
            start = Instant::now();
            let solution = self.solve(&made.form_factors)?;
            let facts = (solution.report, made.rows);
            made_from = Some(made.origin);
            Ok((solution.radiosity, facts))
        };
        let write = |store: &Store, made: &(Vec<[f32; 3]>, SolutionFacts)| {
            store.write(&id, &made.1, made.0.as_flattened())
        };
        let ((radiosity, (report, rows)), mut origin) =
            self.stage(&id, sources, cached, compute, write)?;
        origin.bytes = 12 * radiosity.len() as u64;
        origin.seconds = start.elapsed().as_secs_f64();
        Ok(Solved {
            solution: Solution { radiosity, report },
            origin,
            rows,
            form_factors: made_from.unwrap_or_else(|| self.untouched_form_factors()),
        })
    }

    /// Stage 4: both pictures.
    pub fn pictures(&self, solution: &Solution) -> Result<Pictures, Error> {
        let camera = self.scene.camera.as_ref().ok_or(Error::NoCamera)?;
        let image = &self.scene.image;
        let params = ImageParams {
            width: image.width,
            height: image.height,
            subpixels: image.subpixels,
            samples: image.samples,
            seed: image.seed,
            ..ImageParams::default()
        };
        let to_f32 = |rgb: &[f64; 3]| rgb.map(|channel| channel as f32);
        let emission: Vec<[f32; 3]> = self.emission.iter().map(to_f32).collect();
        let reflectance: Vec<[f32; 3]> = self.reflectance.iter().map(to_f32).collect();
        let fields = Fields {
            emission: &emission,
            reflectance: &reflectance,
            radiosity: &solution.radiosity,
        };
        self.observer.begin(Stage::Display, u64::from(image.height));
        let advance = |rows| self.observer.advance(rows);
        let pictures = renderer::render(&self.mesh, &fields, camera, &params, &advance);
        self.observer.end();
        Ok(pictures)
    }

    /// The name of the surface that a patch belongs to.
    pub fn surface_name(&self, patch: usize) -> &str {
        &self.scene.surfaces[self.mesh.patches[patch].surface.index()].name
    }

    /// Takes an artifact from the cache, or computes and caches it, one process at a time.
    /// A cache that cannot be written costs a note and nothing else.
    fn stage<T>(
        &self,
        id: &Id<'_>,
        sources: Sources,
        cached: impl Fn(&Store) -> Result<T, Miss>,
        compute: impl FnOnce() -> Result<T, Error>,
        write: impl FnOnce(&Store, &T) -> Result<u64, radiosity_cache::CacheError>,
    ) -> Result<(T, Origin), Error> {
        let origin = |computed_because, file| Origin {
            computed_because,
            file,
            bytes: 0,
            seconds: 0.0,
        };
        let Some(store) = self.cache else {
            return Ok((compute()?, origin(Some("caching is off".to_owned()), None)));
        };
        let path = store.path(id);
        let look = || match sources {
            Sources::Cached => cached(store).map_err(|miss| miss.to_string()),
            Sources::Computed => Err("asked for".to_owned()),
        };
        if let Ok(artifact) = look() {
            return Ok((artifact, origin(None, Some(path))));
        }
        let waiting = || {
            let stage = id.stage;
            self.observer.note(&format!(
                "waiting for another process that makes the {stage}"
            ));
        };
        let _lock = match store.lock(id, waiting) {
            Ok(lock) => Some(lock),
            Err(error) => {
                self.observer
                    .note(&format!("{error}; the {} will not be cached", id.stage));
                None
            }
        };
        // Whoever had the lock before may have made it meanwhile.
        let reason = match look() {
            Ok(artifact) => return Ok((artifact, origin(None, Some(path)))),
            Err(reason) => reason,
        };
        let artifact = compute()?;
        let file = match write(store, &artifact) {
            Ok(_) => Some(path),
            Err(error) => {
                self.observer
                    .note(&format!("{error}; the {} are not cached", id.stage));
                None
            }
        };
        Ok((artifact, origin(Some(reason), file)))
    }

    fn form_factors_id(&self) -> Id<'_> {
        Id {
            scene: &self.scene.name,
            stage: FORM_FACTORS,
            key: Key::of(
                FORM_FACTORS,
                form_factors::VERSION,
                &(&self.mesh, self.estimator()),
            ),
        }
    }

    fn solution_id(&self) -> Id<'_> {
        let form_factors = self.form_factors_id().key.bytes();
        let inputs = (
            form_factors,
            &self.emission,
            &self.reflectance,
            self.solver_params(),
        );
        Id {
            scene: &self.scene.name,
            stage: SOLUTION,
            key: Key::of(SOLUTION, solver::VERSION, &inputs),
        }
    }

    fn estimator(&self) -> Estimator {
        let settings = &self.scene.form_factors;
        let points = settings.points;
        match settings.mode {
            Mode::Regular => Estimator::Regular { points },
            Mode::MonteCarlo => Estimator::MonteCarlo {
                points,
                pairs: settings.pairs.unwrap_or(points * points),
                seed: settings.seed,
            },
        }
    }

    fn solver_params(&self) -> solver::Params {
        solver::Params {
            tolerance: self.scene.solver.tolerance,
            max_sweeps: self.scene.solver.max_sweeps,
        }
    }

    fn stored_form_factors(
        &self,
        rows: Vec<RowFacts>,
        values: impl AsRef<[f32]> + Send + Sync + 'static,
    ) -> Option<FormFactors> {
        let patches = self.mesh.patches.len();
        let exchange = SymmetricMatrix::new(patches, values).ok()?;
        let areas = self.mesh.patches.iter().map(|patch| patch.area).collect();
        (rows.len() == patches).then_some(FormFactors {
            areas,
            exchange,
            rows,
        })
    }

    fn estimate(&self) -> FormFactors {
        let needs = Needs::of(self.mesh.patches.len());
        self.predict(&needs);
        self.observer.begin(Stage::FormFactors, needs.pairs);
        let advance = |pairs| self.observer.advance(pairs);
        let made = form_factors::estimate(&self.mesh, self.estimator(), &advance);
        self.observer.end();
        made
    }

    /// Says before a long run what it will take.
    fn predict(&self, needs: &Needs) {
        let estimator = self.estimator();
        if needs.pairs * estimator.point_pairs() < PREDICTED_FROM {
            return;
        }
        let start = Instant::now();
        let tried = form_factors::rehearse(&self.mesh, estimator, REHEARSED_ROWS).max(1);
        let seconds = start.elapsed().as_secs_f64() * needs.pairs as f64 / tried as f64;
        self.observer.note(&format!(
            "{} patches, {} pairs: {} of memory, {} of disk, {}",
            grouped(needs.patches as u64),
            grouped(needs.pairs),
            bytes(needs.memory),
            bytes(needs.disk),
            duration(seconds),
        ));
    }

    fn solve(&self, form_factors: &FormFactors) -> Result<Solution, Error> {
        let system = System {
            exchange: &form_factors.exchange,
            areas: &form_factors.areas,
            emission: &self.emission,
            reflectance: &self.reflectance,
        };
        let params = self.solver_params();
        self.observer
            .begin(Stage::Solve, u64::from(params.max_sweeps));
        let solution = solver::solve(&system, &params, &mut |_| self.observer.advance(1));
        self.observer.end();
        let name_of = |patch| self.surface_name(patch).to_owned();
        solution.map_err(|error| Error::of_solver(&error, name_of))
    }

    /// What to say of form factors that were not needed.
    fn untouched_form_factors(&self) -> Origin {
        let path = self.cache.map(|store| store.path(&self.form_factors_id()));
        Origin {
            computed_because: None,
            file: path.filter(|path| path.exists()),
            bytes: 4 * Needs::of(self.mesh.patches.len()).pairs,
            seconds: 0.0,
        }
    }
}

impl RowSummary {
    fn of(rows: &[RowFacts]) -> RowSummary {
        let sums = || rows.iter().map(|row| row.fronts);
        let largest = sums().enumerate().fold((0.0, 0), |best, (patch, sum)| {
            if sum > best.0 {
                (sum, patch as u64)
            } else {
                best
            }
        });
        RowSummary {
            mean: sums().sum::<f64>() / rows.len() as f64,
            max_error: sums().map(|sum| (sum - 1.0).abs()).fold(0.0, f64::max),
            over_one: sums().filter(|&sum| sum > ONE_IN_STORAGE).count() as u64,
            largest,
        }
    }
}
