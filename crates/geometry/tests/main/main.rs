//! Surfaces into patches, cameras, and what rays and screens see of faces.
//!
//! `cargo test -p radiosity-geometry --test main screen` runs those of one file.

mod bad_input;
mod camera;
mod intersection;
mod leaks;
mod listed;
mod narrow;
mod screen;
mod sliver;
mod subdivision;
mod two_sided;
