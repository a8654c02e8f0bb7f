//! Pictures as bytes, and bytes as pictures.

mod bytes;
mod formats;
#[cfg(feature = "openexr")]
mod openexr;
mod sizes;
