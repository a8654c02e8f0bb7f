//! What may stand between two patches: possible blockers are culled from the coarse to the fine.

pub(crate) mod blocker;
pub(crate) mod blockers;
pub(crate) mod convex_bound;
mod pair_hull;
mod two_sided;
