//! The radiosity engine: from a scene file to pictures.
//!
//! | stage | function | of the crate | turns | into |
//! |---|---|---|---|---|
//! | | [`Project::open`] | [`scene::parse`] | a file | [`scene::Scene`] and [`Params`] |
//! | 1 | [`subdivide`] | [`geometry::subdivide`] | surfaces | [`geometry::Mesh`] |
//! | 2 | [`estimate`] | [`form_factors::estimate`] | the mesh | [`form_factors::FormFactors`] |
//! | 3 | [`solve`] | [`solver::solve`] | form factors and materials | [`solver::Solution`] |
//! | 4 | [`render`] | [`renderer::Renderer::render`] | mesh, radiosities, camera | [`image::Image`] |
//!
//! Those of this crate ([`stages`]) add to those of the stages' own crates what a scene and a
//! machine need: names in errors, a cache, progress, and a look at the memory before it is taken.
//! Each stage has one struct of parameters, in its own crate.

pub mod advice;
mod artifact;
mod closure_file;
mod context;
pub mod covers;
pub mod darkness;
mod energy;
mod error;
mod estimate_to_file;
mod export;
mod face_rays;
mod factor_export;
mod forecast;
pub mod inspect;
mod light_export;
mod machine;
pub mod metadata;
mod observer;
pub mod openings;
mod project;
mod remedy;
pub mod resources;
mod row_batches;
mod row_columns;
mod row_report;
mod row_statistics;
pub mod stages;
pub mod words;

pub use artifact::{Origin, Provenance};
pub use context::Context;
pub use energy::Energy;
pub use error::Error;
pub use export::{cells, of_cells, patch_at, radiosity_table, reference_table};
pub use factor_export::{By, FactorTable, matrix_bytes};
pub use light_export::{LightExport, light_export_bytes};
pub use observer::{Observer, Silent, Stage};
pub use project::{Params, Project};
pub use remedy::Remedy;
pub use row_report::RowReport;
pub use row_statistics::{RowSummary, Unbalanced};
pub use stages::{estimate, expose, render, save_png, solve, solve_anew, subdivide};

pub use radiosity_cache as cache;
pub use radiosity_compare as compare;
pub use radiosity_form_factors as form_factors;
pub use radiosity_geometry as geometry;
pub use radiosity_image as image;
pub use radiosity_matrix as matrix;
pub use radiosity_params as params;
pub use radiosity_reference as reference;
pub use radiosity_renderer as renderer;
pub use radiosity_scene as scene;
pub use radiosity_solver as solver;

/// The programs that documents show are compiled.
#[cfg(doctest)]
mod documents {
    #[doc = include_str!("../../../README.md")]
    struct Readme;
}
