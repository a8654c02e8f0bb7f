//! From the settings of a scene to the parameters of the stages.

use radiosity_form_factors::Estimator;
use radiosity_image::{Curve, Exposure, ToneMap, Transfer};
use radiosity_renderer::ImageParams;
use radiosity_scene::{
    Automatic, Gamma, ImageSettings, Light, Mode, Relaxation, Scene, SolverMethod, Standard, Tone,
};
use radiosity_solver as solver;

/// How form factors are estimated.
pub fn estimator(scene: &Scene) -> Estimator {
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
        adaptive: image.adaptive,
        backs: image.backs,
        seed: image.seed,
    }
}

/// Of pixels that are not black, so many are less bright than a screen by the automatic exposure.
const AUTOMATIC_PERCENTILE: f64 = 0.98;

/// From radiance to levels.
pub fn tone_map(image: &ImageSettings) -> ToneMap {
    ToneMap {
        exposure: match image.exposure.factor() {
            Some(factor) => Exposure::Fixed(factor),
            None => Exposure::Automatic {
                percentile: AUTOMATIC_PERCENTILE,
            },
        },
        curve: match image.tone {
            Tone::Clamp => Curve::Clamp,
            Tone::Reinhard => Curve::Reinhard,
            Tone::Filmic => Curve::Filmic,
        },
        transfer: transfer(image.gamma),
        dither: image.dither,
    }
}

/// From brightness to levels.
pub fn transfer(gamma: Gamma) -> Transfer {
    match gamma {
        Gamma::Exponent(gamma) => Transfer::Gamma(gamma),
        Gamma::Named(Standard::Srgb) => Transfer::Srgb,
    }
}
