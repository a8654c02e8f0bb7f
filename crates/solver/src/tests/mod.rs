//! Small systems to test with.

mod iterates;
mod lights;
mod methods;
mod scales;
mod trouble;

use crate::*;
use proptest::prelude::*;
use radiosity_matrix::{DenseExchange, Exchange, SymmetricMatrix, packed_len};

#[derive(Debug)]
struct Case {
    exchange: DenseExchange,
    lights: Vec<Vec<Rgb>>,
    reflectance: Vec<Rgb>,
}

/// A method, and how much Gauss-Seidel relaxes.
type Way = (Method, Relaxation);

const GAUSS_SEIDEL: Way = (Method::GaussSeidel, Relaxation::Factor(1.0));
const METHODS: [Way; 4] = [
    GAUSS_SEIDEL,
    (Method::GaussSeidel, Relaxation::Factor(1.2)),
    (Method::GaussSeidel, Relaxation::Automatic),
    (Method::ConjugateGradients, Relaxation::Automatic),
];

fn with((method, relaxation): Way) -> Params {
    Params {
        method,
        relaxation,
        ..Params::default()
    }
}

impl Case {
    fn new(
        matrix: SymmetricMatrix,
        areas: Vec<f64>,
        lights: Vec<Vec<Rgb>>,
        reflectance: Vec<Rgb>,
    ) -> Case {
        Case {
            exchange: DenseExchange::new(matrix, areas),
            lights,
            reflectance,
        }
    }

    /// With other numbers `A_i F_ij`, in units of the total area.
    fn with_values(self, values: Vec<f32>) -> Case {
        let matrix = SymmetricMatrix::new(self.exchange.size(), values).unwrap();
        Case {
            exchange: self.exchange.with_matrix(matrix),
            ..self
        }
    }

    fn values(&self) -> Vec<f32> {
        self.exchange.matrix().values().to_vec()
    }

    /// A closed enclosure in which everything sees everything else equally.
    fn uniform_enclosure(size: usize, emission: Rgb, reflectance: Rgb) -> Case {
        let row_sum_one = 1.0 / (size * (size - 1)) as f32;
        Case::new(
            SymmetricMatrix::new(size, vec![row_sum_one; packed_len(size)]).unwrap(),
            vec![2.0; size],
            vec![vec![emission; size]],
            vec![reflectance; size],
        )
    }

    fn system(&self) -> System<'_> {
        System {
            exchange: &self.exchange,
            reflectance: &self.reflectance,
            lights: &self.lights,
        }
    }

    fn solve(&self, params: &Params) -> Solution {
        solve(&self.system(), params).unwrap()
    }
}

/// Systems of one light or two, of which rows sum to at most 1.
fn random_case() -> impl Strategy<Value = Case> {
    (2usize..12, 1usize..3).prop_flat_map(|(size, lights)| {
        let channel = || 0.0f64..1.0;
        let emission = prop::collection::vec([channel(), channel(), channel()], size);
        let exchange = prop::collection::vec(0.0f32..1.0, packed_len(size));
        let areas = prop::collection::vec(0.5f64..2.0, size);
        let lights = prop::collection::vec(emission, lights);
        let reflectance = prop::collection::vec([0.0f64..0.9, 0.0f64..0.9, 0.0f64..0.9], size);
        let visible = prop::collection::vec(0.5f64..=1.0, size);
        (exchange, areas, visible, lights, reflectance).prop_map(
            move |(mut exchange, areas, visible, lights, reflectance)| {
                // A_i F_ij <= smallest visible area / (n - 1), in units of the total.
                let total: f64 = areas.iter().sum();
                let scale = (0.25 / total / (size - 1) as f64) as f32;
                exchange.iter_mut().for_each(|s| *s *= scale);
                let parts = areas
                    .iter()
                    .zip(&visible)
                    .map(|(area, visible)| area * visible);
                let parts = parts.collect();
                let matrix = SymmetricMatrix::new(size, exchange).unwrap();
                let case = Case::new(matrix, areas, lights, reflectance);
                Case {
                    exchange: case.exchange.of_parts(parts),
                    ..case
                }
            },
        )
    })
}

/// The irradiance at a patch, on full rows, in double precision.
fn irradiance(case: &Case, i: usize, x: &[Rgb]) -> Rgb {
    let factor = |j: usize| case.exchange.exchange_area(i, j) / case.exchange.areas()[i];
    std::array::from_fn(|c| (0..x.len()).map(|j| factor(j) * x[j][c]).sum())
}

/// The L2 norm, weighted by area.
fn norm(case: &Case, values: &[Rgb]) -> f64 {
    let areas = case.exchange.areas();
    let square = |(area, v): (&f64, &Rgb)| area * v.iter().map(|c| c * c).sum::<f64>();
    areas.iter().zip(values).map(square).sum::<f64>().sqrt()
}

/// One channel alone.
fn channel(values: &[Rgb], c: usize) -> Vec<Rgb> {
    values.iter().map(|v| [v[c], 0.0, 0.0]).collect()
}

fn in_double(radiosity: &[[f32; 3]]) -> Vec<Rgb> {
    radiosity.iter().map(|b| b.map(f64::from)).collect()
}

/// The norm of a difference, relative to that of what is true.
fn distance(case: &Case, found: &[Rgb], truth: &[Rgb]) -> f64 {
    let difference = found.iter().zip(truth);
    let difference: Vec<Rgb> = difference
        .map(|(a, b)| std::array::from_fn(|c| a[c] - b[c]))
        .collect();
    norm(case, &difference) / norm(case, truth)
}

/// The radiosities of the first light, by bounces in double precision until none adds any more.
fn exact(case: &Case) -> Vec<Rgb> {
    let mut x = case.lights[0].clone();
    loop {
        let bounced = |i: usize| -> Rgb {
            let irradiance = irradiance(case, i, &x);
            std::array::from_fn(|c| case.lights[0][i][c] + case.reflectance[i][c] * irradiance[c])
        };
        let next: Vec<Rgb> = (0..x.len()).map(bounced).collect();
        let change = distance(case, &x, &next);
        x = next;
        // Of darkness, it is no number.
        if change.is_nan() || change < 1e-15 {
            return x;
        }
    }
}
