//! Turns surfaces ([`Surface`]) into a [`Mesh`] of patches, answers which face a ray meets
//! ([`Occluders`]), and says where the rays of a picture go ([`Camera`], [`Film`]).
//!
//! Conventions, for the whole project:
//!
//! - Right-handed coordinates, lengths in scene units, `f64`.
//! - The normal of a polygon is `edge_a x edge_b`; seen from its front, corners run
//!   counter-clockwise. The front emits, receives and reflects; both sides block.
//! - A *face* is one undivided planar polygon ([`FaceId`]), a *surface* is what a scene
//!   names ([`SurfaceId`]): one face, or the many faces of a mesh. Patches are cells of faces.
//! - A face never blocks segments that end on it. That rule goes by face and not by surface,
//!   so a mesh shadows itself; no distance threshold along the ray is involved.
//!
//! This crate knows nothing of files, colours, light or names.

mod between;
mod bounds;
mod build;
mod bundle;
mod bvh;
mod camera;
mod check;
mod covers;
mod discretization;
mod face_block;
mod film;
mod grids;
mod locate;
mod mesh;
mod morton;
mod narrow;
mod occluders;
mod polygon;
mod polygon_mesh;
mod queries;
mod ray;
mod remainder;
mod screen;
mod shaft;
mod shape;
mod slabs;
mod subdivide;
mod together;
mod walls;

pub use bounds::Aabb;
pub use bundle::{Bundle, Points};
pub use camera::{Camera, CameraError};
pub use check::{ShapeError, has_area};
pub use covers::{Covered, Covers};
pub use discretization::{Discretization, Divisions, NamedShape};
pub use film::{Film, PixelFilter};
pub use glam::{DVec2, DVec3};
pub use locate::Location;
pub use mesh::{Face, FaceId, Grid, Mesh, Patch, SurfaceId};
pub use narrow::NarrowGrid;
pub use occluders::{Hit, Occluders};
pub use polygon::Polygon;
pub use polygon_mesh::PolygonMesh;
pub use ray::Ray;
pub use remainder::{area_around, fan, remainder};
pub use screen::{Backs, Linear, Offsets, Screen, Seen, SeenFace};
pub use shape::Shape;
pub use subdivide::{
    FaceOrder, LEAST_SIZE, MAX_PATCHES, MeshError, Surface, count_patches, subdivide, subdivide_in,
};
pub use walls::Walls;
