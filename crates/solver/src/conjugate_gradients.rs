//! Conjugate gradients on the symmetrized system.
//!
//! Row `i` times its weight `w_i = A_i / rho_i` makes the system symmetric, since `A F` is,
//!
//! ```text
//! M x = b ,   M = diag(w) - A F ,   b_i = w_i E_i ,
//! ```
//!
//! and positive definite where light dies away. Preconditioned by `diag(1 / w)`, the residual
//! `z = E + rho F x - x` is that of the radiosity equation itself (Saad, "Iterative Methods for
//! Sparse Linear Systems", 2003, algorithm 9.1):
//!
//! ```text
//! alpha = (z, w z) / (p, M p) ,   x <- x + alpha p ,   z <- z - alpha M p / w ,
//! beta = (z, w z) / (the same before) ,   p <- z + beta p
//! ```
//!
//! for each channel of each light by itself, with one product for all. Black rows are solved from
//! the start.
//!
//! A channel rests as soon as its residual is small enough. Further steps would do harm: `z` goes
//! on falling by the recurrence long after rounding has the say, until `alpha` is a quotient of
//! nothing. When all channels rest, the true residual is computed, of the values in single
//! precision; where it is not small enough yet, everything begins anew from there.
//!
//! The numbers `alpha` and `beta` tell the smallest eigenvalue of `M / w` ([`crate::channel`]),
//! and that tells the error.
//!
//! Long because: the algorithm, its stopping rule and its check are read together.

use crate::Rgb;
use crate::channel::Channel;
use crate::convergence::Progress;
use crate::scaled_system::{ScaledSystem, UNIT_ROUNDOFF, Values, ratio, worst};
use crate::solve::IterativeMethod;
use radiosity_matrix::Triple;
use std::rc::Rc;

pub(crate) struct ConjugateGradients<'a> {
    scaled: Rc<ScaledSystem<'a>>,
    tolerance: f64,
    x: Values<f64>,
    z: Values<f64>,
    p: Values<f32>,
    /// Those of the first light, then those of the next.
    channels: Vec<Channel>,
    /// The best values in single precision so far.
    best: Option<Verified>,
    /// Whether the next step begins anew from those.
    is_verified: bool,
}

/// Values in single precision, of which the residual is no matter of recurrence.
struct Verified {
    x: Values<f32>,
    /// What arrives where they leave.
    irradiance: Values<f64>,
    residual: f64,
    error: f64,
}

impl<'a> ConjugateGradients<'a> {
    /// Begins at the emission, of which it is known what arrives.
    pub(crate) fn new(
        scaled: Rc<ScaledSystem<'a>>,
        irradiance: &[Triple<f64>],
        tolerance: f64,
    ) -> ConjugateGradients<'a> {
        let emission = scaled.emission.clone();
        let mut iteration = ConjugateGradients {
            tolerance,
            x: Values::new(),
            z: Values::new(),
            p: Values::new(),
            channels: vec![Channel::default(); 3 * scaled.lights()],
            scaled,
            best: None,
            is_verified: false,
        };
        iteration.restart(&emission, irradiance);
        // A pass is taken in any case, and may as well do something.
        iteration
            .channels
            .iter_mut()
            .for_each(|of| of.rests = false);
        iteration
    }

    /// Begins at values of which it is known what arrives where they leave.
    fn restart(&mut self, x: &[Triple<f32>], irradiance: &[Triple<f64>]) {
        let scaled = &self.scaled;
        let is_black = |k: usize, c: usize| scaled.reflectance[k / scaled.lights()][c] == 0.0;
        self.x = x.iter().map(|x| x.map(f64::from)).collect();
        let residual = |k: usize| -> Rgb {
            let z = scaled.residual_at(k, &irradiance[k], &x[k]);
            std::array::from_fn(|c| if is_black(k, c) { 0.0 } else { z[c] })
        };
        self.z = (0..x.len()).map(residual).collect();
        self.p = self.z.iter().map(|z| z.map(|z| z as f32)).collect();
        let squares = self.squares();
        for (channel, square) in self.channels.iter_mut().zip(squares) {
            channel.begin(square);
        }
        self.observe();
    }

    /// Looks how large residuals are, and which channels may rest.
    fn observe(&mut self) {
        // Products err by as much of `p`, and what is left cannot be told from that.
        let enough = self.tolerance.max(UNIT_ROUNDOFF);
        let residuals = self.scaled.ratios(|k| self.z[k]);
        for (channel, residual) in self.channels.iter_mut().zip(residuals) {
            channel.residual = residual;
            channel.rests = residual <= enough || channel.is_stuck;
        }
    }

    /// A sum over all rows, weighted by area, for each channel of each light; `term` is asked by
    /// index, channel and reflectance, where that is not zero.
    fn reduced(&self, term: impl Fn(usize, usize, f64) -> f64) -> Vec<f64> {
        let lights = self.scaled.lights();
        let mut sums = vec![[0.0; 3]; lights];
        for k in 0..self.x.len() {
            let area = self.scaled.areas[k / lights];
            let rho = &self.scaled.reflectance[k / lights];
            for c in (0..3).filter(|&c| rho[c] > 0.0) {
                sums[k % lights][c] += area * term(k, c, rho[c]);
            }
        }
        sums.into_flattened()
    }

    fn squares(&self) -> Vec<f64> {
        // Where reflectances are tiny, so are residuals: their quotient is ordinary.
        self.reduced(|k, c, rho| self.z[k][c] * (self.z[k][c] / rho))
    }

    /// One step of all channels that do not rest.
    fn step(&mut self) {
        let mut p = std::mem::take(&mut self.p);
        let arrives = self.scaled.irradiance(&p);
        let lengths = self.reduced(|k, c, rho| f64::from(p[k][c]) * (f64::from(p[k][c]) / rho));
        let reflected = self.reduced(|k, c, _| f64::from(p[k][c]) * arrives[k][c]);
        let channels = self.channels.iter_mut().zip(lengths).zip(reflected);
        let alphas: Vec<f64> = channels
            .map(|((channel, length), reflected)| channel.alpha(length, reflected))
            .collect();
        self.go(&alphas, &p, &arrives);
        let squares = self.squares();
        let steps = self.channels.iter_mut().zip(alphas).zip(squares);
        let betas: Vec<f64> = steps
            .map(|((channel, alpha), square)| channel.finish_step(alpha, square))
            .collect();
        self.turn(&betas, &mut p);
        self.p = p;
        self.observe();
    }

    /// Goes along `p`, of which it is known what arrives.
    fn go(&mut self, alphas: &[f64], p: &[Triple<f32>], arrives: &[Triple<f64>]) {
        let lights = self.scaled.lights();
        for k in 0..self.x.len() {
            let rho = &self.scaled.reflectance[k / lights];
            for c in 0..3 {
                let alpha = alphas[3 * (k % lights) + c];
                let p = f64::from(p[k][c]);
                self.x[k][c] += alpha * p;
                self.z[k][c] -= alpha * (p - rho[c] * arrives[k][c]);
            }
        }
    }

    /// The next direction.
    fn turn(&self, betas: &[f64], p: &mut [Triple<f32>]) {
        let lights = self.scaled.lights();
        for (k, p) in p.iter_mut().enumerate() {
            for c in 0..3 {
                let beta = betas[3 * (k % lights) + c];
                p[c] = (self.z[k][c] + beta * f64::from(p[c])) as f32;
            }
        }
    }

    /// A residual over the smallest eigenvalue, relative to the values.
    fn error(&self, residual: impl Fn(usize) -> Rgb) -> f64 {
        let residuals = self.scaled.norms_of(residual).into_flattened();
        let values = self.scaled.norms_of(|k| self.x[k]).into_flattened();
        let known = residuals.into_iter().zip(values).zip(&self.channels);
        worst(known.map(|((residual, value), of)| ratio(residual / of.least, value)))
    }

    /// Finds the residual of the values in single precision; keeps them if they are the best.
    fn verify(&mut self) {
        let x: Values<f32> = self.x.iter().map(|x| x.map(|x| x as f32)).collect();
        let irradiance = self.scaled.irradiance(&x);
        let at = |k: usize| self.scaled.residual_at(k, &irradiance[k], &x[k]);
        let (residual, error) = (self.scaled.relative(at), self.error(at));
        if residual < self.best_residual() || self.best.is_none() {
            self.best = Some(Verified {
                x,
                irradiance,
                residual,
                error,
            });
        }
        self.is_verified = true;
    }

    fn best_residual(&self) -> f64 {
        let best = self.best.as_ref();
        best.map_or(f64::INFINITY, |best| best.residual)
    }
}

impl IterativeMethod for ConjugateGradients<'_> {
    fn advance(&mut self) -> Progress {
        if let Some(best) = self.best.take_if(|_| self.is_verified) {
            self.restart(&best.x, &best.irradiance);
            self.best = Some(best);
            self.is_verified = false;
        }
        self.step();
        let before = self.best_residual();
        if self.channels.iter().all(|channel| channel.rests) {
            self.verify();
        }
        let (residual, error) = match &self.best {
            Some(best) if self.is_verified => (best.residual, best.error),
            _ => {
                let residuals = self.channels.iter().map(|channel| channel.residual);
                (worst(residuals), self.error(|k| self.z[k]))
            }
        };
        Progress {
            residual,
            error: Some(error),
            // What single precision has no room for does not come back by beginning anew.
            stalled: self.is_verified && (residual > 0.5 * before || residual <= UNIT_ROUNDOFF),
            suspicious: self.channels.iter().any(|channel| channel.is_stuck),
        }
    }

    fn relaxation(&self) -> Option<f64> {
        None
    }

    fn finish(mut self: Box<Self>) -> (Values<f32>, Values<f64>) {
        if !self.is_verified {
            self.verify();
        }
        let best = self.best.expect("some values are the best");
        (best.x, best.irradiance)
    }
}
