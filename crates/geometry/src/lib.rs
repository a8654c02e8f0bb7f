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

mod bounds;
mod camera;
mod coplanar;
mod discretization;
mod locate;
mod mesh;
mod polygon;
mod polygon_mesh;
mod rasterizer;
mod rays;
mod shape;
mod shape_error;
mod subdivide;

pub use bounds::Aabb;
pub use camera::film::{Film, PixelFilter};
pub use camera::{Camera, CameraError};
pub use coplanar::covers::{Covered, Covers};
pub use coplanar::merged_faces::MergedFaces;
pub use coplanar::remainder::{area_around, fan, remainder};
pub use discretization::{Discretization, Divisions, NamedShape};
pub use glam::{DVec2, DVec3};
pub use locate::Location;
pub use mesh::{Face, FaceId, Grid, Mesh, Patch, SurfaceId};
pub use polygon::Polygon;
pub use polygon_mesh::PolygonMesh;
pub use rasterizer::{Backs, Linear, Offsets, Screen, Seen, SeenFace};
pub use rays::occluders::{Hit, Occluders};
pub use rays::ray::Ray;
pub use rays::segment_packet::{Points, SegmentPacket};
pub use shape::Shape;
pub use shape_error::{ShapeError, has_area};
pub use subdivide::narrow::NarrowGrid;
pub use subdivide::{
    FaceOrder, LEAST_SIZE, MAX_PATCHES, MeshError, Surface, count_patches, subdivide, subdivide_in,
};
