//! The scenes that are shipped.

use radiosity_scene::{Scene, load};
use std::path::{Path, PathBuf};

/// A path in the checkout.
pub fn in_checkout(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}

/// The scene of this name in `scenes/`.
pub fn shipped_scene(name: &str) -> Scene {
    load(&in_checkout(&format!("scenes/{name}.toml"))).unwrap_or_else(|error| panic!("{error}"))
}
