//! The way through all pairs of patches, in tiles of eight: from groups of tiles down to pairs of
//! tiles, which an estimator turns into blocks of values and errors.

pub(crate) mod begun_rows;
pub(crate) mod tile_block;
pub(crate) mod tiled_mesh;
pub(crate) mod tiles;
