//! The whole chain: physics, energy, references, golden pictures, caching.
//!
//! `cargo test -p radiosity-tests --test main physics` runs those of one file; slow campaigns run
//! with `-- --include-ignored`.

mod caching;
mod closure;
mod energy;
mod exposure;
mod golden;
mod oracle;
mod physics;
mod quantities;
mod truth;
