//! Conjugate gradients on the symmetrized system.
//!
//! Row `i` times `1 / gain_i = A_i / rho_i` makes the system symmetric,
//!
//! ```text
//! M x = b ,   M = diag(1 / gain) - S ,   b_i = E_i / gain_i ,
//! ```
//!
//! and positive definite where light dies away. Preconditioned by `diag(gain)`, the residual
//! `z = E + gain S x - x` is that of the radiosity equation itself (Saad, "Iterative Methods for
//! Sparse Linear Systems", 2003, algorithm 9.1):
//!
//! ```text
//! alpha = (z, z / gain) / (p, M p) ,   x <- x + alpha p ,   z <- z - alpha gain M p ,
//! beta = (z, z / gain) / (the same before) ,   p <- z + beta p
//! ```
//!
//! for each channel of each light by itself, with one product for all. Black rows are solved from
//! the start. The numbers `alpha` and `beta` tell the smallest eigenvalue of `gain M`, and that
//! tells the error.

use crate::Rgb;
use crate::convergence::Progress;
use crate::problem::{Problem, Values, joined, worst};
use crate::solve::Iteration;
use radiosity_matrix::Triple;

pub(crate) struct ConjugateGradients<'a> {
    problem: &'a Problem<'a>,
    tolerance: f64,
    x: Values<f64>,
    z: Values<f64>,
    p: Values<f32>,
    /// Per light.
    courses: Vec<[Course; 3]>,
    /// Per light, the smallest eigenvalue of `gain M` as far as it is known.
    least: Vec<f64>,
    /// Whether some `(p, M p)` of the last step was negative.
    is_indefinite: bool,
    /// The values in single precision with their products, once they are good enough.
    verified: Option<(Values<f32>, Values<f64>)>,
    /// The best residual of those.
    best: f64,
}

/// The course of one channel of one light.
#[derive(Clone, Default)]
struct Course {
    /// `(z, z / gain)`.
    square: f64,
    /// `alpha` and the `beta` after it.
    steps: Vec<(f64, f64)>,
}

impl<'a> ConjugateGradients<'a> {
    /// Begins at values whose sums are known.
    pub(crate) fn new(
        problem: &'a Problem<'a>,
        (x, sums): (Values<f32>, [Values<f64>; 2]),
        tolerance: f64,
    ) -> ConjugateGradients<'a> {
        let mut iteration = ConjugateGradients {
            problem,
            tolerance,
            x: Values::new(),
            z: Values::new(),
            p: Values::new(),
            courses: Vec::new(),
            least: vec![1.0; problem.lights()],
            is_indefinite: false,
            verified: None,
            best: f64::INFINITY,
        };
        iteration.restart(&x, &all_joined(&sums));
        iteration
    }

    /// Begins at values whose products are known.
    fn restart(&mut self, x: &[Triple<f32>], sums: &[Triple<f64>]) {
        let problem = self.problem;
        let active = |k: usize, c: usize| problem.gain[k / problem.lights()][c] > 0.0;
        self.x = x.iter().map(|x| x.map(f64::from)).collect();
        let residual = |k: usize| -> Rgb {
            let z = problem.residual_at(k, &sums[k], &x[k]);
            std::array::from_fn(|c| if active(k, c) { z[c] } else { 0.0 })
        };
        self.z = (0..x.len()).map(residual).collect();
        self.p = self.z.iter().map(|z| z.map(|z| z as f32)).collect();
        self.courses = vec![Default::default(); problem.lights()];
        let squares = self.squares();
        for (course, square) in self.channels().zip(squares) {
            course.square = square;
        }
    }

    fn channels(&mut self) -> impl Iterator<Item = &mut Course> {
        self.courses.as_flattened_mut().iter_mut()
    }

    /// A sum over all rows for each channel of each light; `term` is asked by index, channel and
    /// gain, where that is not zero.
    fn reduced(&self, term: impl Fn(usize, usize, f64) -> f64) -> Vec<f64> {
        let lights = self.problem.lights();
        let mut sums = vec![[0.0; 3]; lights];
        for k in 0..self.x.len() {
            let gain = &self.problem.gain[k / lights];
            for c in (0..3).filter(|&c| gain[c] > 0.0) {
                sums[k % lights][c] += term(k, c, gain[c]);
            }
        }
        sums.into_flattened()
    }

    fn squares(&self) -> Vec<f64> {
        self.reduced(|k, c, gain| self.z[k][c] * self.z[k][c] / gain)
    }

    fn step(&mut self) {
        let lights = self.problem.lights();
        let mut p = std::mem::take(&mut self.p);
        let sums = all_joined(&self.problem.sums(&mut p));
        let products = self.reduced(|k, c, gain| {
            let p = f64::from(p[k][c]);
            p * (p / gain - sums[k][c])
        });
        self.is_indefinite = products.iter().any(|&product| product < 0.0);
        let ratio = |part: f64, whole: f64| if part == 0.0 { 0.0 } else { part / whole };
        let squares: Vec<f64> = self.channels().map(|course| course.square).collect();
        let alphas: Vec<f64> = squares
            .iter()
            .zip(&products)
            .map(|(&a, &b)| ratio(a, b))
            .collect();
        for k in 0..self.x.len() {
            let gain = &self.problem.gain[k / lights];
            for c in 0..3 {
                let alpha = alphas[3 * (k % lights) + c];
                let p = f64::from(p[k][c]);
                self.x[k][c] += alpha * p;
                self.z[k][c] -= alpha * (p - gain[c] * sums[k][c]);
            }
        }
        let new = self.squares();
        let betas: Vec<f64> = new
            .iter()
            .zip(&squares)
            .map(|(&a, &b)| ratio(a, b))
            .collect();
        for (k, p) in p.iter_mut().enumerate() {
            for c in 0..3 {
                let beta = betas[3 * (k % lights) + c];
                p[c] = (self.z[k][c] + beta * f64::from(p[c])) as f32;
            }
        }
        self.p = p;
        let steps = alphas.into_iter().zip(betas).zip(new);
        for (course, (step, square)) in self.courses.as_flattened_mut().iter_mut().zip(steps) {
            course.square = square;
            if step.0 != 0.0 {
                course.steps.push(step);
            }
        }
        for (least, courses) in self.least.iter_mut().zip(&self.courses) {
            *least = courses
                .iter()
                .map(smallest_eigenvalue)
                .fold(*least, f64::min);
        }
    }

    /// A residual over the smallest eigenvalue, relative to the values.
    fn error(&self, residual: impl Fn(usize) -> Rgb) -> f64 {
        let residuals = self.problem.norms_of(residual);
        let values = self.problem.norms_of(|k| self.x[k]);
        let lights = residuals.into_iter().zip(values).zip(&self.least);
        worst(lights.map(|((residual, value), least)| (residual / least, value)))
    }

    /// The residual of the values in single precision, and their error.
    fn verify(&mut self) -> (f64, f64) {
        let mut x: Values<f32> = self.x.iter().map(|x| x.map(|x| x as f32)).collect();
        let sums = all_joined(&self.problem.sums(&mut x));
        let residual = |k: usize| self.problem.residual_at(k, &sums[k], &x[k]);
        let found = (self.problem.relative(residual), self.error(residual));
        self.verified = Some((x, sums));
        found
    }
}

impl Iteration for ConjugateGradients<'_> {
    fn first_residual(&self) -> f64 {
        self.problem.relative(|k| self.z[k])
    }

    fn advance(&mut self) -> Progress {
        if let Some((x, sums)) = self.verified.take() {
            self.restart(&x, &sums);
        }
        self.step();
        let known = self.problem.relative(|k| self.z[k]);
        let mut stalled = false;
        let (residual, error) = if known <= self.tolerance {
            let (residual, error) = self.verify();
            // What single precision has no room for does not come back by beginning anew.
            stalled = residual > 0.5 * self.best;
            self.best = residual.min(self.best);
            (residual, error)
        } else {
            (known, self.error(|k| self.z[k]))
        };
        Progress {
            residual,
            error: Some(error),
            stalled,
            suspicious: self.is_indefinite,
        }
    }

    fn relaxation(&self) -> Option<f64> {
        None
    }

    fn finish(mut self: Box<Self>) -> (Values<f32>, Values<f64>) {
        if self.verified.is_none() {
            self.verify();
        }
        self.verified.take().expect("it is there now")
    }
}

/// The sums, both parts together.
fn all_joined(sums: &[Values<f64>; 2]) -> Values<f64> {
    (0..sums[0].len()).map(|k| joined(sums, k)).collect()
}

/// Of the tridiagonal matrix that the steps make (Saad 2003, eq. 6.103), by Sturm sequences: the
/// smallest Ritz value, which comes down to the smallest eigenvalue.
fn smallest_eigenvalue(course: &Course) -> f64 {
    let mut rows: Vec<(f64, f64)> = Vec::new();
    let mut before = None;
    for &(alpha, beta) in &course.steps {
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
    // gain M = I - rho F has its smallest eigenvalue in (0, 1].
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
