//! What the end-to-end tests share: shipped scenes, reference data, and the two measures of
//! error that `data/README.md` defines.

mod measure;
mod reference;

pub use measure::{picture_errors, radiosity_errors, table_errors};
pub use reference::{radiance, reference_table, regions};

use radiosity::renderer::Shading;
use radiosity::scene::{Scene, load};
use radiosity::{Pipeline, Silent, Solved, Sources};
use std::path::{Path, PathBuf};

/// The shadings of the course's pictures.
pub const BOTH: [Shading; 2] = [Shading::Constant, Shading::Smooth];

/// A folder or file of the checkout.
pub fn in_checkout(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

/// A shipped scene.
pub fn shipped(name: &str) -> Scene {
    load(&in_checkout(&format!("scenes/{name}.toml"))).unwrap_or_else(|error| panic!("{error}"))
}

/// The pipeline of a scene, without a cache.
pub fn pipeline(scene: &Scene) -> Pipeline<'_> {
    Pipeline::new(scene, None, &Silent).unwrap_or_else(|error| panic!("{error}"))
}

/// The solution of a pipeline.
pub fn solve(pipeline: &Pipeline<'_>) -> Solved {
    let solved = pipeline.solution(Sources::Cached);
    solved.unwrap_or_else(|error| panic!("{error}"))
}
