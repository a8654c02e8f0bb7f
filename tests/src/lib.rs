//! What the end-to-end tests share: shipped scenes, reference data, and the two measures of
//! error that `data/README.md` defines.

mod measure;
mod reference;

pub use measure::{picture_errors, radiosity_errors, table_errors};
pub use reference::{radiance, reference_table, regions};

use radiosity::image::Image;
use radiosity::renderer::Shading;
use radiosity::stages::{Factors, FormFactorsMade, PatchLight, Patches, Solved};
use radiosity::{Context, Project, estimate, render, solve, subdivide};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The shadings of the course's pictures.
pub const BOTH: [Shading; 2] = [Shading::Constant, Shading::Smooth];

/// A folder or file of the checkout.
pub fn in_checkout(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

/// A shipped scene, with its parameters.
pub fn shipped(name: &str) -> Project {
    let project = Project::open(&in_checkout(&format!("scenes/{name}.toml")));
    project.unwrap_or_else(|error| panic!("{error}"))
}

/// The stages of a project, without a cache. They are kept until the program ends.
#[derive(Clone, Copy)]
pub struct Chain {
    /// A copy of it.
    pub project: &'static Project,
    /// Stage 1.
    pub patches: &'static Patches<'static>,
    /// Stage 2.
    pub factors: &'static Factors<'static>,
    /// The form factors, which stage 2 keeps only while somebody holds them.
    pub made: &'static FormFactorsMade,
}

impl Chain {
    /// The stages of a project.
    pub fn of(project: &Project) -> Chain {
        let project: &Project = leak(project.clone());
        let params = &project.params;
        let patches = subdivide(&project.scene, &params.discretization, Context::default());
        let patches: &Patches<'_> = leak(patches.unwrap_or_else(|error| panic!("{error}")));
        let factors = estimate(patches, &params.form_factors);
        let factors: &Factors<'_> = leak(factors.unwrap_or_else(|error| panic!("{error}")));
        let made: &Arc<_> = leak(factors.made().unwrap_or_else(|error| panic!("{error}")));
        Chain {
            project,
            patches,
            factors,
            made,
        }
    }

    /// Stage 3.
    pub fn solve(self) -> Solved<'static> {
        let solved = solve(self.factors, &self.project.params.solver);
        solved.unwrap_or_else(|error| panic!("{error}"))
    }

    /// What patches shine with.
    pub fn light(self) -> PatchLight {
        let light = self.solve().light();
        light.unwrap_or_else(|error| panic!("{error}"))
    }

    /// Stage 4, as the scene's first camera sees it.
    pub fn pictures(self, light: &PatchLight, shadings: &[Shading]) -> Vec<Image> {
        let camera = self.project.scene.first_camera().expect("a camera");
        let params = &self.project.params.image;
        let pictures = render(self.patches, light, &camera, params, shadings);
        pictures.unwrap_or_else(|error| panic!("{error}"))
    }
}

fn leak<T>(value: T) -> &'static T {
    Box::leak(Box::new(value))
}
