//! The scenes that are shipped.

use radiosity_geometry::{Discretization, FaceOrder, Mesh, subdivide_in};
use radiosity_scene::{MeshFiles, Scene, parse, read};
use std::path::{Path, PathBuf};

/// A path in the checkout.
pub fn in_checkout(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}

/// The scene of this name in `scenes/`.
pub fn shipped_scene(name: &str) -> Scene {
    let path = in_checkout(&format!("scenes/{name}.toml"));
    scene_of(
        &path,
        &read(&path).unwrap_or_else(|error| panic!("{error}")),
    )
}

/// The scene in a text.
pub fn scene_of(path: &Path, text: &str) -> Scene {
    let loaded = parse(path, text, MeshFiles::InFolder);
    loaded.unwrap_or_else(|error| panic!("{error}")).scene
}

/// A scene with so many patches along each edge of surfaces other than meshes, as the library cuts
/// it.
pub fn cut_scene(scene: &Scene, divisions: u32) -> Mesh {
    let params = Discretization::uniform(divisions);
    let surfaces = params.of_shapes(scene.shapes());
    let mesh = subdivide_in(FaceOrder::Curve, &surfaces, params.default);
    mesh.unwrap_or_else(|error| panic!("{error}"))
}
