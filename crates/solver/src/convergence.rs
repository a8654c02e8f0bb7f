//! How a solution was reached, and how far it may still be off.

use crate::diagnosis::is_falling;
use crate::{Method, Power};
use serde::{Deserialize, Serialize};

/// The course of an iteration. Norms are area-weighted L2 norms over patches; of the channels of
/// all lights, the worst counts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Convergence {
    /// How it was solved.
    pub method: Method,
    /// Whether the tolerance was reached within the allowed passes.
    pub converged: bool,
    /// Whether it was not, and no pass brought it nearer any more: single precision has no better
    /// solution.
    pub stalled: bool,
    /// The true residual `||E + rho F B - B|| / ||E||` of the radiosities as they are returned, in
    /// single precision. Its sums have rounding errors of some 1e-7.
    pub residual: f64,
    /// The residual after each pass over the matrix, as the method knows it.
    pub residuals: Vec<f64>,
    /// An estimate of `||B - exact B|| / ||B||`, from the rate at which changes shrank (over all
    /// channels of a light) or from the smallest Ritz value; none after too few passes.
    pub error: Option<f64>,
    /// The factor by which Gauss-Seidel overdid its last changes.
    pub relaxation: Option<f64>,
    /// What each light emits, and what of it is absorbed.
    pub powers: Vec<Power>,
}

impl Convergence {
    /// Whether the residual has become clearly less over the second half of the passes, so that
    /// more of them would help. One pass alone does not tell, but more of them mostly help.
    pub fn is_falling(&self) -> bool {
        self.residuals.len() < 2 || is_falling(&self.residuals)
    }
}

/// What a pass has come to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Progress {
    /// See [`Convergence::residual`].
    pub(crate) residual: f64,
    /// See [`Convergence::error`].
    pub(crate) error: Option<f64>,
    /// Nothing changed any more: single precision gives no better one.
    pub(crate) stalled: bool,
    /// Something that only happens where there is no solution.
    pub(crate) suspicious: bool,
}
