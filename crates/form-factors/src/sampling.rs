//! Points on patches, regular or random, and the random numbers behind them.

pub(crate) mod fan;
pub(crate) mod lattice;
pub(crate) mod patch_sampler;
pub(crate) mod points;
pub(crate) mod random;
