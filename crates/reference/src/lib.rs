//! Turns a [`Scene`](radiosity_scene::Scene) into unbiased path-traced radiosities with standard
//! errors ([`cell_means`]) and pictures ([`Tracer`]): the oracle that the finite elements are
//! judged by.
//!
//! The conventions are those of the whole project: the front of a surface emits and reflects
//! diffusely, both sides block, backs and the background are black.
//!
//! This crate shares with what it judges nothing but the intersection code. It knows nothing of
//! form factors or of the solver, and of patches only where their borders are.

mod cells;
mod emitters;
mod path;
mod picture;
mod statistics;
mod world;

pub use cells::{CellMean, cell_means};
pub use picture::{TracedPicture, Tracer};

/// Red, green, blue.
pub type Rgb = [f64; 3];
