//! Turns artifacts into files and back, so that no stage computes the same thing twice.
//!
//! An artifact is a small typed part (its *facts*) and one big array of `f32`. Its identity is a
//! [`Key`], the digest of everything that its stage read. [`Store::read`] gives an [`Artifact`] or
//! the reason why there is none ([`Miss`]); every doubt about a file is a miss, never an error and
//! never wrong data. [`Store::write`] replaces files atomically; a [`Draft`] is written as it is
//! made, and survives its writer. What was made of a file that somebody changed meanwhile is not
//! kept ([`Store::check`]). [`Store::clean`] removes what nobody has used for long.
//!
//! This crate is the only one that names bincode. It knows nothing of physics.

mod artifact;
mod cache_file;
mod clean;
mod digests;
mod draft;
mod format;
mod key;
mod last_use;
mod listing;
mod lock;
mod partial;
mod replace;
mod store;
mod values;

#[cfg(test)]
mod tests;

pub use artifact::{Artifact, Opened, open};
pub use clean::{Amount, Cleaned, Limits};
pub use draft::{Batch, Draft, OnFailure, Unusable};
pub use format::Miss;
pub use key::Key;
pub use last_use::last_user;
pub use listing::Entry;
pub use lock::Lock;
pub use partial::remove_unfinished;
pub use replace::{replace_file, replace_file_by};
pub use store::{CacheError, Id, Store};
pub use values::{Changed, Values};
