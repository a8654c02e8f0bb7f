//! What there is to say of a solution.

use radiosity::Energy;
use radiosity::solver::{Convergence, Method};
use radiosity::stages::Solved;
use serde::Serialize;

/// Fields may be added, but not changed or removed.
#[derive(Debug, Serialize)]
pub(crate) struct SolveReport {
    seconds: f64,
    cached: bool,
    /// Why it was computed; null if cached.
    reason: Option<String>,
    /// `gauss-seidel` or `conjugate-gradients`.
    method: &'static str,
    /// The factor by which Gauss-Seidel overdid its last changes.
    #[serde(skip_serializing_if = "Option::is_none")]
    relaxation: Option<f64>,
    /// Passes over the matrix.
    sweeps: usize,
    /// True relative residual of the solution, of the worst light.
    residual: f64,
    /// Estimated relative error, of the worst light; null after too few passes.
    error: Option<f64>,
    /// Whether the tolerance was reached.
    converged: bool,
    /// Whether it was not because single precision allows no less.
    stalled: bool,
    energy_balance: EnergyReport,
}

/// Per channel, in W.
#[derive(Debug, Serialize)]
struct EnergyReport {
    emitted: [f64; 3],
    absorbed: [f64; 3],
    /// The two that follow together.
    escaped: [f64; 3],
    to_backs: [f64; 3],
    to_background: [f64; 3],
    /// |emitted - absorbed - escaped| / emitted of the worst channel.
    imbalance: f64,
}

impl SolveReport {
    pub(crate) fn of(solved: &Solved<'_>, energy: &Energy) -> SolveReport {
        let report = &solved.solution.report;
        SolveReport {
            seconds: solved.origin.seconds,
            cached: solved.origin.is_cached(),
            reason: solved.origin.reason().map(str::to_owned),
            method: match report.method {
                Method::GaussSeidel => "gauss-seidel",
                Method::ConjugateGradients => "conjugate-gradients",
            },
            relaxation: report.relaxation,
            sweeps: report.residuals.len(),
            residual: report.residual,
            error: report.error,
            converged: report.converged,
            stalled: report.stalled,
            energy_balance: EnergyReport::of(energy),
        }
    }
}

impl EnergyReport {
    fn of(energy: &Energy) -> EnergyReport {
        let escaped = |c: usize| energy.to_backs[c] + energy.to_background[c];
        EnergyReport {
            emitted: energy.emitted,
            absorbed: energy.absorbed,
            escaped: [escaped(0), escaped(1), escaped(2)],
            to_backs: energy.to_backs,
            to_background: energy.to_background,
            imbalance: energy.imbalance(),
        }
    }
}

/// The same for people; more of it for those who want to know.
pub(crate) fn solution_lines(
    solved: &Solved<'_>,
    energy: &Energy,
    is_verbose: bool,
) -> Vec<String> {
    let report = &solved.solution.report;
    let mut lines = vec![convergence_line(report)];
    lines.extend(is_verbose.then(|| format!("residual {:.1e}", report.residual)));
    lines.extend(energy_line(energy));
    if is_verbose || energy.imbalance() > UNBALANCED {
        lines.extend(balance_line(energy));
    }
    if !report.converged {
        lines.push(warning(report));
    }
    lines
}

/// Of the light, where the energy balance is worse everybody is told.
const UNBALANCED: f64 = 0.005;

/// How it was reached.
fn convergence_line(report: &Convergence) -> String {
    let passes = report.residuals.len();
    let name = match report.method {
        Method::GaussSeidel => "Gauss-Seidel sweep",
        Method::ConjugateGradients => "conjugate-gradient step",
    };
    let plural = if passes == 1 { "" } else { "s" };
    let accuracy = match report.error {
        Some(error) => format!("estimated error {error:.0e}"),
        None => format!("residual {:.0e}", report.residual),
    };
    let relaxation = match report.relaxation {
        Some(factor) if factor != 1.0 => format!(" (relaxation {factor:.2})"),
        _ => String::new(),
    };
    format!("{passes} {name}{plural}{relaxation}, {accuracy}")
}

/// Where the power goes, over all channels.
fn energy_line(energy: &Energy) -> Option<String> {
    let whole: f64 = energy.emitted.iter().sum();
    let percent = |part: [f64; 3]| 100.0 * part.iter().sum::<f64>() / whole;
    (whole > 0.0).then(|| {
        format!(
            "of the light, {:.1} % is absorbed, {:.1} % leaves the scene, {:.1} % reaches back \
             faces",
            percent(energy.absorbed),
            percent(energy.to_background),
            percent(energy.to_backs),
        )
    })
}

/// What the parts sum to, over all channels.
fn balance_line(energy: &Energy) -> Option<String> {
    let sum = |of: [f64; 3]| of.iter().sum::<f64>();
    let share = sum(energy.missing()) / sum(energy.emitted);
    share.is_finite().then(|| {
        format!(
            "these shares sum to {:.2} %; what they are off 100 % is an error of the form factors, \
             or of rays",
            100.0 * (1.0 - share)
        )
    })
}

fn warning(report: &Convergence) -> String {
    let advice = if report.stalled {
        "numbers in single precision allow no less"
    } else if report.is_falling() {
        "allow more with --max-sweeps"
    } else {
        "more sweeps would not help"
    };
    format!("warning: the residual asked for was not reached; {advice}")
}
