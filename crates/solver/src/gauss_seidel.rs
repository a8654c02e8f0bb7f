//! Gauss-Seidel, the reference among the methods, and over-relaxation.
//!
//! A sweep solves row after row for its own unknown, with the newest values of all others
//! (Cohen & Wallace 1993, section 5.3.2):
//!
//! ```text
//! x_i <- (1 - omega) x_i + omega (E_i + rho_i (sum_{j<i} F_ij x_j + sum_{j>i} F_ij x_j))
//! ```
//!
//! with `omega = 1`. The first sum has this sweep's values, the second the last sweep's, so it is
//! known before the sweep begins. When the sweep ends, both sums are known for the new values:
//! the residual needs no further pass.
//!
//! Greater `omega` over-relaxes each change (successive over-relaxation). The system is that of a
//! symmetric positive definite matrix, `A (1/rho - F)`, so every `omega` in (0, 2) converges
//! (Ostrowski 1954). Which is best is known where every patch sees all others equally, of
//! reflectance `r`. Take the place of a patch in the order as a number `t` from 0 to 1. A change
//! that shrinks by the rate `q` per sweep then obeys
//!
//! ```text
//! q e(t) = (1 - omega) e(t) + omega r (q int_0^t e + int_t^1 e) ,
//! ```
//!
//! which has the solution `e = q^t` where `ln q = omega r (q - 1) / (q + omega - 1)`. So the
//! observed `q` tells `r`; and with greater `omega`, `q` falls until it meets `omega - 1`, below
//! which it does not come. Rooms turn out to be alike enough.

use crate::Rgb;
use crate::convergence::Progress;
use crate::params::Relaxation;
use crate::scaled_system::{ScaledSystem, UNIT_ROUNDOFF, Values, ratio, worst};
use crate::solve::IterativeMethod;
use radiosity_matrix::{Sweep, Triple};
use std::rc::Rc;

/// After so many sweeps the rate is looked at: the first of them are plain, and few changes are
/// not yet those that remain.
const LOOKS: [usize; 2] = [3, 8];
/// Relative changes below this are roundings for the most part: those of two sweeps, which scatter.
const ROUNDING: f64 = 4.0 * UNIT_ROUNDOFF;
/// Relative changes below this tell no rate: where patches are equal, so are their roundings, and
/// those of two sweeps are a sixteenth of this.
const TELLING: f64 = 32.0 * UNIT_ROUNDOFF;
/// Sweeps without less of a change after which none is expected.
const STAGNANT_SWEEPS: usize = 4;

pub(crate) struct GaussSeidel<'a> {
    scaled: Rc<ScaledSystem<'a>>,
    rows: &'a dyn Sweep,
    x: Values<f32>,
    /// `sum_{j<i} F_ij x_j`, and `sum_{j>i} F_ij x_j`.
    sums: [Values<f64>; 2],
    factor: f64,
    /// That of the last sweep.
    used: f64,
    is_automatic: bool,
    /// The norm of each sweep's change over all channels, relative to that of the values, of the
    /// light where it is worst.
    changes: Vec<f64>,
    /// The ratio of a change to the one before, as long as changes told it.
    rate: Option<f64>,
}

impl<'a> GaussSeidel<'a> {
    /// Begins at the emission, of which one pass finds the sums.
    pub(crate) fn new(
        scaled: Rc<ScaledSystem<'a>>,
        rows: &'a dyn Sweep,
        relaxation: Relaxation,
    ) -> GaussSeidel<'a> {
        let mut x = scaled.emission.clone();
        let mut above = Values::with_capacity(x.len());
        let below = rows.sweep(&mut x, scaled.lights(), &mut |_, sums, _| {
            above.extend_from_slice(sums);
        });
        let (factor, is_automatic) = match relaxation {
            Relaxation::Factor(factor) => (factor, false),
            Relaxation::Automatic => (1.0, true),
        };
        GaussSeidel {
            scaled,
            rows,
            x,
            sums: [above, below],
            factor,
            used: factor,
            is_automatic,
            changes: Vec::new(),
            rate: None,
        }
    }

    /// What arrives where the values leave.
    pub(crate) fn irradiance(&self) -> Values<f64> {
        (0..self.x.len()).map(|k| self.irradiance_at(k)).collect()
    }

    fn irradiance_at(&self, k: usize) -> Rgb {
        let [above, below] = &self.sums;
        std::array::from_fn(|c| above[k][c] + below[k][c])
    }

    /// Goes through all rows; keeps the norm of the change.
    fn sweep(&mut self) {
        let scaled = &self.scaled;
        self.used = self.factor;
        let (lights, factor) = (scaled.lights(), self.factor);
        let [above, below] = &mut self.sums;
        let mut norms = vec![(0.0, 0.0); lights];
        let mut update = |i: usize, sums: &[Triple<f64>], x: &mut [Triple<f32>]| {
            let first = i * lights;
            let (area, rho) = (scaled.areas[i], &scaled.reflectance[i]);
            for (k, (x, norm)) in x.iter_mut().zip(&mut norms).enumerate() {
                let (above, below) = (&mut above[first + k], &below[first + k]);
                let emission = &scaled.emission[first + k];
                *above = sums[k];
                for c in 0..3 {
                    let old = f64::from(x[c]);
                    let sum = above[c] + below[c];
                    let wanted = f64::from(emission[c]) + rho[c] * sum;
                    x[c] = (old + factor * (wanted - old)) as f32;
                    let new = f64::from(x[c]);
                    norm.0 += area * (new - old) * (new - old);
                    norm.1 += area * new * new;
                }
            }
        };
        let new = self.rows.sweep(&mut self.x, lights, &mut update);
        self.sums[1] = new;
        let changes = norms
            .iter()
            .map(|(change, value)| ratio(change.sqrt(), value.sqrt()));
        self.changes.push(worst(changes));
        self.observe_rate();
    }

    fn residual(&self) -> f64 {
        let scaled = &self.scaled;
        scaled.relative(|k| scaled.residual_at(k, &self.irradiance_at(k), &self.x[k]))
    }

    /// Over the last two changes, unless they are roundings.
    fn observe_rate(&mut self) {
        if let [.., first, _, last] = self.changes[..]
            && last >= TELLING
        {
            self.rate = Some((last / first).sqrt());
        }
    }

    /// Never less than before: a rate that the factor itself makes says nothing of the room.
    fn choose_factor(&mut self) {
        let rate = self.rate.unwrap_or(0.0);
        let is_shrinking = rate > self.factor - 1.0 && rate < 1.0;
        if self.is_automatic && LOOKS.contains(&self.changes.len()) && is_shrinking {
            let reflectance = reflectance_behind(rate, self.factor);
            self.factor = best_factor(reflectance).max(self.factor);
        }
    }
}

/// Whether changes are roundings, and have not become less for some sweeps.
fn has_stagnated(changes: &[f64]) -> bool {
    let Some((before, last)) = changes.split_last_chunk::<STAGNANT_SWEEPS>() else {
        return false;
    };
    let least = |changes: &[f64]| changes.iter().copied().fold(f64::INFINITY, f64::min);
    least(before) < ROUNDING && least(last) >= least(before)
}

/// The reflectance of the room of equal patches in which changes shrink by a rate.
fn reflectance_behind(rate: f64, factor: f64) -> f64 {
    rate.ln() * (rate + factor - 1.0) / (factor * (rate - 1.0))
}

/// What is missing where changes are lost by rounding: the residual that they were to mend,
/// reflected on and on.
fn lost(rate: f64, factor: f64) -> f64 {
    let reflectance = reflectance_behind(rate.max(factor - 1.0), factor);
    UNIT_ROUNDOFF / (factor * (1.0 - reflectance))
}

/// The factor at which the rate is `factor - 1`, in the room of equal patches.
fn best_factor(reflectance: f64) -> f64 {
    let (mut low, mut high) = (1.0, 2.0);
    for _ in 0..40 {
        let factor = 0.5 * (low + high);
        let rate = factor - 1.0;
        // The reflectance behind this rate grows with the factor.
        if reflectance_behind(rate, factor) < reflectance {
            low = factor;
        } else {
            high = factor;
        }
    }
    low
}

impl IterativeMethod for GaussSeidel<'_> {
    fn advance(&mut self) -> Progress {
        self.sweep();
        let change = self.changes.last().copied().unwrap_or(0.0);
        // What is left shrinks by the same rate: a geometric series.
        let rest = |rate: f64| change * rate / (1.0 - rate) + lost(rate, self.used);
        let error = self.rate.filter(|&rate| rate < 1.0).map(rest);
        self.choose_factor();
        Progress {
            residual: self.residual(),
            error,
            stalled: has_stagnated(&self.changes),
            suspicious: false,
        }
    }

    fn relaxation(&self) -> Option<f64> {
        Some(self.used)
    }

    fn finish(self: Box<Self>) -> (Values<f32>, Values<f64>) {
        let irradiance = self.irradiance();
        (self.x, irradiance)
    }
}
