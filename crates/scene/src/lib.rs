//! Turns scene files (TOML, or View3D's) and mesh files (OBJ) into a checked [`Scene`].
//!
//! Every error says what is wrong, shows the line it stands in and says how to mend it
//! ([`SceneError`]). What [`load`] returns is usable: numbers are finite and in range, names
//! resolve, shapes have area, the camera can look.
//!
//! This crate knows nothing of patches or form factors.

mod camera;
mod error;
mod file;
mod image;
mod input;
mod light;
mod material;
mod mesh;
mod obj;
mod scene;
mod settings;
mod signature;
mod source;
mod surface;
mod values;
mod vs3;

#[cfg(test)]
mod tests;

pub use camera::{ALL_VIEWS, FIRST_VIEW, View};
pub use error::{FilePlace, Help, SceneError};
pub use image::{Exposure, Gamma, ImageSettings, Standard, Tone};
pub use input::MeshFiles;
pub use light::{Light, MOST_DIMMING};
pub use material::Material;
pub use scene::{FileKind, Scene, load, load_with, parse};
pub use settings::{Automatic, FormFactorSettings, Mode, Relaxation, SolverMethod, SolverSettings};
pub use source::suggestion;
pub use surface::Surface;
