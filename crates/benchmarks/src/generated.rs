//! Scenes that were generated, as they are after they are read.

use crate::Error;
use radiosity::geometry::{Mesh, subdivide};
use radiosity::scene::{Scene, parse};
use std::path::Path;

/// A scene that was generated, cut as it says.
pub(crate) fn generated(name: &str, text: &str) -> Result<(Scene, Mesh), Error> {
    let scene = parse(Path::new(name), text)?;
    let mesh = subdivide(&scene.geometry, scene.divisions);
    Ok((scene, mesh?))
}
