//! The radiosity engine: from a scene file to pictures.
//!
//! The whole chain is [`Pipeline`]; each stage is one function of one crate:
//!
//! | stage | function | turns | into |
//! |---|---|---|---|
//! | | [`scene::load`] | a file | [`scene::Scene`] |
//! | 1 | [`geometry::subdivide`] | surfaces | [`geometry::Mesh`] |
//! | 2 | [`form_factors::estimate`] | the mesh | [`form_factors::FormFactors`] |
//! | 3 | [`solver::solve`] | form factors and materials | [`solver::Solution`] |
//! | 4 | [`renderer::Renderer::render`] | mesh, radiosities, camera | [`image::Image`] |
//!
//! Form factors and solutions are kept in a [`cache::Store`], each under the digest of what its
//! stage reads, so a changed lamp does not touch form factors and a changed camera touches
//! neither.
//!
//! ```no_run
//! use radiosity::renderer::Shading;
//! use radiosity::{Pipeline, Silent, Sources, scene};
//!
//! let scene = scene::load("scenes/cornell.toml".as_ref())?;
//! let pipeline = Pipeline::new(&scene, None, &Silent)?;
//! let solved = pipeline.solution(Sources::Cached)?;
//! let pictures = pipeline.pictures(&solved.light, &[Shading::Smooth])?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod artifact;
mod batches;
mod closed;
pub mod darkness;
mod error;
mod export;
mod face_rays;
mod factor_export;
pub mod facts;
pub mod inspect;
mod job;
mod machine;
mod observer;
pub mod openings;
mod pipeline;
mod prediction;
mod remedy;
pub mod resources;
mod row_columns;
mod row_report;
mod rows;
pub mod settings;
pub mod words;

pub use artifact::{How, Origin, Sources};
pub use error::Error;
pub use export::{cells, patch_at, radiosity_table, reference_table, table_mesh};
pub use factor_export::{By, FactorTable};
pub use observer::{Observer, Silent, Stage};
pub use pipeline::{FormFactorsMade, PatchLight, Pipeline, Quantity, Shown, Solved, covers};
pub use remedy::Remedy;
pub use row_report::RowReport;
pub use rows::{RowSummary, Unbalanced};

pub use radiosity_cache as cache;
pub use radiosity_compare as compare;
pub use radiosity_form_factors as form_factors;
pub use radiosity_geometry as geometry;
pub use radiosity_image as image;
pub use radiosity_matrix as matrix;
pub use radiosity_reference as reference;
pub use radiosity_renderer as renderer;
pub use radiosity_scene as scene;
pub use radiosity_solver as solver;
