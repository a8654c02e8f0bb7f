//! The parameters of the stage.

use radiosity_params::{NumberOrWord, OutOfRange};
use serde::{Deserialize, Serialize};

/// How to solve, and when to stop: `[solver]` of a scene file.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Params {
    /// The method. Default: Gauss-Seidel.
    pub method: Method,
    /// Of Gauss-Seidel: the factor on each change, between 0 and 2, or "auto". Default: auto.
    #[serde(with = "radiosity_params::number_or_word")]
    pub relaxation: Relaxation,
    /// Relative residual `||E + rho F B - B|| / ||E||` to reach (area-weighted L2 norm over
    /// patches) in each channel of each light, between 0 and 1. Below some 1e-7, single precision
    /// has no better solution. Default: 1e-6.
    pub residual: f64,
    /// Most passes over the matrix to take, at least 1. Default: 200.
    pub max_sweeps: u32,
}

/// The methods by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Row after row, with the newest values of all others.
    #[default]
    GaussSeidel,
    /// The fewest passes where light is reflected often.
    #[serde(alias = "cg")]
    ConjugateGradients,
}

/// The factor by which Gauss-Seidel multiplies each change (successive over-relaxation).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Relaxation {
    /// This one, in (0, 2); 1 is plain Gauss-Seidel.
    Factor(f64),
    /// What the convergence of the first sweeps suggests.
    #[default]
    Automatic,
}

impl NumberOrWord for Relaxation {
    const WORD: &'static str = "auto";

    fn new(number: Option<f64>) -> Relaxation {
        number.map_or(Relaxation::Automatic, Relaxation::Factor)
    }

    fn number(&self) -> Option<f64> {
        match *self {
            Relaxation::Factor(factor) => Some(factor),
            Relaxation::Automatic => None,
        }
    }
}

impl Default for Params {
    fn default() -> Params {
        Params {
            method: Method::default(),
            relaxation: Relaxation::default(),
            residual: 1e-6,
            max_sweeps: 200,
        }
    }
}

impl radiosity_params::Parameters for Params {
    fn check(&self) -> Result<(), OutOfRange> {
        let factor = self.relaxation.number();
        let relaxation = factor.is_none_or(|factor| factor > 0.0 && factor < 2.0);
        let range = "between 0 and 2, neither included, or \"auto\"";
        OutOfRange::unless(relaxation, "relaxation", range)?;
        let residual = self.residual > 0.0 && self.residual < 1.0;
        OutOfRange::unless(residual, "residual", "between 0 and 1, neither included")?;
        OutOfRange::unless(self.max_sweeps >= 1, "max_sweeps", "at least 1")
    }
}

impl Params {
    /// The same, with defaults for what the method does not use: all that a solution depends on.
    pub fn used(&self) -> Params {
        match self.method {
            Method::GaussSeidel => *self,
            Method::ConjugateGradients => Params {
                relaxation: Relaxation::default(),
                ..*self
            },
        }
    }

    /// One set of parameters for each method, and the method's name.
    pub fn by_each_method(&self) -> [(&'static str, Params); 3] {
        let plain = Relaxation::Factor(1.0);
        [
            ("Gauss-Seidel", Method::GaussSeidel, plain),
            (
                "over-relaxation",
                Method::GaussSeidel,
                Relaxation::Automatic,
            ),
            ("conjugate gradients", Method::ConjugateGradients, plain),
        ]
        .map(|(name, method, relaxation)| {
            let params = Params {
                method,
                relaxation,
                ..*self
            };
            (name, params)
        })
    }
}
