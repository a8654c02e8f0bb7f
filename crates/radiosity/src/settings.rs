//! From the settings of a scene to the parameters of the stages.

use radiosity_form_factors::Estimator;
use radiosity_renderer::ImageParams;
use radiosity_scene::{Automatic, Light, Mode, Relaxation, Scene, SolverMethod};
use radiosity_solver as solver;

pub(crate) fn estimator(scene: &Scene) -> Estimator {
    let settings = &scene.form_factors;
    let points = settings.points;
    match settings.mode {
        Mode::Regular => Estimator::Regular { points },
        Mode::MonteCarlo => Estimator::MonteCarlo {
            points,
            pairs: settings.pairs.unwrap_or(points * points),
            seed: settings.seed,
        },
        Mode::Accurate => Estimator::Accurate {
            tolerance: settings.tolerance,
        },
    }
}

pub(crate) fn solver_params(scene: &Scene) -> solver::Params {
    let settings = &scene.solver;
    let relaxation = match settings.relaxation {
        Relaxation::Factor(factor) => solver::Relaxation::Factor(factor),
        Relaxation::Named(Automatic::Auto) => solver::Relaxation::Automatic,
    };
    solver::Params {
        method: match settings.method {
            SolverMethod::GaussSeidel => solver::Method::GaussSeidel(relaxation),
            SolverMethod::ConjugateGradients => solver::Method::ConjugateGradients,
        },
        tolerance: settings.tolerance,
        max_passes: settings.max_sweeps,
    }
}

/// The factor on each light's emission.
pub(crate) fn dimming(scene: &Scene) -> Vec<[f64; 3]> {
    scene.lights.iter().map(Light::dimming).collect()
}

pub(crate) fn image_params(scene: &Scene) -> ImageParams {
    let image = &scene.image;
    ImageParams {
        width: image.width,
        height: image.height,
        subpixels: image.subpixels,
        filter: image.filter,
        samples: image.samples,
        seed: image.seed,
        ..ImageParams::default()
    }
}
