//! The linear system, and its product.

use crate::Rgb;
use radiosity_matrix::SymmetricMatrix;

/// `(I - rho F) B = E`, by its parts. All slices are indexed by patch.
#[derive(Clone, Copy, Debug)]
pub struct System<'a> {
    /// `S_ij = A_i F_ij`, in units of the total area.
    pub exchange: &'a SymmetricMatrix,
    /// Patch areas, in square scene units.
    pub areas: &'a [f64],
    /// Radiant exitance that each patch emits itself, W/m^2, >= 0.
    pub emission: &'a [Rgb],
    /// Diffuse reflectance of each patch, in [0, 1].
    pub reflectance: &'a [Rgb],
}

/// Three channels and a zero, so that a compiler can use whole vector registers.
pub(crate) type Lanes = [f64; 4];

pub(crate) fn lanes([r, g, b]: Rgb) -> Lanes {
    [r, g, b, 0.0]
}

pub(crate) fn rgb([r, g, b, _]: Lanes) -> Rgb {
    [r, g, b]
}

/// `sum += factor * x`, lane by lane.
pub(crate) fn add_scaled(sum: &mut Lanes, factor: f64, x: &Lanes) {
    for (sum, x) in sum.iter_mut().zip(x) {
        *sum += factor * x;
    }
}

impl System<'_> {
    /// The sum of all patch areas.
    pub fn total_area(&self) -> f64 {
        self.areas.iter().sum()
    }

    pub(crate) fn size(&self) -> usize {
        self.exchange.size()
    }

    /// The irradiance `H_i = sum_j F_ij B_j`, W/m^2, that radiosities `B` cause.
    pub fn irradiance(&self, radiosity: &[Rgb]) -> Vec<Rgb> {
        let total = self.total_area();
        let x: Vec<Lanes> = radiosity.iter().copied().map(lanes).collect();
        let mut sums = vec![[0.0; 4]; self.size()];
        for (i, row) in self.exchange.rows() {
            let mut sum = [0.0; 4];
            for ((&s, x_j), sum_j) in row.iter().zip(&x).zip(&mut sums) {
                add_scaled(&mut sum, f64::from(s), x_j);
                add_scaled(sum_j, f64::from(s), &x[i]);
            }
            add_scaled(&mut sums[i], 1.0, &sum);
        }
        let scale = |(sum, &area): (Lanes, &f64)| rgb(sum).map(|s| s * total / area);
        sums.into_iter().zip(self.areas).map(scale).collect()
    }

    /// The area-weighted L2 norm over patches and channels.
    pub(crate) fn norm(&self, values: impl Iterator<Item = Rgb>) -> f64 {
        let square = |(v, area): (Rgb, &f64)| area * v.iter().map(|c| c * c).sum::<f64>();
        values.zip(self.areas).map(square).sum::<f64>().sqrt()
    }
}
