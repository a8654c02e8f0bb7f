//! Rays and segments, the tree of faces that they meet, and the questions that they put to it.

pub(crate) mod bvh;
mod bvh_build;
mod bvh_packet;
mod face_block;
pub(crate) mod occluders;
pub(crate) mod ray;
mod ray_query;
pub(crate) mod segment_packet;
mod shaft;
mod shaft_query;
mod slabs;
