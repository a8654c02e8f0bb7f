//! The steps of one channel of one light by conjugate gradients, and what they tell.

use crate::scaled_system::UNIT_ROUNDOFF;

/// Where `(p, M p)` is less of `(p, w p)` than this, a quarter of it or more is rounding, and
/// says nothing of how far to go.
const INDISTINCT: f64 = 4.0 * UNIT_ROUNDOFF;

/// One channel of one light.
#[derive(Clone)]
pub(crate) struct Channel {
    /// The norm of `z`, relative to that of the emission.
    pub(crate) residual: f64,
    /// `(z, w z)`.
    square: f64,
    /// `alpha` and the `beta` after it.
    steps: Vec<(f64, f64)>,
    /// The smallest eigenvalue of `M / w` as far as it is known.
    pub(crate) least: f64,
    /// Whether it takes no more steps.
    pub(crate) rests: bool,
    /// Whether it cannot: rounding hides whether `(p, M p)` is positive.
    pub(crate) is_stuck: bool,
}

impl Default for Channel {
    fn default() -> Channel {
        Channel {
            residual: 0.0,
            square: 0.0,
            steps: Vec::new(),
            least: 1.0,
            rests: false,
            is_stuck: false,
        }
    }
}

impl Channel {
    /// Begins anew at a residual of which `(z, w z)` is known.
    pub(crate) fn begin(&mut self, square: f64) {
        self.square = square;
        self.steps.clear();
        self.is_stuck = false;
    }

    /// How far to go, where `(p, M p)` is the difference of `(p, w p)` and `(p, A F p)`.
    pub(crate) fn alpha(&mut self, length: f64, reflected: f64) -> f64 {
        if self.rests || self.square == 0.0 {
            return 0.0;
        }
        let product = length - reflected;
        self.is_stuck = !(product > INDISTINCT * length && product.is_finite());
        if self.is_stuck {
            0.0
        } else {
            self.square / product
        }
    }

    /// Takes note of a step that has led to `(z, w z)`; gives the beta of the next.
    pub(crate) fn finish_step(&mut self, alpha: f64, square: f64) -> f64 {
        if alpha == 0.0 {
            return 0.0;
        }
        let beta = square / self.square;
        self.square = square;
        self.steps.push((alpha, beta));
        self.least = self.least.min(smallest_eigenvalue(&self.steps));
        beta
    }
}

/// Of the tridiagonal matrix that steps `alpha`, `beta` make (Saad 2003, eq. 6.103), by Sturm
/// sequences: the smallest Ritz value, which comes down to the smallest eigenvalue. That lies in
/// (0, 1] here: it is that of `I - rho F`.
fn smallest_eigenvalue(steps: &[(f64, f64)]) -> f64 {
    let mut rows: Vec<(f64, f64)> = Vec::new();
    let mut before = None;
    for &(alpha, beta) in steps {
        let (diagonal, square) = before.map_or((0.0, 0.0), |(alpha, beta): (f64, f64)| {
            (beta / alpha, beta / (alpha * alpha))
        });
        rows.push((1.0 / alpha + diagonal, square));
        before = Some((alpha, beta));
    }
    let is_below_all = |shift: f64| {
        let mut pivot = f64::INFINITY;
        rows.iter().all(|&(diagonal, square)| {
            pivot = diagonal - shift - square / pivot;
            pivot > 0.0
        })
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if is_below_all(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
