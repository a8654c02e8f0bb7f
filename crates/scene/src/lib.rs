//! Turns scene files (TOML, or View3D's) and mesh files (OBJ) into a checked [`Scene`].
//!
//! Every error says what is wrong, shows the line it stands in and says how to mend it
//! ([`SceneError`]). What [`parse`] returns is usable: numbers are finite and in range, names
//! resolve, shapes have area, the camera can look.
//!
//! This crate knows nothing of patches, or of the stages and their parameters: what a file says of
//! these is left to whoever takes it ([`Tables`]).

mod build;
mod camera;
mod error;
mod file;
mod input;
mod light;
mod load;
mod material;
mod mesh;
mod obj;
mod scene;
mod signature;
mod source;
mod surface;
mod tables;
mod toml_error;
mod values;
mod vs3;

#[cfg(test)]
pub(crate) mod tests;

pub use build::MaterialId;
pub use camera::{ALL_VIEWS, FIRST_VIEW, View};
pub use error::{FilePlace, Help, SceneError};
pub use input::MeshFiles;
pub use light::{Light, MOST_DIMMING};
pub use load::{Loaded, parse, read};
pub use material::Material;
pub use scene::{FileKind, Scene};
pub use source::suggestion;
pub use surface::Surface;
pub use tables::Tables;
