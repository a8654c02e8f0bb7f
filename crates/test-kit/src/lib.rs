//! What tests of several crates build on: shapes and meshes, rooms, closed forms, statistics.
//!
//! For dev-dependencies alone: what cannot be made is a mistake of the test, and panics. Unit tests
//! of `geometry` and `scene` cannot use it: theirs would be other types than the kit's.

pub mod box313;
pub mod closed_forms;
mod cuboid;
mod icosphere;
mod meshes;
pub mod random;
pub mod rooms;
mod shapes;
mod shipped;
mod statistics;
mod threads;

pub use cuboid::{cuboid, cuboid_mesh, inside_out};
pub use icosphere::icosphere;
pub use meshes::{cut, mesh_of, surface, surfaces};
pub use shapes::{Facing, hinged, parallelogram, polygon, quad, square, two_sided};
pub use shipped::{cut_scene, in_checkout, scene_of, shipped_scene};
pub use statistics::Mean;
pub use threads::on_threads;
