//! Turns two pictures, or two tables of radiosities, into the [`Errors`] of one against the
//! other: the measures by which every claim of accuracy in this project is made.
//!
//! Pictures are compared as linear radiance over the pixels that are not clamped
//! ([`compare_pictures`]), tables over the patches that are lit and do not emit
//! ([`compare_tables`]). Either way an error is a percentage of the mean of the reference over
//! the same values.
//!
//! This crate knows nothing of scenes and touches no files: it reads bytes.

mod decode;
mod difference;
mod errors;
mod head;
mod pictures;
mod portable;
mod regions;
mod size;
mod table;
mod table_name;
mod tables;

pub use decode::{DecodeError, Decoded, Screen, decode_picture};
pub use difference::{DifferencePicture, difference_picture};
pub use errors::{Errors, Percentiles};
pub use head::picture_size;
pub use pictures::{PictureError, compare_pictures};
pub use regions::{Regions, RegionsError, decode_regions};
pub use size::SizeError;
pub use table::{Row, Table, TableError, parse_table};
pub use table_name::table_name;
pub use tables::{Cell, compare_tables};
