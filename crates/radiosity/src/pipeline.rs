//! The chain of stages, with the cache between them.

use crate::artifact::Origin;
use crate::error::Error;
use crate::facts::{self, CLOSURE, FORM_FACTORS};
use crate::observer::Observer;
use crate::remedy::Remedy;
use crate::row_columns::is_finite;
use crate::rows::RowSummary;
use crate::settings;
use radiosity_cache::{Id, Key, Store};
use radiosity_form_factors::{self as form_factors, FormFactors};
use radiosity_geometry::{self as geometry, Mesh};
use radiosity_scene::{Material, Mode, Scene};
use radiosity_solver::{self as solver, SolveError};
use std::sync::OnceLock;

pub mod covers;
mod factors;
mod pictures;
mod solution;
mod visible;

pub use pictures::{Quantity, Shown};
pub use solution::Solved;

/// One scene on its way through the stages.
pub struct Pipeline<'a> {
    scene: &'a Scene,
    cache: Option<&'a Store>,
    observer: &'a dyn Observer,
    mesh: Mesh,
    /// Of each light of the scene, undimmed, per patch.
    lights: Vec<Vec<[f64; 3]>>,
    /// Per patch.
    reflectance: Vec<[f64; 3]>,
    /// The identity of the form factors as they are estimated.
    estimate: Key,
    /// And of those that are used.
    key: Key,
    /// Form factors that are used again, if they are to be kept.
    kept: Option<OnceLock<FormFactors>>,
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

/// What patches shine with, each list indexed by patch.
#[derive(Clone, Debug)]
pub struct PatchLight {
    /// Radiosities of what is visible of patches, W/m^2 per channel, with the lights as bright as
    /// the scene has them.
    pub radiosity: Vec<[f32; 3]>,
    /// The part of them that patches reflect of what comes straight from emitters.
    pub direct: Vec<[f32; 3]>,
    /// The share of each patch that can be seen, and so exchanges light. 0 stands for too little to
    /// tell it apart: the radiosity is then the mean over all of the patch.
    pub visible: Vec<f32>,
}

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
        let of_light = |light: usize| {
            let emission = |patch: usize| {
                let material = material(patch);
                let shines = material.light == Some(light);
                if shines { material.emission } else { [0.0; 3] }
            };
            (0..patches).map(emission).collect()
        };
        check_lights(scene)?;
        for note in covers::notes(scene, &mesh) {
            observer.note(&note);
        }
        let inputs = (facts::FACTORS_VERSION, &mesh, settings::estimator(scene));
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
            lights: (0..scene.lights.len()).map(of_light).collect(),
            kept: None,
            reflectance: (0..patches)
                .map(|patch| material(patch).reflectance)
                .collect(),
            mesh,
        })
    }

    /// Has form factors kept in memory once they are made, for whoever asks for them again.
    pub fn keep_form_factors(&mut self) {
        self.kept = Some(OnceLock::new());
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        self.scene
    }

    /// The cache, if there is one.
    pub fn cache(&self) -> Option<&'a Store> {
        self.cache
    }

    /// Who is told what happens.
    pub fn observer(&self) -> &dyn Observer {
        self.observer
    }

    /// The patches.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The name of the surface that a patch belongs to.
    pub fn surface_name(&self, patch: usize) -> &str {
        &self.scene.surfaces[self.mesh.patches[patch].surface.index()].name
    }

    /// Why row sums of the scene's estimator may exceed 1, unless it tells its errors.
    pub fn known_weakness(&self) -> Option<&'static str> {
        match self.scene.form_factors.mode {
            Mode::Regular => Some("the regular rule overestimates patches that touch"),
            Mode::MonteCarlo => {
                Some("the variance is unbounded where patches touch; more pairs of points help")
            }
            Mode::Accurate => None,
        }
    }

    /// Refuses light that single precision does not hold, such as that of a lamp brightened beyond
    /// it.
    fn finite(&self, light: PatchLight) -> Result<PatchLight, Error> {
        solver::check_radiosities([&light.radiosity[..]])
            .map_err(|error| self.of_solver(&error))?;
        Ok(light)
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
                    self.surface_name(patch)
                ),
                remedy: Remedy::words("use numbers of ordinary size in the scene"),
            })
        })
    }

    /// Names the surfaces that an error of the solver is about.
    fn of_solver(&self, error: &SolveError) -> Error {
        let mode = self.scene.form_factors.mode;
        Error::of_solver(error, mode, |patch| self.surface_name(patch).to_owned())
    }

    /// What each patch emits itself, with the lights as bright as the scene has them.
    fn dimmed_emission(&self) -> Vec<[f32; 3]> {
        let dimming = settings::dimming(self.scene);
        let mut sum = vec![[0.0; 3]; self.mesh.patches.len()];
        for (light, factor) in self.lights.iter().zip(dimming) {
            for (sum, emission) in sum.iter_mut().zip(light) {
                (0..3).for_each(|c| sum[c] += (factor[c] * emission[c]) as f32);
            }
        }
        sum
    }

    fn id(&self, stage: &'static str, key: Key) -> Id<'_> {
        let scene = &self.scene.name;
        Id { scene, stage, key }
    }
}

/// Scenes that were read have a light for whatever emits; others must have one too.
fn check_lights(scene: &Scene) -> Result<(), Error> {
    let is_lost = |material: &&Material| {
        let has_light = material
            .light
            .is_some_and(|light| light < scene.lights.len());
        material.emission != [0.0; 3] && !has_light
    };
    let on_surfaces = scene.surfaces.iter().flat_map(|surface| &surface.materials);
    let mut materials = on_surfaces.map(|&material| &scene.materials[material]);
    match materials.find(is_lost) {
        Some(lost) => Err(Error::NoLight {
            material: lost.name.clone(),
        }),
        None => Ok(()),
    }
}
