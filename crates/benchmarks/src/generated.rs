//! Scenes that were generated, as they are after they are read.

use crate::Error;
use radiosity::geometry::Mesh;
use radiosity::scene::Scene;
use radiosity::{Context, Project, subdivide};
use std::path::Path;

/// A scene that was generated, cut as it says.
pub(crate) fn generated(name: &str, text: &str) -> Result<(Scene, Mesh), Error> {
    let Project { scene, params, .. } = Project::parse(Path::new(name), text)?;
    let mesh = subdivide(&scene, &params.discretization, Context::default())?.mesh;
    Ok((scene, mesh))
}
