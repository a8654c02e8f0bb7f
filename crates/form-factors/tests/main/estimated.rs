//! Form factors by each estimator, in few words.

use radiosity_form_factors::{Estimation, Estimator, FormFactors};
use radiosity_geometry::Mesh;

pub(crate) fn run(mesh: &Mesh, estimator: Estimator) -> FormFactors {
    Estimation::new(mesh, estimator).run()
}

pub(crate) fn regular(mesh: &Mesh, points: u32) -> FormFactors {
    run(mesh, Estimator::Regular { points })
}

pub(crate) fn accurate(mesh: &Mesh, tolerance: f64) -> FormFactors {
    run(mesh, Estimator::Accurate { tolerance })
}

/// So many pairs of points, of strata along each edge.
pub(crate) fn monte_carlo(mesh: &Mesh, [points, pairs]: [u32; 2], seed: u64) -> FormFactors {
    let estimator = Estimator::MonteCarlo {
        points,
        pairs,
        seed,
    };
    run(mesh, estimator)
}
