//! Why a system has no solution, and where.

use crate::power_iteration::spectral_radius;
use crate::{Rgb, System};

/// Why there is no solution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// Every bounce makes more light than it received.
    #[error(
        "the system has no solution: each bounce multiplies the light by {spectral_radius:.3} \
         (spectral radius of reflectance times form factors; it must be below 1)"
    )]
    Diverges {
        /// The factor by which light grows per bounce.
        spectral_radius: f64,
        /// The patches whose row sum times reflectance is largest, the worst first.
        worst_patches: Vec<usize>,
    },
    /// Far more is left of the equations than what shines.
    #[error(
        "this is no solution: its residual is {residual:.1e} times the emission; light dies away \
         too slowly, or not at all"
    )]
    Worthless {
        /// The relative residual.
        residual: f64,
    },
    /// Gauss-Seidel was asked for, and these form factors have no rows that it could go through.
    #[error("these form factors are not kept by rows, which Gauss-Seidel needs")]
    NoRows,
    /// A number in the input is NaN or infinite.
    #[error("patch {patch} has a form factor, emission or reflectance that is not finite")]
    NotFinite {
        /// The first such patch.
        patch: usize,
    },
    /// A radiosity cannot be kept.
    #[error(
        "the radiosity of patch {patch} is no number that single precision holds (1.2e-38 to \
         3.4e38 W/m^2)"
    )]
    OutOfRange {
        /// The first such patch.
        patch: usize,
    },
}

/// Sweeps over which the residual must grow before divergence is suspected.
const SUSPICIOUS_GROWTH: usize = 4;
/// With a relative residual above this, radiosities are no solution. (On their way to one,
/// conjugate gradients may exceed 1.)
pub(crate) const WORTHLESS: f64 = 10.0;
/// With a residual above this, passes that change nothing any more have not ended at rounding.
pub(crate) const FAR: f64 = 1e-3;
/// A spectral radius this near to 1 is 1, as far as single precision tells.
const RADIUS_ERROR: f64 = 1e-6;
/// How many of the worst patches an error names.
const NAMED_PATCHES: usize = 8;

/// Whether the residual grew over several sweeps, looked at once every few of them, or is so
/// large that it is no number any more.
pub(crate) fn is_growing(residuals: &[f64]) -> bool {
    if residuals.last().is_some_and(|last| !last.is_finite()) {
        return true;
    }
    let Some(last) = residuals.last_chunk::<SUSPICIOUS_GROWTH>() else {
        return false;
    };
    let grew = last.is_sorted() && last[0] < last[SUSPICIOUS_GROWTH - 1];
    residuals.len().is_multiple_of(SUSPICIOUS_GROWTH) && grew
}

/// Whether the residual has become clearly less over the second half of the passes: a long way from
/// a system without a solution, which takes long to tell.
pub(crate) fn is_falling(residuals: &[f64]) -> bool {
    let middle = residuals.get(residuals.len().saturating_sub(1) / 2);
    let ends = middle.zip(residuals.last());
    ends.is_some_and(|(middle, last)| *last < 0.9 * middle)
}

/// For systems that are not solved.
pub(crate) fn check_spectral_radius(system: &System<'_>) -> Result<(), SolveError> {
    let spectral_radius = spectral_radius(system);
    if spectral_radius < 1.0 - RADIUS_ERROR {
        return Ok(());
    }
    let sums = system.row_sums();
    let reflected = |i: usize| {
        let strongest = system.reflectance[i].into_iter().fold(0.0, f64::max);
        strongest * sums[i]
    };
    let mut worst_patches: Vec<usize> = (0..system.size()).collect();
    worst_patches.sort_by(|&a, &b| reflected(b).total_cmp(&reflected(a)));
    worst_patches.truncate(NAMED_PATCHES);
    Err(SolveError::Diverges {
        spectral_radius,
        worst_patches,
    })
}

/// Emission and reflectance.
pub(crate) fn check_materials(system: &System<'_>) -> Result<(), SolveError> {
    let finite = |rgb: &Rgb| rgb.iter().all(|c| c.is_finite());
    let is_good = |i: usize| {
        let lights = system.lights.iter();
        finite(&system.reflectance[i]) && lights.into_iter().all(|light| finite(&light[i]))
    };
    first(system, |i| !is_good(i))?;
    let lights = system.lights.iter();
    let mut channels = lights.flat_map(|light| (0..3).map(move |c| (light, c)));
    channels.try_for_each(|(light, c)| check_brightness(light, c))
}

/// That single precision holds the largest emission of a channel.
fn check_brightness(light: &[Rgb], c: usize) -> Result<(), SolveError> {
    let brightest = (0..light.len()).max_by(|&a, &b| light[a][c].total_cmp(&light[b][c]));
    match brightest {
        Some(patch) if light[patch][c] > 0.0 && !(light[patch][c] as f32).is_normal() => {
            Err(SolveError::OutOfRange { patch })
        }
        _ => Ok(()),
    }
}

/// Refuses radiosities that are no numbers, or larger than single precision holds: each item is a
/// list by patch.
pub fn check_radiosities<'a>(
    lights: impl IntoIterator<Item = &'a [[f32; 3]]>,
) -> Result<(), SolveError> {
    let is_bad = |b: &[f32; 3]| b.iter().any(|channel| !channel.is_finite());
    let mut lights = lights.into_iter();
    match lights.find_map(|light| light.iter().position(is_bad)) {
        Some(patch) => Err(SolveError::OutOfRange { patch }),
        None => Ok(()),
    }
}

/// Form factors: a pass of its own, so only where a result is no number.
pub(crate) fn check_numbers(system: &System<'_>) -> Result<(), SolveError> {
    let sums = system.row_sums();
    first(system, |i| !sums[i].is_finite())
}

fn first(system: &System<'_>, is_bad: impl Fn(usize) -> bool) -> Result<(), SolveError> {
    match (0..system.size()).find(|&i| is_bad(i)) {
        Some(patch) => Err(SolveError::NotFinite { patch }),
        None => Ok(()),
    }
}
