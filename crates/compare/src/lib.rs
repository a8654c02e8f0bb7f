//! Turns two images, or two tables of radiosities, into the [`Errors`] of one against the
//! other: the measures by which every claim of accuracy in this project is made.
//!
//! Pictures are compared as linear radiance over the pixels that are not clamped
//! ([`compare_pictures`]), tables over the patches that are lit and do not emit
//! ([`compare_tables`]). Either way an error is a percentage of the mean of the reference over
//! the same values.
//!
//! This crate knows nothing of scenes or of how pictures are made and encoded, and touches no
//! files.

mod difference;
mod errors;
mod pictures;
mod table;
mod table_name;
mod tables;

pub use difference::{DifferencePicture, difference_picture};
pub use errors::{Errors, Percentiles};
pub use pictures::{PictureError, compare_pictures};
pub use table::{Row, Table, TableError, parse_table};
pub use table_name::table_name;
pub use tables::{Cell, compare_tables};
