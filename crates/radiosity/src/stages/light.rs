//! What patches shine with.
//!
//! A part of a patch may lie inside of something, or be covered. That part exchanges no light, so
//! what a patch exchanges is the radiosity of its visible part, which is more than the mean over
//! all of it: it is the finite element of the accurate mode. In the other modes elements are whole
//! patches, as in textbooks and in the course, and what is visible is put right for pictures alone.

use radiosity_form_factors::{Mode, RowFacts};
use radiosity_solver::Energy;

/// What patches shine with, each list indexed by patch.
#[derive(Clone, Debug)]
pub struct PatchLight {
    /// What patches emit themselves, W/m^2 per channel.
    pub emission: Vec<[f32; 3]>,
    /// Radiosities of what is visible of patches, W/m^2 per channel.
    pub radiosity: Vec<[f32; 3]>,
    /// The part of them that patches reflect of what comes straight from emitters.
    pub direct: Vec<[f32; 3]>,
    /// The share of each patch that can be seen, and so exchanges light. 0 stands for too little to
    /// tell it apart: the radiosity is then the mean over all of the patch.
    pub visible: Vec<f32>,
    /// Where the power of the lights goes.
    pub energy: Energy,
}

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

/// The share of each patch that is a finite element.
pub(super) fn elements(mode: Mode, rows: &[RowFacts]) -> Vec<f64> {
    let share = |visible: f32| f64::from(exchanging(visible));
    match mode {
        Mode::Accurate => visible_shares(rows).into_iter().map(share).collect(),
        Mode::Regular | Mode::MonteCarlo => vec![1.0; rows.len()],
    }
}

impl PatchLight {
    /// From that of finite elements.
    pub(super) fn of_elements(mode: Mode, elements: PatchLight) -> PatchLight {
        match mode {
            Mode::Accurate => elements,
            Mode::Regular | Mode::MonteCarlo => PatchLight {
                radiosity: elements.times_share(|share| 1.0 / share),
                direct: scaled(&elements.direct, &elements.visible),
                ..elements
            },
        }
    }

    /// The radiosities of the finite elements.
    pub(super) fn radiosity_of_elements(&self, mode: Mode) -> Vec<[f32; 3]> {
        match mode {
            Mode::Accurate => self.radiosity.clone(),
            Mode::Regular | Mode::MonteCarlo => self.mean_radiosity(),
        }
    }

    /// The mean radiosities over whole patches, hidden parts included, which do nothing but emit.
    pub fn mean_radiosity(&self) -> Vec<[f32; 3]> {
        self.times_share(|share| share)
    }

    /// Radiosities with what is not emitted times a factor that the visible share tells.
    fn times_share(&self, factor: fn(f32) -> f32) -> Vec<[f32; 3]> {
        let patches = self.emission.iter().zip(&self.radiosity).zip(&self.visible);
        let scaled = |((emission, radiosity), &visible): ((&[f32; 3], &[f32; 3]), &f32)| {
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
