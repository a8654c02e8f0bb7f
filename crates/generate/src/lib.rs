//! Turns a rule and a size into the text of a scene or a mesh.
//!
//! `cargo xtask generate` writes it into a file, and benches parse it. Nothing here knows how
//! scenes are read.

pub mod blob;
pub mod knot;
pub mod nested_box;
mod vs3;
