//! The chain of stages: each takes the result of the one before, and its parameters.
//!
//! ```no_run
//! use radiosity::renderer::Shading;
//! use radiosity::{Context, Project, estimate, expose, render, save_png, solve, subdivide};
//!
//! let Project { scene, params, .. } = Project::open("scenes/cornell.toml".as_ref())?;
//! let patches = subdivide(&scene, &params.discretization, Context::default())?;
//! let factors = estimate(&patches, &params.form_factors)?;
//! let solved = solve(&factors, &params.solver)?;
//! let light = solved.light()?;
//! let camera = scene.first_camera().expect("the scene has a camera");
//! let shadings = [Shading::Smooth];
//! let image = expose(&patches, &light, &[camera], &params.image, &shadings);
//! let pictures = render(&patches, &light, &camera, &image, &shadings)?;
//! save_png("cornell.png".as_ref(), &pictures[0], &image)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Form factors and solutions are taken from the cache of the [`Context`](crate::Context), if it has
//! one, each under the digest of what its stage reads. Form factors are made when they are first
//! needed: a cached solution needs none.

mod dimming;
mod exposure;
mod factors;
mod irradiance;
mod light;
mod patches;
mod pictures;
mod solution;

pub use dimming::Dimming;
pub use exposure::expose;
pub use factors::{Factors, FormFactorsMade, estimate};
pub use irradiance::mean_irradiance;
pub use light::PatchLight;
pub use patches::{Patches, subdivide};
pub use pictures::{DisplayField, Quantity, render, render_by, save_png, show};
pub use solution::{Solved, solve, solve_anew};

#[cfg(test)]
mod tests;
