//! The measures for pictures and for tables.

mod pictures;
mod tables;
