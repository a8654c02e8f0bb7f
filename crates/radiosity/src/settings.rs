//! From the settings of a scene to the parameters of the stages.

use radiosity_form_factors::Estimator;
use radiosity_renderer::ImageParams;
use radiosity_scene::{Mode, Scene};
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
    solver::Params {
        tolerance: scene.solver.tolerance,
        max_sweeps: scene.solver.max_sweeps,
    }
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
