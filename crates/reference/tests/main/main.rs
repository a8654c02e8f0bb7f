//! The oracle against closed forms, and against itself.

mod pictures;
mod radiosities;
