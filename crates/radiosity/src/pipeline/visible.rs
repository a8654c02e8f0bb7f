//! Patches of which a part lies inside of something, or is covered.
//!
//! The hidden part exchanges no light, so what a patch exchanges is the radiosity of its visible
//! part, which is more than the mean over all of it: it is the finite element of the accurate mode.
//! In the other modes elements are whole patches, as in textbooks and in the course, and what is
//! visible is put right for pictures alone.

use super::{PatchLight, Pipeline};
use radiosity_form_factors::RowFacts;
use radiosity_scene::Mode;
use radiosity_solver::Solution;

/// Of patches of which less is visible, that part is too little to be told apart.
const LEAST_VISIBLE: f64 = 0.2;

/// The share of each patch that is visible, or 0 if it is too little. A row that sums to more than
/// the rays have found knows better.
pub(super) fn visible_shares(rows: &[RowFacts]) -> Vec<f32> {
    let share = |row: &RowFacts| {
        if row.visible < LEAST_VISIBLE {
            0.0
        } else {
            row.visible.max(row.fronts).min(1.0) as f32
        }
    };
    rows.iter().map(share).collect()
}

/// The share that exchanges light.
pub(super) fn exchanging(visible: f32) -> f32 {
    if visible > 0.0 { visible } else { 1.0 }
}

impl Pipeline<'_> {
    /// The share of each patch that is a finite element.
    pub(super) fn elements(&self, rows: &[RowFacts]) -> Vec<f64> {
        let share = |visible: f32| f64::from(exchanging(visible));
        match self.scene.form_factors.mode {
            Mode::Accurate => visible_shares(rows).into_iter().map(share).collect(),
            Mode::Regular | Mode::MonteCarlo => vec![1.0; rows.len()],
        }
    }

    /// What patches shine with by a solution, with the lights as bright as the scene has them.
    pub(super) fn light_of(&self, solution: &Solution, visible: Vec<f32>) -> PatchLight {
        let light = PatchLight {
            radiosity: self.dimmed(&solution.lights),
            direct: self.dimmed(&solution.direct),
            visible,
        };
        match self.scene.form_factors.mode {
            Mode::Accurate => light,
            Mode::Regular | Mode::MonteCarlo => PatchLight {
                radiosity: self.times_share(&light, |share| 1.0 / share),
                direct: scaled(&light.direct, &light.visible),
                visible: light.visible,
            },
        }
    }

    /// The radiosities of the finite elements.
    pub(super) fn of_elements(&self, light: &PatchLight) -> Vec<[f32; 3]> {
        match self.scene.form_factors.mode {
            Mode::Accurate => light.radiosity.clone(),
            Mode::Regular | Mode::MonteCarlo => self.mean_radiosity(light),
        }
    }

    /// The mean radiosities over whole patches, hidden parts included, which do nothing but emit.
    pub fn mean_radiosity(&self, light: &PatchLight) -> Vec<[f32; 3]> {
        self.times_share(light, |share| share)
    }

    /// Radiosities with what is not emitted times a factor that the visible share tells.
    fn times_share(&self, light: &PatchLight, factor: fn(f32) -> f32) -> Vec<[f32; 3]> {
        let emission = self.dimmed_emission().into_iter();
        let patches = emission.zip(&light.radiosity).zip(&light.visible);
        let scaled = |((emission, radiosity), &visible): (([f32; 3], &[f32; 3]), &f32)| {
            let factor = factor(exchanging(visible));
            std::array::from_fn(|c| emission[c] + factor * (radiosity[c] - emission[c]))
        };
        patches.map(scaled).collect()
    }
}

/// Means over patches, as they are on what is visible of them.
fn scaled(means: &[[f32; 3]], visible: &[f32]) -> Vec<[f32; 3]> {
    let on_visible = |(mean, &share): (&[f32; 3], &f32)| mean.map(|c| c / exchanging(share));
    means.iter().zip(visible).map(on_visible).collect()
}
