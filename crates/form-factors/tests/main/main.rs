//! What estimators make of meshes: against closed forms, exact factors, the plainest loops, and
//! each other.
//!
//! `cargo test -p radiosity-form-factors --test main touching` runs those of one file; slow
//! campaigns run with `-- --include-ignored`.

mod accurate;
mod bare;
mod box313;
mod closed_forms;
mod closure;
mod covers;
mod estimated;
mod few_points;
mod invariants;
mod monte_carlo;
mod occlusion;
mod pieces;
mod plain;
mod random_pairs;
mod regular;
mod tally;
mod touching;
mod visible;
